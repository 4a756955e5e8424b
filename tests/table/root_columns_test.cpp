// Names of columns with the root's pose.
#include "formats/table/root_columns.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(RootColumnNames, AreUnderstoodAsLogsWriteThem) {
  for (const char* name : {"root_x", "Root X", "base_x", "base_position_x", "base_pos_x", "pelvis_tx", "pose.position.x",
                           "field.pose.pose.position.x", "/odom/pose/pose/position/x", "base_link_x", "floating_base_px",
                           "freejoint/x", "world/base/translation.x"})
    EXPECT_EQ(root_number_of(name), RootNumber::x) << name;
  for (const char* name : {"root_qw", "base_quat_w", "base_orientation_w", "pose.orientation.w", "root_rot_w",
                           "/odom/pose/pose/orientation/w", "pelvis_quatw"})
    EXPECT_EQ(root_number_of(name), RootNumber::qw) << name;
  EXPECT_EQ(root_number_of("root_qz"), RootNumber::qz);
  EXPECT_EQ(root_number_of("pelvis_tz"), RootNumber::z);
}

TEST(RootColumnNames, AreNoOthers) {
  for (const char* name : {"x", "qw", "position.x", "root", "root_w", "base_vx", "base_vel_x", "base_linear_velocity_x",
                           "imu_orientation_x", "base_imu_orientation_x", "ee_pose.position.x", "base_target_x", "base_max",
                           "base_yaw", "root_position_0", "elbow_x", "twist.linear.x", ""})
    EXPECT_EQ(root_number_of(name), std::nullopt) << name;
}

}  // namespace
}  // namespace contort
