// Finds by the names of a table's columns the column of times, the units of values, and the columns of an export of ROS
// that belong together.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contort {

struct NameAndUnit {
  std::string name;
  std::string unit;  // "deg" of "elbow [deg]" or "elbow (deg)"; "" if the name has no unit
};
NameAndUnit split_unit(std::string_view name);

// Seconds in one unit of a column of times; nothing if the name is not that of such a column.
std::optional<double> seconds_per_unit(std::string_view name);

// The column of times among these names: a message's own stamp in an export of ROS, otherwise the first with a name for
// times; -1 if there is none.
int find_times(const std::vector<std::string>& names);

inline constexpr char kTimeNames[] =
    "time, t, timestamp, stamp, secs or seconds, in seconds, or with a unit such as time_ms or \"time [ns]\"";

// The number of an entry of a list in an export of ROS: 3 of "field.position3", "position_3" and "position[3]"; -1 if
// the name is no entry of `list`.
int entry_of(std::string_view list, std::string_view name);

}  // namespace contort
