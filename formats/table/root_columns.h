// Finds by the names of a table's columns those with the pose of a robot's root: "root_x", "base_position_x",
// "pelvis_tx", "pose.position.x", and for the quaternion "root_qw", "base_orientation_w", "pose.orientation.w".
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace contort {

enum class RootNumber { x, y, z, qx, qy, qz, qw };
inline constexpr std::size_t kRootNumbers = 7;

// Returns the component of the root's pose that a column of this name has; nullopt for other names. A name consists of
// words for the root, at most one word for the quantity, and the axis, in upper or lower case.
std::optional<RootNumber> root_number_of(std::string_view column);

// The names of the seven columns in messages.
inline constexpr std::array<std::string_view, kRootNumbers> kRootNames = {"root_x",  "root_y",  "root_z", "root_qx",
                                                                          "root_qy", "root_qz", "root_qw"};

}  // namespace contort
