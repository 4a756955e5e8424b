// contort check of a robot's joint values, from its URDF to the verdict.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace contort {
namespace {

// An arm with the range -1 to 2 rad, at 2 rad/s, and two fingers, one of which follows the other.
constexpr char kGripper[] = R"(<robot name="gripper">
<link name="base"/><link name="arm"/><link name="finger_a"/><link name="finger_b"/>
<joint name="arm_joint" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
 <limit lower="-1" upper="2" velocity="2" effort="9"/></joint>
<joint name="finger_joint" type="prismatic"><parent link="arm"/><child link="finger_a"/><axis xyz="1 0 0"/>
 <limit lower="0" upper="0.04" velocity="0.2" effort="9"/></joint>
<joint name="other_finger_joint" type="prismatic"><parent link="arm"/><child link="finger_b"/><axis xyz="1 0 0"/>
 <limit lower="-0.04" upper="0" velocity="0.2" effort="9"/><mimic joint="finger_joint" multiplier="-1"/></joint>
</robot>)";

class CheckJointTable : public testing::Test {
 protected:
  void SetUp() override {
    spill(folder_ / "gripper.urdf", kGripper);
    const Ran imported = contort_program({"import", folder_ / "gripper.urdf", "-o", folder_ / "robots"});
    ASSERT_EQ(imported.code, 0) << imported.err;
  }
  Ran check(const std::string& text, const std::vector<std::string>& more = {}) const {
    spill(folder_ / "log.csv", text);
    std::vector<std::string> call = {"--library", folder_ / "robots", "check", folder_ / "log.csv"};
    call.insert(call.end(), more.begin(), more.end());
    return contort_program(call);
  }
  Ran on_robot(const std::string& text, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--character", "gripper"});
    return check(text, more);
  }
  TempFolder folder_;
};

bool table_tells(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

TEST_F(CheckJointTable, SaysWhatWasJudged) {
  const Ran ran = on_robot("time,arm_joint,finger_joint,volts\n0,0,0,12\n0.1,0.1,0.01,12\n0.2,0.2,0.02,11\n");
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_TRUE(table_tells(ran.out, "  2 of 3 columns are joints of the character\n")) << ran.out;
  EXPECT_TRUE(table_tells(ran.out, "  not judged: columns that name no joint: volts\n")) << ran.out;
  EXPECT_TRUE(table_tells(ran.out, "  computed: joints without a column that follow another joint: ")) << ran.out;
  EXPECT_TRUE(table_tells(ran.out, "joint_range 6")) << ran.out;
  EXPECT_TRUE(table_tells(ran.out, "OK: nothing found.")) << ran.out;
}

TEST_F(CheckJointTable, JudgesRangesSpeedsAndJointsThatFollow) {
  const Ran ran = on_robot(
      "time,arm_joint,finger_joint,other_finger_joint\n0,1.9,0,0\n0.1,2.0,0.01,-0.01\n0.2,2.1,0.05,-0.02\n0.3,2.1,0.05,-0.03\n",
      {"--json"});
  EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
  const nlohmann::json clip = nlohmann::json::parse(ran.out)["clips"][0];
  std::set<std::string> found;
  for (const auto& finding : clip["findings"])
    found.insert(finding["check"].get<std::string>() + " " + finding["subject"].get<std::string>());
  const auto has = [&](const std::string& check, const std::string& ending) {
    return std::ranges::any_of(found, [&](const std::string& f) { return f.starts_with(check) && f.ends_with(ending); });
  };
  EXPECT_TRUE(has("joint_range", "arm_joint max")) << clip["findings"];
  EXPECT_TRUE(has("joint_range", "/finger_joint max")) << clip["findings"];
  EXPECT_TRUE(has("angular_velocity", "/finger_joint") || has("pop", "/finger_joint")) << clip["findings"];
  EXPECT_TRUE(has("mimic_error", "other_finger_joint")) << clip["findings"];
  EXPECT_EQ(clip["conversion"]["columns"], 3);
  EXPECT_EQ(clip["conversion"]["is_even"], true);
}

TEST_F(CheckJointTable, TakesDegreesAndARate) {
  EXPECT_EQ(on_robot("t,arm_joint\n0,100\n1,110\n", {"--unit", "deg"}).code, 0);
  EXPECT_EQ(on_robot("t,arm_joint [deg]\n0,100\n1,110\n").code, 0);
  EXPECT_EQ(on_robot("t,arm_joint\n0,100\n1,110\n").code, 1) << "in radians";
  EXPECT_EQ(on_robot("arm_joint\n0\n0.1\n", {"--rate-hz", "10"}).code, 0);
  EXPECT_EQ(on_robot("arm_joint\n0\n0.1\n", {"--rate-hz", "100"}).code, 1) << "ten times as fast";
}

// A base of 0.4 m with an arm that moves freely: its underside is 0.2 m below its origin.
constexpr char kBox[] = R"(<robot name="crate"><link name="base"><collision><geometry><box size="0.4 0.4 0.4"/></geometry>
</collision></link><link name="arm"/><joint name="arm_joint" type="continuous"><parent link="base"/><child link="arm"/>
</joint></robot>)";

