// Reads a table of joint values: text with a line of names, a column of times, and one column of numbers for each
// joint, as robots' logs and planners write (CSV). Files are hostile until proven otherwise: whatever the bytes are,
// the answer is a checked table or one Issue, within the limits below.
//
// * Cells are separated by commas, semicolons, tabs, or else blanks, whichever the line of names has most of. Names and
//   numbers may be in quotes. With semicolons or tabs, numbers may have a decimal comma.
// * The line of names is the first one. Lines before it that begin with "#" and have no column of times are comments;
//   a "#" before the names is not part of them.
// * Times are in a column called time, t, timestamp, stamp and the like, in seconds, or in the unit that its name says:
//   "time_ms", "time [ms]". Times must ascend. A table without one needs a rate.
// * A name may end with a unit in brackets, such as "elbow [deg]".
// * In an export of ROS (rostopic echo -p), times are nanoseconds, and field.name0 says whose field.position0 is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/asset/asset.h"
#include "model/core/result.h"

namespace contort {

// The limits of a table. They are checked before memory is allocated.
inline constexpr std::size_t kMaxTableBytes = std::size_t{256} << 20;
inline constexpr std::size_t kMaxTableColumns = 1024;
inline constexpr std::size_t kMaxTableRows = 1'000'000;
inline constexpr std::size_t kMaxTableNumbers = std::size_t{32} << 20;
inline constexpr double kMaxTableValue = 1e6;    // rad, m or degrees either way
inline constexpr double kMaxTableTime_s = 1e11;  // the year 5138, counted from 1970

struct TableColumn {
  std::string name{};           // without the unit
  std::string unit{};           // the unit in brackets in the name: "deg"; "" for none
  std::optional<Issue> fault{};  // the first invalid cell, whose value is NaN
  bool operator==(const TableColumn&) const = default;
};

struct JointTable {
  std::vector<TableColumn> columns;  // without the column of times; each name occurs once
  std::vector<double> times_s;       // at least one, ascending
  std::vector<double> values;        // row by row, as in the file
  double time_digit_s = 0.0;         // the smallest digit in which any time is written; 0 if unknown
  std::vector<Remark> remarks;

  std::size_t row_count() const { return times_s.size(); }
  double value(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  bool operator==(const JointTable&) const = default;
};

// Returns true if the beginning of a file is that of such a table with a column of times.
bool is_joint_table(std::string_view beginning);

// If `rate_hz` is above 0, the table must have no column of times, and rows are 1 / rate_hz apart. Codes "table.*"; the
// pointer is a line: "line 12".
Result<JointTable> read_joint_table(const std::string& path, double rate_hz = 0.0);
Result<JointTable> parse_joint_table(std::string_view text, double rate_hz = 0.0);

}  // namespace contort
