#include "formats/robot/urdf.h"

#include <gtest/gtest.h>

#include "tests/robot/robot_text.h"

namespace contort {
namespace {

using fixtures::two_links;

std::string code_of_urdf(const std::string& text) {
  const Result<RobotModel> robot = parse_urdf(text);
  return robot ? "" : robot.issue().code;
}

TEST(Urdf, GivesLimitsSpeedAndEffortOfAHinge) {
  const Result<RobotModel> robot = parse_urdf(two_links(
      "revolute",
      R"(<origin xyz="0 0 1" rpy="0 0 0"/><axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="4"/>)"));
  ASSERT_TRUE(robot.ok()) << to_line(robot.issue());
  ASSERT_EQ(robot->bodies.size(), 2U);
  const RobotJoint& joint = robot->bodies[1].joints.at(0);
  EXPECT_EQ(joint.low, -1.0);
  EXPECT_EQ(joint.high, 2.0);
  EXPECT_EQ(joint.greatest_speed, 3.0);
  EXPECT_EQ(joint.greatest_effort, 4.0);
  EXPECT_EQ(joint.axis, Vec3(0, 0, 1));
  EXPECT_EQ(robot->bodies[1].parent_from_body.p_m, Vec3(0, 0, 1));
}

TEST(Urdf, KnowsEachTypeOfJoint) {
  const struct {
    const char* type;
    std::size_t joints;
    RobotJointKind first;
  } rows[] = {{"revolute", 1, RobotJointKind::hinge},   {"continuous", 1, RobotJointKind::hinge},
              {"prismatic", 1, RobotJointKind::travel}, {"fixed", 0, RobotJointKind::hinge},
              {"floating", 4, RobotJointKind::travel},  {"planar", 3, RobotJointKind::travel}};
  for (const auto& row : rows) {
    const Result<RobotModel> robot = parse_urdf(two_links(row.type, R"(<limit lower="-1" upper="1"/>)"));
    ASSERT_TRUE(robot.ok()) << row.type << to_line(robot.issue());
    ASSERT_EQ(robot->bodies[1].joints.size(), row.joints) << row.type;
    if (row.joints > 0) {
      EXPECT_EQ(robot->bodies[1].joints[0].kind, row.first) << row.type;
    }
  }
  const Result<RobotModel> wheel = parse_urdf(two_links("continuous", R"(<limit lower="-1" upper="1"/>)"));
  EXPECT_EQ(wheel->bodies[1].joints[0].high, kNoLimit) << "a continuous joint has no range";
}

TEST(Urdf, RootThatFloatsOverAnEmptyLinkIsFree) {
  const std::string text = R"(<robot name="r"><link name="world"/><link name="base"/><joint name="j" type="floating">
    <parent link="world"/><child link="base"/></joint></robot>)";
  const Result<RobotModel> robot = parse_urdf(text);
  ASSERT_TRUE(robot.ok());
  EXPECT_TRUE(robot->has_free_root);
  EXPECT_TRUE(robot->bodies[1].joints.empty());
}

TEST(Urdf, SaysWhatAJointFollows) {
  const Result<RobotModel> robot = parse_urdf(
      two_links("prismatic", R"(<limit lower="0" upper="1"/><mimic joint="other" multiplier="-2" offset="0.5"/>)"));
  ASSERT_TRUE(robot.ok());
  EXPECT_EQ(robot->bodies[1].joints[0].follows, "other");
  EXPECT_EQ(robot->bodies[1].joints[0].multiplier, -2.0);
  EXPECT_EQ(robot->bodies[1].joints[0].offset, 0.5);
}

TEST(Urdf, MissingLimitIsNoLimitAndIsSaid) {
  const Result<RobotModel> robot = parse_urdf(two_links("revolute", ""));
  ASSERT_TRUE(robot.ok());
  EXPECT_EQ(robot->bodies[1].joints[0].low, -kNoLimit);
  ASSERT_EQ(robot->notes.size(), 1U);
  EXPECT_NE(robot->notes[0].find("no lower or upper limit: j"), std::string::npos) << robot->notes[0];
}

TEST(Urdf, InertiaIsTurnedWithItsOrigin) {
  const std::string text =
      R"(<robot name="r"><link name="a"><inertial><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/>
    <mass value="2"/><inertia ixx="1" iyy="2" izz="3" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";
  const Result<RobotModel> robot = parse_urdf(text);
  ASSERT_TRUE(robot.ok());
  const BodyInertia& inertia = robot->bodies[0].inertia;
  EXPECT_EQ(inertia.center_m, Vec3(1, 2, 3));
  EXPECT_NEAR(inertia.inertia_kg_m2[0][0], 2.0, 1e-12);
  EXPECT_NEAR(inertia.inertia_kg_m2[1][1], 1.0, 1e-12);
}

TEST(Urdf, FaultsHaveCodes) {
  const std::string range = R"(<limit lower="-1" upper="1"/>)";
  const struct {
    std::string text;
    const char* code;
  } rows[] = {
      {"", "urdf.bad_xml"},
      {"<robot name='r'><link name='a'>", "urdf.bad_xml"},
      {"<mujoco/>", "urdf.wrong_kind"},
      {"<!DOCTYPE r [<!ENTITY a 'aaaa'>]><robot/>", "urdf.entities"},
      {"<robot name='r'/>", "urdf.bad_tree"},
      {"<robot><link/></robot>", "urdf.no_name"},
      {"<robot><link name='a'/><link name='a'/></robot>", "urdf.duplicate_name"},
      {"<robot><link name='a'/><link name='b'/></robot>", "urdf.bad_tree"},
      {R"(<robot><xacro:macro name="m"/><link name="a"/></robot>)", "urdf.xacro"},
      {R"(<robot><link name="${prefix}a"/></robot>)", "urdf.xacro"},
      {two_links("hinge", range), "urdf.bad_type"},
      {two_links("revolute", R"(<limit lower="1" upper="-1"/>)"), "urdf.bad_limit"},
      {two_links("revolute", R"(<limit lower="-1" upper="1" velocity="-2"/>)"), "urdf.bad_limit"},
      {two_links("revolute", R"(<limit lower="-1" upper="nan"/>)"), "urdf.bad_number"},
      {two_links("revolute", R"(<limit lower="-1" upper="1e999"/>)"), "urdf.bad_number"},
      {two_links("revolute", range + R"(<origin xyz="1 2"/>)"), "urdf.bad_number"},
      {two_links("revolute", range + R"(<axis xyz="0 0 0"/>)"), "urdf.bad_axis"},
      {R"(<robot><link name="a"/><joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>)",
       "urdf.unknown_link"},
      {R"(<robot><link name="a"/><joint name="j" type="fixed"><parent link="a"/><child link="a"/></joint></robot>)",
       "urdf.bad_tree"},
      {R"(<robot><link name="r"/><link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/>
          <child link="b"/></joint><joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>)",
       "urdf.bad_tree"},
      {R"(<robot><link name="a"><inertial><mass value="-1"/></inertial></link></robot>)", "urdf.bad_mass"},
  };
  for (const auto& row : rows) EXPECT_EQ(code_of_urdf(row.text), row.code) << row.text;
}

