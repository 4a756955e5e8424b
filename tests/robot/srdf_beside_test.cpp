#include "formats/robot/srdf_beside.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/robot/read.h"
#include "tests/corpus/temp_folder.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

class SrdfBeside : public ::testing::Test {
 protected:
  void put(const std::string& name, const std::string& text) {
    fs::create_directories(fs::path(folder_ / name).parent_path());
    spill(folder_ / name, text);
  }
  void put_urdf(const std::string& name) {
    put(name, R"(<robot name="arm"><link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/>
      <child link="b"/></joint></robot>)");
  }
  Result<RobotModel> read(const std::string& name) const { return read_robot_with_srdf_beside(folder_ / name, "choose one"); }
  TempFolder folder_;
};

std::string srdf_of(const std::string& robot, const std::string& reason = "Never") {
  return "<?xml version=\"1.0\"?>\n<!-- pairs -->\n<robot name=\"" + robot +
         "\"><disable_collisions link1=\"a\" link2=\"b\" reason=\"" + reason + "\"/></robot>";
}

bool has_note(const RobotModel& robot, const std::string& part) {
  return std::ranges::any_of(robot.notes, [&](const std::string& text) { return text.find(part) != text.npos; });
}

TEST_F(SrdfBeside, IsFoundInEachPlaceOfAPackage) {
  put_urdf("ws/arm_description/urdf/arm.urdf");
  for (const char* place : {"arm_description/urdf", "arm_description/urdf/config", "arm_description/srdf",
                            "arm_description/config", "arm_moveit_config/config", "arm_moveit_config/srdf"}) {
    const std::string name = std::string("ws/") + place + "/any.srdf";
    put(name, srdf_of("arm"));
    const Result<RobotModel> robot = read("ws/arm_description/urdf/arm.urdf");
    ASSERT_TRUE(robot.ok()) << place << to_line(robot.issue());
    EXPECT_EQ(robot->may_touch.size(), 1U) << place;
    EXPECT_TRUE(has_note(*robot, "1 disabled pairs from ") && has_note(*robot, "any.srdf")) << place;
    fs::remove(folder_ / name);
  }
}

TEST_F(SrdfBeside, IsFoundForAUrdfInThePackageItself) {
  put_urdf("ws/arm_description/arm.urdf");
  put("ws/moveit_config/config/arm.srdf", srdf_of("arm"));
  const Result<RobotModel> robot = read("ws/arm_description/arm.urdf");
  EXPECT_TRUE(has_note(*robot, "from ../moveit_config/config/arm.srdf")) << robot->notes.at(0);
  EXPECT_EQ(robot->srdf, folder_ / "ws/moveit_config/config/arm.srdf");
}

TEST_F(SrdfBeside, ThatSaysAnotherNameIsNamedAndNotUsed) {
  put_urdf("arm.urdf");
  put("armed.srdf", srdf_of("armed"));
  const Result<RobotModel> robot = read("arm.urdf");
  EXPECT_TRUE(robot->may_touch.empty());
  EXPECT_EQ(robot->srdf, "");
  EXPECT_TRUE(has_note(*robot, "armed.srdf"));
  const Result<RobotModel> asked = read_robot(folder_ / "arm.urdf", folder_ / "armed.srdf");
  EXPECT_EQ(asked->may_touch.size(), 1U);
  EXPECT_TRUE(has_note(*asked, "about a robot \"armed\""));
}

TEST_F(SrdfBeside, IsRefusedWithTheWayToChooseWhereSeveralFit) {
  put_urdf("arm.urdf");
  put("one.srdf", srdf_of("arm"));
  put("config/copy.srdf", srdf_of("arm"));
  EXPECT_TRUE(read("arm.urdf").ok()) << "equal texts are one";
  put("two.srdf", srdf_of("arm", "Adjacent"));
  const Result<RobotModel> robot = read("arm.urdf");
  ASSERT_FALSE(robot.ok());
  EXPECT_EQ(robot.issue().code, "srdf.several");
  for (const char* part : {"one.srdf", "two.srdf", "; choose one"})
    EXPECT_NE(robot.issue().text.find(part), std::string::npos) << robot.issue().text;
}

TEST_F(SrdfBeside, ThatCannotBeReadStopsNothingAndIsNamed) {
  put_urdf("arm.urdf");
  put("broken.srdf", "<robot name=\"arm\"");
  put("macro.srdf", "<robot name=\"$(arg name)\"/>");
  put("whole.srdf", srdf_of("arm"));
  fs::create_directories(folder_ / "folder.srdf");
  fs::create_symlink("nowhere", folder_ / "link.srdf");
  const Result<RobotModel> robot = read("arm.urdf");
  ASSERT_TRUE(robot.ok()) << to_line(robot.issue());
  EXPECT_EQ(robot->may_touch.size(), 1U);
  for (const char* part : {"broken.srdf", "macro.srdf", "folder.srdf", "link.srdf"})
    EXPECT_TRUE(has_note(*robot, std::string(part) + " lies beside the file and was not used")) << part;
}

TEST_F(SrdfBeside, IsNotLookedForBesideAModelOfMuJoCo) {
  put("arm.xml", R"(<mujoco model="arm"><worldbody><body name="a"/></worldbody></mujoco>)");
  put("arm.srdf", srdf_of("arm"));
  const Result<RobotModel> robot = read("arm.xml");
  ASSERT_TRUE(robot.ok()) << to_line(robot.issue());
  EXPECT_FALSE(has_note(*robot, "srdf"));
}

}  // namespace
}  // namespace contort
