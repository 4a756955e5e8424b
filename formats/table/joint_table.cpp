#include "formats/table/joint_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>

#include "formats/table/cells.h"
#include "formats/table/names.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr std::size_t kMostShown = 40;    // greatest number of bytes of a cell in a message
constexpr int kMostComments = 100;        // greatest number of lines before the names
constexpr std::size_t kMostNamed = 12;    // greatest number of names in a message
constexpr std::size_t kMostNameBytes = 256;
constexpr double kLongestLog_s = 1e7;  // 116 days: larger times are times of day, as seconds since 1970
constexpr int kMostDigits = 15;  // decimals that a double can tell apart
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr char kExpected[] = "a table of joint values (CSV): a line of names, then numbers, with a column of times";

std::string quoted_cell(const std::string& cell) { return json_fields::quoted(cell.substr(0, kMostShown)); }

Issue at_line(int line, std::string_view code, std::string text) {
  return {"table." + std::string(code), "line " + std::to_string(line), std::move(text)};
}

std::string listed_names(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + quoted_cell(names[i]);
  return names.size() <= kMostNamed ? text : text + " and " + std::to_string(names.size() - kMostNamed) + " more";
}

// The line of names, and the format of the lines after it.
struct TableHead {
  std::vector<std::string> names;
  char separator = ',';
  int times = -1;        // index of the column; -1 if rows have a rate instead
  double seconds = 1.0;  // seconds in one unit of the times
  int line = 0;
};

std::string_view without_mark_of_comment(std::string_view line) {
  if (!line.starts_with('#')) return line;
  line.remove_prefix(std::min(line.find_first_not_of("# \t"), line.size()));
  return line;
}

bool is_blank_line(std::string_view line) { return line.find_first_not_of(" \t,;") == line.npos; }

// An empty name at the end is dropped, because lines may end with a separator.
std::vector<std::string> names_in(std::string_view line, char separator) {
  std::optional<std::vector<std::string>> names = cells_of(line, separator, kMaxTableColumns);
  if (!names) return {};
  while (!names->empty() && names->back().empty()) names->pop_back();
  return std::move(*names);
}

bool is_number(const std::string& cell) { return number_in(cell, true).has_value(); }

Result<TableHead> find_head(TableLines& lines) {
  std::string_view line;
  for (int comments = 0; lines.next(line);) {
    if (is_blank_line(line)) continue;
    const std::string_view plain = without_mark_of_comment(line);
    TableHead head;
    head.separator = separator_of(plain);
    head.names = names_in(plain, head.separator);
    head.times = find_times(head.names);
    head.line = lines.number();
    if (line.starts_with('#') && head.times < 0 && ++comments <= kMostComments) continue;
    return head;
  }
  return Issue{"table.empty", "", std::string("found no line of names, expected ") + kExpected};
}

Result<Done> check_names(const TableHead& head) {
  const auto fail = [&](std::string_view code, std::string text) { return at_line(head.line, code, std::move(text)); };
  if (head.names.size() > kMaxTableColumns)
    return fail("too_large", "found more than the allowed " + std::to_string(kMaxTableColumns) + " columns");
  if (head.names.empty() || std::ranges::all_of(head.names, is_number))
    return fail("no_names", std::string("found no names of columns, expected ") + kExpected);
  std::set<std::string> known;
  for (std::size_t i = 0; i < head.names.size(); ++i) {
    const std::string& name = head.names[i];
    if (name.empty() || name.size() > kMostNameBytes)
      return fail("bad_name", "column " + std::to_string(i + 1) + " has no name of 1 to 256 bytes");
    if (!known.insert(name).second) return fail("duplicate_name", "two columns are called " + quoted_cell(name));
  }
  return Done{};
}

Result<Done> find_clock(double rate_hz, TableHead& head) {
  if (head.times >= 0 && rate_hz > 0.0)
    return at_line(head.line, "has_times",
                   "the column " + quoted_cell(head.names[at(head.times)]) +
                       " has the times; a rate (--rate-hz) is for tables without such a column");
  if (head.times < 0 && !(rate_hz > 0.0))
    return at_line(head.line, "no_times",
                   "no column has the times: found " + listed_names(head.names) + ", expected " + kTimeNames +
                       "; or --rate-hz says how many rows a second has");
  if (head.times >= 0) head.seconds = *seconds_per_unit(head.names[at(head.times)]);
  return Done{};
}

