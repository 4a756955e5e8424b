#include "formats/robot/mjcf.h"

#include <gtest/gtest.h>

#include "tests/robot/robot_text.h"

namespace contort {
namespace {

using fixtures::in_mujoco;

Result<std::string> no_file(const std::string& name) { return Issue{"file.unreadable", "", "no file " + name}; }

Result<RobotModel> parse_mjcf_text(const std::string& text) { return parse_mjcf(text, no_file); }

std::string code_of_mjcf(const std::string& text) {
  const Result<RobotModel> robot = parse_mjcf_text(text);
  return robot ? "" : robot.issue().code;
}

const std::string kSphere = R"(<geom size="0.1"/>)";

TEST(Mjcf, ClassesGiveWhatAnElementDoesNotSay) {
  const std::string before = R"(<compiler angle="radian"/><default><joint axis="0 1 0" range="-1 1"/>
    <default class="limb"><joint range="-2 2"/><default class="knee"><joint range="0 3"/></default></default>
    </default>)";
  const std::string world = R"(<body name="a" childclass="limb"><freejoint/><geom size="0.1"/><body name="b">
    <joint name="hip"/><joint name="knee" class="knee"/><joint name="own" class="main" axis="1 0 0"/>
    <geom size="0.1"/></body></body>)";
  const Result<RobotModel> robot = parse_mjcf_text(in_mujoco(world, before));
  ASSERT_TRUE(robot.ok()) << to_line(robot.issue());
  EXPECT_TRUE(robot->has_free_root);
  const std::vector<RobotJoint>& joints = robot->bodies.at(1).joints;
  ASSERT_EQ(joints.size(), 3U);
  EXPECT_EQ(joints[0].high, 2.0);
  EXPECT_EQ(joints[1].low, 0.0);
  EXPECT_EQ(joints[1].high, 3.0);
  EXPECT_EQ(joints[1].axis, Vec3(0, 1, 0));
  EXPECT_EQ(joints[2].high, 1.0);
  EXPECT_EQ(joints[2].axis, Vec3(1, 0, 0));
}

TEST(Mjcf, AnglesAreDegreesUnlessTheCompilerSaysRadians) {
  const std::string world = R"(<body name="a"><joint name="j" range="-90 90"/><geom size="0.1"/></body>)";
  EXPECT_NEAR(parse_mjcf_text(in_mujoco(world))->bodies[1].joints[0].high, 0.5 * kPi, 1e-12);
  const std::string radian = R"(<compiler angle="radian"/>)";
  EXPECT_EQ(parse_mjcf_text(in_mujoco(world, radian))->bodies[1].joints[0].high, 90.0);
}

TEST(Mjcf, RangeCountsOnlyWhereLimitsAreOn) {
  const auto high_of = [](const std::string& attributes, const std::string& compiler) {
    const std::string world = R"(<body name="a"><joint name="j" type="slide" range="-1 1" )" + attributes + "/>" +
                              kSphere + R"(<body name="b"><joint name="k"/>)" + kSphere + "</body></body>";
    const RobotModel robot = *parse_mjcf_text(in_mujoco(world, compiler));
    return robot.bodies[0].name == "world" ? robot.bodies[1].joints[0].high : kNoLimit;
  };
  EXPECT_EQ(high_of("", ""), 1.0);
  EXPECT_EQ(high_of(R"(limited="false")", ""), kNoLimit);
  EXPECT_EQ(high_of("", R"(<compiler autolimits="false"/>)"), kNoLimit);
  EXPECT_EQ(high_of(R"(limited="true")", R"(<compiler autolimits="false"/>)"), 1.0);
}

TEST(Mjcf, TravelsWithoutLimitsPlaceTheRoot) {
  const std::string world = R"(<body name="torso"><joint name="rootx" type="slide" axis="1 0 0"/><joint name="rootz"
    type="slide"/><joint name="rooty" axis="0 1 0"/><geom size="0.1"/><body name="thigh"><joint name="hip"
    range="-30 30"/><geom size="0.1"/></body></body>)";
  const Result<RobotModel> robot = parse_mjcf_text(in_mujoco(world));
  ASSERT_TRUE(robot.ok());
  EXPECT_TRUE(robot->has_free_root);
  ASSERT_EQ(robot->bodies.size(), 2U);
  EXPECT_EQ(robot->bodies[0].name, "torso");
  EXPECT_TRUE(robot->bodies[0].joints.empty());
}

TEST(Mjcf, ObjectsOfTheSceneAreLeftOut) {
  const std::string world = R"(<body name="ball"><freejoint/><geom size="0.1"/></body><body name="arm"><joint name="j"/>
    <geom size="0.1"/></body>)";
  const Result<RobotModel> robot = parse_mjcf_text(in_mujoco(world));
  ASSERT_TRUE(robot.ok());
  ASSERT_EQ(robot->bodies.size(), 2U);
  EXPECT_EQ(robot->bodies[1].name, "arm");
  ASSERT_EQ(robot->notes.size(), 1U);
  EXPECT_NE(robot->notes[0].find("ball"), std::string::npos);
}

