// The path of the root in a table of joint values: seven columns with its position and its quaternion.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "formats/table/joint_table.h"
#include "formats/table/root_columns.h"
#include "model/core/math.h"
#include "model/core/result.h"

namespace contort {

// The index of a column for each number of the root, with the metres in one unit of a position.
struct RootColumns {
  std::array<std::size_t, kRootNumbers> columns{};
  std::array<double, kRootNumbers> factors{};
};

// Finds the columns of the root among the free columns, which belong to no joint. Returns nothing if there are none.
// Codes table.incomplete_root, .duplicate_root, .wrong_unit, and the fault of one of the columns.
Result<std::optional<RootColumns>> find_root_columns(const JointTable& table, std::span<const std::size_t> free);

// Returns the root's pose in each row, in a character's axes: +Y up, +Z forward. The table's axes are these, or those
// of a robot: +Z up, +X forward. `world_from_root` is the rotation of the root in the table's world at which the
// character's root is not rotated. Code table.bad_quaternion.
Result<std::vector<Rigid>> read_root_path(const JointTable& table, const RootColumns& root, bool is_y_up,
                                          const Quat& world_from_root);

}  // namespace contort