class TableReader {
 public:
  TableReader(TableHead head, double rate_hz) : head_(std::move(head)), rate_hz_(rate_hz) {
    for (std::size_t i = 0; i < head_.names.size(); ++i) {
      if (static_cast<int>(i) == head_.times) continue;
      const NameAndUnit own = split_unit(head_.names[i]);
      out_.columns.push_back({own.name, own.unit});
    }
    first_row_.resize(out_.columns.size());
  }

  Result<JointTable> read(TableLines& lines) {
    std::string_view line;
    while (lines.next(line)) {
      if (is_blank_line(line)) continue;
      line_ = lines.number();
      if (const Result<Done> added = add_row(line); !added) return added.issue();
    }
    if (out_.times_s.empty()) return at_line(head_.line, "no_rows", "no line of numbers follows the names");
    if (const Result<Done> named = name_positions(); !named) return named.issue();
    if (const Result<Done> once = check_once(); !once) return once.issue();
    count_from_first();
    if (digits_ >= 0) out_.time_digit_s = head_.seconds;
    for (int digit = 0; digit < std::min(digits_, kMostDigits); ++digit) out_.time_digit_s *= 0.1;
    return std::move(out_);
  }

 private:
  Issue here(std::string_view code, std::string text) const { return at_line(line_, code, std::move(text)); }

  Result<Done> add_row(std::string_view line) {
    std::optional<std::vector<std::string>> cells = cells_of(line, head_.separator, kMaxTableColumns);
    const std::size_t names = head_.names.size();
    if (!cells) return here("bad_quote", "a cell begins with a quote that does not end it");
    const bool is_whole = cells->size() <= kMaxTableColumns;
    while (is_whole && cells->size() > names && cells->back().empty()) cells->pop_back();
    if (cells->size() != names)
      return here("ragged", "found " + std::to_string(cells->size()) + " cells, and there are " +
                                std::to_string(names) + " names in line " + std::to_string(head_.line));
    if (out_.row_count() >= kMaxTableRows || (out_.row_count() + 1) * names > kMaxTableNumbers)
      return here("too_large", "found more than the allowed " + std::to_string(kMaxTableRows) + " rows, or " +
                                   std::to_string(kMaxTableNumbers) + " numbers");
    if (const Result<Done> time = add_time(*cells); !time) return time;
    std::size_t column = 0;
    for (std::size_t i = 0; i < names; ++i)
      if (static_cast<int>(i) != head_.times) add_cell((*cells)[i], column++);
    return Done{};
  }

  // Reads the time of a row; without a column of times it follows from the rate.
  Result<Done> add_time(const std::vector<std::string>& cells) {
    if (head_.times < 0) return out_.times_s.push_back(static_cast<double>(out_.row_count()) / rate_hz_), Done{};
    const std::string& cell = cells[at(head_.times)];
    const std::string column = "column " + quoted_cell(head_.names[at(head_.times)]);
    const std::optional<double> number = number_in(cell, may_have_comma());
    if (!number || !std::isfinite(*number))
      return here("bad_time", column + ": found " + quoted_cell(cell) + ", expected a time");
    const double time_s = *number * head_.seconds;
    if (!(std::fabs(time_s) <= kMaxTableTime_s))
      return here("bad_time", column + ": found " + quoted_cell(cell) + ", which are " + number_text(time_s) +
                                  " s; a name such as time_ns says that times are not in seconds");
    if (!out_.times_s.empty() && !(time_s > out_.times_s.back()))
      return here("bad_time", column + ": found " + quoted_cell(cell) + ", which is not later than the row before");
    digits_ = std::max(digits_, digits_behind_point(cell));
    out_.times_s.push_back(time_s);
    return Done{};
  }

  void add_cell(const std::string& cell, std::size_t column) {
    TableColumn& own = out_.columns[column];
    const std::optional<double> number = number_in(cell, may_have_comma());
    const bool is_fine = number && std::fabs(*number) <= kMaxTableValue;
    out_.values.push_back(is_fine ? *number : kNoNumber);
    if (out_.row_count() == 1) first_row_[column] = cell;
    if (!is_fine && !own.fault) own.fault = fault_of(cell, column, number);
    const bool is_name = entry_of("name", own.name) >= 0;
    if (is_name && cell != first_row_[column] && !changed_name_)
      changed_name_ = here("names_change", "column " + quoted_cell(own.name) + ": found " + quoted_cell(cell) +
                                               ", and " + quoted_cell(first_row_[column]) + " before");
  }