TEST(Urdf, DeepNestingIsRefused) {
  std::string text = "<robot>";
  for (int i = 0; i < 100000; ++i) text += "<a>";
  EXPECT_EQ(code_of_urdf(text), "urdf.bad_xml");
}

TEST(Urdf, WordXacroInACommentIsNoXacro) {
  EXPECT_EQ(code_of_urdf("<robot name='r'><!-- made by xacro: <xacro:include/> ${x} --><link name='a'/></robot>"), "");
}

TEST(Srdf, GivesThePairsThatMayTouchOnce) {
  RobotModel robot = *parse_urdf(two_links("fixed", ""));
  const Result<Done> added = add_srdf(R"(<robot name="r"><disable_collisions link1="a" link2="b" reason="Never"/>
    <disable_collisions link1="b" link2="a" reason="User"/><disable_collisions link1="a" link2="c"/></robot>)",
                                      robot);
  ASSERT_TRUE(added.ok());
  ASSERT_EQ(robot.may_touch.size(), 1U);
  EXPECT_EQ(robot.may_touch[0], (RobotPair{"a", "b", "SRDF: Never"}));
  ASSERT_EQ(robot.notes.size(), 1U);
  EXPECT_NE(robot.notes[0].find("\"c\" is no link"), std::string::npos) << robot.notes[0];
}

}  // namespace
}  // namespace contort