TEST(Mjcf, IncludedFilesStandInTheirPlaces) {
  const ReadIncluded read = [](const std::string& name) -> Result<std::string> {
    if (name == "arm.xml")
      return std::string(R"(<mujocoinclude><body name="a"><joint name="j"/><geom size="0.1"/></body></mujocoinclude>)");
    if (name == "ring.xml") return std::string(R"(<mujocoinclude><include file="ring.xml"/></mujocoinclude>)");
    return no_file(name);
  };
  const Result<RobotModel> robot = parse_mjcf(in_mujoco(R"(<include file="arm.xml"/>)"), read);
  ASSERT_TRUE(robot.ok()) << to_line(robot.issue());
  EXPECT_EQ(robot->bodies[1].name, "a");
  for (const char* bad : {"ring.xml", "../secret.xml"}) {
    const Result<RobotModel> refused = parse_mjcf(in_mujoco("<include file=\"" + std::string(bad) + "\"/>"), read);
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_EQ(refused.issue().code, "mjcf.bad_include");
  }
}

TEST(Mjcf, EffortIsThatOfTheActuator) {
  const std::string world = R"(<body name="a"><joint name="j"/><joint name="k" actuatorfrcrange="-7 7"/>
    <joint name="l"/><geom size="0.1"/></body>)";
  const std::string after = R"(<actuator><motor joint="j" gear="10" ctrlrange="-2 2"/><motor joint="k"
    ctrlrange="-1 1"/><position joint="l" forcerange="-3 4"/></actuator>)";
  const RobotModel robot = *parse_mjcf_text(in_mujoco(world, "", after));
  EXPECT_EQ(robot.bodies[1].joints[0].greatest_effort, 20.0);
  EXPECT_EQ(robot.bodies[1].joints[1].greatest_effort, 7.0);
  EXPECT_EQ(robot.bodies[1].joints[2].greatest_effort, 4.0);
}

TEST(Mjcf, CoupledJointsFollow) {
  const std::string world = R"(<body name="a"><joint name="j"/><geom size="0.1"/><body name="b"><joint name="k"/>
    <geom size="0.1"/></body></body>)";
  const std::string after = R"(<equality><joint joint1="k" joint2="j" polycoef="0.5 -2 0 0 0"/><connect body1="a"
    body2="b" anchor="0 0 0"/></equality>)";
  const RobotModel robot = *parse_mjcf_text(in_mujoco(world, "", after));
  EXPECT_EQ(robot.bodies[2].joints[0].follows, "j");
  EXPECT_EQ(robot.bodies[2].joints[0].multiplier, -2.0);
  EXPECT_EQ(robot.notes.size(), 1U) << "the loop is said";
}

TEST(Mjcf, FaultsHaveCodes) {
  const auto body = [](const std::string& inside) {
    return in_mujoco("<body name=\"a\">" + inside + kSphere + "</body>");
  };
  const struct {
    std::string text;
    const char* code;
  } rows[] = {
      {"<mujoco>", "mjcf.bad_xml"},
      {"<robot/>", "mjcf.wrong_kind"},
      {"<mujoco/>", "mjcf.bad_tree"},
      {in_mujoco("<include file=\"a.xml\"/>"), "mjcf.bad_include"},
      {in_mujoco("<joint/>"), "mjcf.bad_tree"},
      {body(R"(<joint type="screw"/>)"), "mjcf.bad_type"},
      {body(R"(<joint axis="0 0 0"/>)"), "mjcf.bad_axis"},
      {body(R"(<joint range="1 -1"/>)"), "mjcf.bad_limit"},
      {body(R"(<joint range="1"/>)"), "mjcf.bad_number"},
      {body(R"(<joint pos="0 0 inf"/>)"), "mjcf.bad_number"},
      {body(R"(<joint class="none"/>)"), "mjcf.unknown_class"},
      {body(R"(<joint name="j"/><joint name="j"/>)"), "mjcf.duplicate_name"},
      {body(R"(<body name="a"/>)"), "mjcf.duplicate_name"},
      {body(R"(<body name="b"><freejoint/></body>)"), "mjcf.bad_tree"},
      {body(R"(<geom size="0.1" mass="-1"/>)"), "mjcf.bad_mass"},
      {body(R"(<geom type="mesh" mesh="m"/>)"), "mjcf.unknown_mesh"},
      {in_mujoco("<body/>", R"(<compiler coordinate="global"/>)"), "mjcf.bad_type"},
      {in_mujoco("<body/>", R"(<default><default class="x"/><default class="x"/></default>)"), "mjcf.duplicate_name"},
  };
  for (const auto& row : rows) EXPECT_EQ(code_of_mjcf(row.text), row.code) << row.text;
}

}  // namespace
}  // namespace contort