  Issue fault_of(const std::string& cell, std::size_t column, const std::optional<double>& number) const {
    const std::string found = "column " + quoted_cell(out_.columns[column].name) + ": found " +
                              (cell.empty() ? "nothing" : quoted_cell(cell));
    if (!number) return here("bad_number", found + ", expected a number");
    if (!std::isfinite(*number)) return here("not_finite", found + ", expected a finite number");
    return here("out_of_range", found + ", allowed are -1e+06 to 1e+06");
  }

  bool may_have_comma() const { return head_.separator == ';' || head_.separator == '\t'; }

  // In an export of ROS, position number 3 belongs to the joint with name number 3.
  Result<Done> name_positions() {
    std::size_t named = 0;
    for (TableColumn& column : out_.columns) {
      const int entry = entry_of("position", column.name);
      for (std::size_t other = 0; entry >= 0 && other < out_.columns.size(); ++other) {
        if (entry_of("name", out_.columns[other].name) != entry || first_row_[other].empty()) continue;
        if (changed_name_) return *changed_name_;
        column.name = first_row_[other].substr(0, kMostNameBytes), ++named;
        break;
      }
    }
    if (named > 0)
      out_.remarks.push_back({"table.ros", "the file is an export of ROS: " + std::to_string(named) +
                                               " columns of positions have the names that its columns of names say"});
    return Done{};
  }

  // Counts times from the first row: seconds since 1970 would make findings unreadable.
  void count_from_first() {
    const double first_s = out_.times_s.front();
    if (std::fabs(first_s) < kLongestLog_s) return;
    for (double& time_s : out_.times_s) time_s -= first_s;
    out_.remarks.push_back({"table.clock", "times are counted from the first row, which is at " +
                                               std::to_string(static_cast<std::int64_t>(first_s)) + " s"});
  }

  // Names may be equal after their units were removed, or in an export of ROS.
  Result<Done> check_once() const {
    std::set<std::string> known;
    for (const TableColumn& column : out_.columns)
      if (!known.insert(column.name).second)
        return at_line(head_.line, "duplicate_name", "two columns are called " + quoted_cell(column.name));
    return Done{};
  }

  TableHead head_;
  double rate_hz_ = 0.0;
  int line_ = 0;
  int digits_ = -1;
  std::vector<std::string> first_row_;
  std::optional<Issue> changed_name_;
  JointTable out_;
};

}  // namespace

bool is_joint_table(std::string_view beginning) {
  TableLines lines(beginning);
  const Result<TableHead> head = find_head(lines);
  if (!head || head->times < 0 || head->names.size() < 2 || !check_names(*head)) return false;
  std::string_view line;
  while (lines.next(line))
    if (!is_blank_line(line)) break;
  const std::optional<std::vector<std::string>> cells = cells_of(line, head->separator, kMaxTableColumns);
  return cells && cells->size() > at(head->times) && is_number((*cells)[at(head->times)]);
}

Result<JointTable> parse_joint_table(std::string_view text, double rate_hz) {
  TableLines lines(text);
  Result<TableHead> found = find_head(lines);
  if (!found) return found.issue();
  TableHead head = std::move(found).value();
  if (const Result<Done> named = check_names(head); !named) return named.issue();
  if (const Result<Done> clock = find_clock(rate_hz, head); !clock) return clock.issue();
  return TableReader(std::move(head), rate_hz).read(lines);
}

Result<JointTable> read_joint_table(const std::string& path, double rate_hz) {
  const Result<std::string> text = read_file(path, kMaxTableBytes);
  const std::string beginning = text ? text->substr(0, kKindBytes) : beginning_of(path, kKindBytes);
  const std::string_view kind = kind_of_bytes(beginning);
  if (!kind.empty() && kind != kTableKind && !is_joint_table(beginning))
    return Issue{"table.wrong_kind", "", other_kind(path, beginning, kExpected)->text};
  const bool is_large = !text && text.issue().code == "file.too_large";
  if (!text) return Issue{is_large ? "table.too_large" : "table.unreadable", "", text.issue().text};
  Result<JointTable> table = parse_joint_table(*text, rate_hz);
  if (!table) return about_file(path, table.issue());
  return table;
}

}  // namespace contort