TEST_F(CheckJointTable, MaySayWhereTheRootIs) {
  spill(folder_ / "crate.urdf", kBox);
  ASSERT_EQ(contort_program({"import", folder_ / "crate.urdf", "-o", folder_ / "robots"}).code, 0);
  const auto on_crate = [&](const std::string& rows, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--character", "crate"});
    return check("t,arm_joint,x,pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,"
                 "pose.orientation.y,pose.orientation.z,pose.orientation.w\n" + rows, more);
  };
  const Ran stands = on_crate("0,0,9,5,1,0.2,0,0,0,1\n0.1,0,9,5,1,0.2,0,0,0,1\n");
  EXPECT_EQ(stands.code, 0) << stands.out << stands.err;
  EXPECT_TRUE(table_tells(stands.out, "  7 columns say where the root is\n")) << stands.out;
  EXPECT_TRUE(table_tells(stands.out, "columns that name no joint: x\n")) << stands.out;
  EXPECT_TRUE(table_tells(stands.out, "ground_penetration")) << stands.out;
  const Ran sinks = on_crate("0,0,9,5,1,0.2,0,0,0,1\n0.1,0,9,5,1,0.1,0,0,0,1\n");
  EXPECT_EQ(sinks.code, 1) << sinks.out << sinks.err;
  EXPECT_TRUE(table_tells(sinks.out, "ground_penetration  body")) << sinks.out;
  EXPECT_EQ(on_crate("0,0,9,5,1,0.2,0,0,0,1\n0.1,0,9,5,1,0.2,0,0,0,1\n", {"--up", "z"}).code, 0);
  const Ran lies = on_crate("0,0,9,5,0.2,0.1,0,0,0,1\n0.1,0,9,5,0.2,0.1,0,0,0,1\n", {"--up", "y"});
  EXPECT_EQ(lies.code, 0) << lies.out << lies.err;
  EXPECT_TRUE(table_tells(on_robot("t,arm_joint\n0,0\n1,0.1\n", {"--up", "y"}).err, "usage.no_root: "));
}

