#include "formats/table/names.h"

#include <algorithm>
#include <array>

#include "formats/table/cells.h"

namespace contort {

namespace {

struct TimeUnit {
  std::string_view name;
  double seconds;
};
constexpr TimeUnit kTimeUnits[] = {{"s", 1.0},     {"sec", 1.0},  {"secs", 1.0},  {"second", 1.0}, {"seconds", 1.0},
                                   {"ms", 1e-3},   {"msec", 1e-3}, {"us", 1e-6},  {"usec", 1e-6},  {"ns", 1e-9},
                                   {"nsec", 1e-9}, {"nsecs", 1e-9}};
constexpr std::string_view kTimeWords[] = {"time", "t",       "timestamp",    "time_stamp",      "stamp",    "__time",
                                           "sec",  "secs",    "second",       "seconds",         "sim_time", "ros_time",
                                           "elapsed", "elapsed_time", "time_from_start"};

// rostopic echo -p writes all times in nanoseconds.
constexpr std::string_view kRosStamp = "field.header.stamp";
constexpr std::string_view kRosTime = "%time";

std::optional<double> seconds_in(std::string_view unit) {
  const auto found = std::ranges::find(kTimeUnits, unit, &TimeUnit::name);
  return found == std::end(kTimeUnits) ? std::nullopt : std::optional(found->seconds);
}

bool is_time_word(std::string_view word) { return std::ranges::find(kTimeWords, word) != std::end(kTimeWords); }

}  // namespace

NameAndUnit split_unit(std::string_view name) {
  for (const std::string_view brackets : {"[]", "()"}) {
    const std::size_t open = name.rfind(brackets[0]);
    if (open == name.npos || open == 0 || !name.ends_with(brackets[1])) continue;
    const std::string_view unit = name.substr(open + 1, name.size() - open - 2);
    if (unit.find_first_not_of("0123456789") == unit.npos) continue;  // an entry of a list: "position[3]"
    std::string_view plain = name.substr(0, open);
    plain = plain.substr(0, plain.find_last_not_of(' ') + 1);
    return {std::string(plain), in_lower_case(unit)};
  }
  return {std::string(name), ""};
}

std::optional<double> seconds_per_unit(std::string_view name) {
  const NameAndUnit own = split_unit(in_lower_case(name));
  if (own.name == kRosTime || own.name == kRosStamp) return 1e-9;
  if (is_time_word(own.name)) return own.unit.empty() ? 1.0 : seconds_in(own.unit);
  const std::size_t last = own.name.rfind('_');
  if (last == std::string::npos || !own.unit.empty() || !is_time_word(own.name.substr(0, last))) return std::nullopt;
  return seconds_in(own.name.substr(last + 1));
}

int find_times(const std::vector<std::string>& names) {
  const auto stamp = std::ranges::find(names, kRosStamp);
  if (stamp != names.end()) return static_cast<int>(stamp - names.begin());
  const auto times = std::ranges::find_if(names, [](const std::string& name) { return !!seconds_per_unit(name); });
  return times == names.end() ? -1 : static_cast<int>(times - names.begin());
}

int entry_of(std::string_view list, std::string_view name) {
  if (name.starts_with("field.")) name.remove_prefix(6);
  if (!name.starts_with(list)) return -1;
  name.remove_prefix(list.size());
  if (name.starts_with('[') && name.ends_with(']')) name = name.substr(1, name.size() - 2);
  if (name.starts_with('_') || name.starts_with('.')) name.remove_prefix(1);
  if (name.empty() || name.size() > 4 || name.find_first_not_of("0123456789") != name.npos) return -1;
  int number = 0;
  for (const char digit : name) number = 10 * number + (digit - '0');
  return number;
}

}  // namespace contort
