// Files that map nodes of an animation to joints of a character.
#include "checks/joint_map.h"

#include <gtest/gtest.h>

namespace contort {
namespace {

TEST(JointMap, NamesOfNodesAreFree) {
  const auto map = parse_joint_map(
      R"({"format": "contort.map/1", "joints": {"mixamorig:Left Arm": "arm_left/shoulder", "Hüfte": "leg_left/hip"}})");
  ASSERT_TRUE(map.ok()) << to_line(map.issue());
  EXPECT_EQ(map->joints.at("mixamorig:Left Arm"), "arm_left/shoulder");
  EXPECT_EQ(map->joints.size(), 2U);
}

TEST(JointMap, AnythingElseIsRefusedByName) {
  struct BadMap {
    const char* text;
    const char* code;
  };
  for (const BadMap& row :
       {BadMap{"", "json.syntax"}, BadMap{"{}", "map.wrong_format"},
        BadMap{R"({"format": "contort.map/2", "joints": {}})", "map.wrong_format"},
        BadMap{R"({"format": "contort.map/1"})", "map.missing_field"},
        BadMap{R"({"format": "contort.map/1", "joints": []})", "map.wrong_type"},
        BadMap{R"({"format": "contort.map/1", "joints": {"a": 1}})", "map.wrong_type"},
        BadMap{R"({"format": "contort.map/1", "joints": {"": "a/b"}})", "map.bad_text"},
        BadMap{R"({"format": "contort.map/1", "joints": {"a": "b", "a": "c"}})", "json.duplicate_key"},
        BadMap{R"({"format": "contort.map/1", "joints": {}, "bones": {}})", "map.unknown_field"}}) {
    const auto map = parse_joint_map(row.text);
    ASSERT_FALSE(map.ok()) << row.text;
    EXPECT_EQ(map.issue().code, row.code) << row.text << ": " << to_line(map.issue());
  }
}

}  // namespace
}  // namespace contort