// The body's box is on its +X side, which its rest turns upwards: a log of the rest pose keeps it above the ground.
TEST_F(CheckJointTable, TurnsTheRootAsItsBodyIsTurnedAtRest) {
  spill(folder_ / "turned.xml", R"(<mujoco><worldbody><body name="b" quat="0.7071 0 -0.7071 0"><freejoint/>
    <geom type="box" pos="0.3 0 0" size="0.1 0.1 0.1"/><body name="c"><joint name="j" axis="0 0 1"/>
    <geom type="sphere" pos="0.3 0 0" size="0.05"/></body></body></worldbody></mujoco>)");
  const Ran imported = contort_program({"import", folder_ / "turned.xml", "-o", folder_ / "robots"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  const auto with_root = [&](const std::string& quaternion) {
    return check("t,j,root_x,root_y,root_z,root_qw,root_qx,root_qy,root_qz\n0,0,0,0,0," + quaternion + "\n",
                 {"--character", "turned"});
  };
  const Ran at_rest = with_root("0.7071,0,-0.7071,0");
  EXPECT_FALSE(table_tells(at_rest.out, "  ground_penetration  ")) << at_rest.out << at_rest.err;
  const Ran upside_down = with_root("0.7071,0,0.7071,0");
  EXPECT_TRUE(table_tells(upside_down.out, "  ground_penetration  ")) << upside_down.out << upside_down.err;
  spill(folder_ / "map.json", R"({"format": "contort.map/1", "joints": {}, "root_rotation": [0, 0, 0, 0.5]})");
  const Ran bad = check("t,j\n0,0\n", {"--character", "turned", "--map", folder_ / "map.json"});
  EXPECT_TRUE(table_tells(bad.err, "map.bad_rotation at /root_rotation: ")) << bad.err;
}

TEST_F(CheckJointTable, RefusesWhatCannotBeJudged) {
  const auto refused = [](const Ran& ran, const std::string& what) {
    EXPECT_EQ(ran.code, 2) << ran.out;
    EXPECT_TRUE(table_tells(ran.err, what)) << ran.err;
  };
  const std::string fine = "t,arm_joint\n0,0\n1,0.1\n";
  refused(check(fine), "check.needs_character: ");
  refused(on_robot("t,elbow\n0,0\n"), "check.nothing_matches: ");
  refused(on_robot("t,elbow\n0,0\n"), "joints are arm_joint, finger_joint, other_finger_joint");
  refused(on_robot("x,arm_joint\n0,0\n"), "table.no_times at line 1: ");
  refused(on_robot("t,arm_joint\n0,0\n1,oops\n"), "table.bad_number at line 3: ");
  refused(on_robot(fine, {"--rate-hz", "10"}), "table.has_times");
  refused(on_robot(fine, {"--unit", "cm"}), "usage.for_bvh");
  refused(on_robot(fine, {"--loops", "*"}), "usage.for_clips");
}

TEST_F(CheckJointTable, InAFolderIsJudgedOnlyOnACharacter) {
  std::filesystem::create_directories(folder_ / "logs");
  spill(folder_ / "logs/a.csv", "t,arm_joint\n0,0\n1,0.1\n");
  spill(folder_ / "logs/b.csv", "price,weight\n1,2\n");
  const Ran on = contort_program({"--library", folder_ / "robots", "check", folder_ / "logs", "--character", "gripper"});
  EXPECT_EQ(on.code, 0) << on.out << on.err;
  EXPECT_TRUE(table_tells(on.out, "files=1 unreadable=0 skipped=1")) << on.out;
  const Ran off = contort_program({"check", folder_ / "logs"});
  EXPECT_EQ(off.code, 2) << off.out;
  EXPECT_TRUE(table_tells(off.err, "check.no_clip") && table_tells(off.err, "--character NAME")) << off.err;
}

TEST_F(CheckJointTable, OfAnyCharacterNamesItsJoints) {
  spill(folder_ / "elbow.csv", "t,arm_left/elbow [deg]\n0,10\n1,20\n");
  EXPECT_EQ(contort_program({"check", folder_ / "elbow.csv", "--character", "human"}).code, 0);
  spill(folder_ / "mine.csv", "t,e\n0,0.2\n1,0.3\n");
  spill(folder_ / "map.json", R"({"format": "contort.map/1", "joints": {"e": "arm_left/elbow"}})");
  const Ran mapped = contort_program({"check", folder_ / "mine.csv", "--character", "human", "--map", folder_ / "map.json"});
  EXPECT_EQ(mapped.code, 0) << mapped.out << mapped.err;
}

}  // namespace
}  // namespace contort
