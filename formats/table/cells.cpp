#include "formats/table/cells.h"

#include <algorithm>
#include <charconv>

namespace contort {

namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

// Takes a quoted cell and the separator after it off the line. Returns false if the quote has no end.
bool take_quoted(std::string_view& line, char separator, std::string& cell) {
  line.remove_prefix(line.find('"') + 1);
  for (;;) {
    const std::size_t quote = line.find('"');
    if (quote == line.npos) return false;
    cell += line.substr(0, quote);
    line.remove_prefix(quote + 1);
    if (!line.starts_with('"')) break;
    cell += '"', line.remove_prefix(1);
  }
  const std::string_view behind = line.substr(0, line.find(separator));
  line.remove_prefix(behind.size());
  return separator == ' ' ? behind.empty() : trimmed(behind).empty();
}

std::string take_plain(std::string_view& line, char separator) {
  const std::string_view cell = line.substr(0, line.find(separator));
  line.remove_prefix(cell.size());
  return std::string(trimmed(cell));
}

// Several blanks may separate cells, and blanks may stand at both ends of the line.
void skip_separating_blanks(std::string_view& line, char separator) {
  if (separator == ' ') line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
}

}  // namespace

TableLines::TableLines(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
}

bool TableLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  line = rest_.substr(0, rest_.find_first_of("\r\n"));
  rest_.remove_prefix(line.size());
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : rest_.empty() ? 0 : 1);
  ++number_;
  return true;
}

char separator_of(std::string_view line) {
  constexpr std::string_view kSeparators = ",;\t";
  std::size_t counts[kSeparators.size()] = {};
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (const std::size_t kind = kSeparators.find(c); !is_quoted && kind != kSeparators.npos) ++counts[kind];
  }
  const std::size_t* most = std::ranges::max_element(counts);
  return *most == 0 ? ' ' : kSeparators[static_cast<std::size_t>(most - counts)];
}

std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator, std::size_t most) {
  std::vector<std::string> cells;
  while (cells.size() <= most) {
    skip_separating_blanks(line, separator);
    if (separator == ' ' && line.empty()) break;
    const std::size_t first = line.find_first_not_of(kBlanks);
    std::string& cell = cells.emplace_back();
    if (first != line.npos && line[first] == '"' && line.find(separator) >= first) {
      if (!take_quoted(line, separator, cell)) return std::nullopt;
    } else {
      cell = take_plain(line, separator);
    }
    if (line.empty()) break;
    line.remove_prefix(1);
  }
  return cells;
}

std::optional<double> number_in(std::string_view cell, bool may_have_comma) {
  std::string with_point;
  if (may_have_comma && cell.find('.') == cell.npos && std::ranges::count(cell, ',') == 1) {
    with_point = cell;
    std::ranges::replace(with_point, ',', '.');
    cell = with_point;
  }
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);  // from_chars accepts no plus sign
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

int digits_behind_point(std::string_view cell) {
  if (cell.find_first_of("eE") != cell.npos) return -1;
  const std::size_t point = cell.find_first_of(".,");
  return point == cell.npos ? 0 : static_cast<int>(cell.size() - point - 1);
}

std::string in_lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

}  // namespace contort
