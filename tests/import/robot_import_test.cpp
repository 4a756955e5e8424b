#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "formats/robot/meshes.h"
#include "formats/robot/mjcf.h"
#include "formats/robot/read.h"
#include "formats/robot/urdf.h"
#include "model/core/index.h"
#include "tests/corpus/temp_folder.h"
#include "tests/robot/robot_text.h"

namespace contort {
namespace {

using fixtures::character_of;
using fixtures::in_mujoco;
using fixtures::two_links;

ImportedRobot import_urdf(const std::string& text) { return *import_robot(*parse_urdf(text), "r"); }

const JointDesc& only_joint(const ImportedRobot& robot) {
  for (const PartDesc& part : robot.parts)
    if (!part.joints.empty()) return part.joints.front();
  throw std::runtime_error("no joint");
}

bool says(const std::vector<std::string>& notes, const std::string& what) {
  return std::ranges::any_of(notes, [&](const std::string& text) { return text.find(what) != std::string::npos; });
}

// A file in Latin-1, a character that is cut off, and an invalid character number. Found by libFuzzer.
TEST(RobotImport, NamesThatAreNotUtf8AreImportedWithReplacements) {
  for (const std::string name : {"\xe1rm", "arm\xc3", "\xed\xa0\x80", "&#xD800;", "\xf8\x88\x80\x80\x80", "\xc3\xa4rm"}) {
    std::string text = two_links("revolute", R"(<limit lower="-1" upper="2" velocity="3" effort="4"/>)");
    text.replace(text.find("name=\"j\""), 8, "name=\"" + name + "\"");
    const Result<RobotModel> robot = parse_urdf(text);
    ASSERT_TRUE(robot) << name;
    const Result<ImportedRobot> imported = import_robot(*robot, "r");
    ASSERT_TRUE(imported) << name;
    for (const ImportFile& file : imported->files) EXPECT_FALSE(file.text.empty()) << name;
  }
}

TEST(RobotImport, KeepsLimitsSpeedAndEffort) {
  const JointDesc joint =
      only_joint(import_urdf(two_links("revolute", R"(<limit lower="-1" upper="2" velocity="3" effort="4"/>)")));
  EXPECT_NEAR(joint.low_deg, -kDegPerRad, 1e-12);
  EXPECT_NEAR(joint.high_deg, 2.0 * kDegPerRad, 1e-12);
  EXPECT_NEAR(joint.max_speed_deg_s, 3.0 * kDegPerRad, 1e-12);
  EXPECT_EQ(joint.strength_high, 4.0);
  EXPECT_EQ(joint.strength_low, -4.0);
  const JointDesc travel =
      only_joint(import_urdf(two_links("prismatic", R"(<limit lower="0" upper="0.2" velocity="3" effort="4"/>)")));
  EXPECT_EQ(travel.type, JointType::prismatic);
  EXPECT_EQ(travel.high_m, 0.2);
  EXPECT_EQ(travel.max_speed_m_s, 3.0);
}

TEST(RobotImport, EffortAndVelocityOfZeroAreTakenAsNotDeclared) {
  const ImportedRobot robot =
      import_urdf(two_links("revolute", R"(<limit lower="-1" upper="2" velocity="0" effort="0"/>)"));
  EXPECT_EQ(only_joint(robot).max_speed_deg_s, 3000.0);
  EXPECT_GT(only_joint(robot).strength_high, 0.0);
  EXPECT_NE(robot.joints[0].remark.find("no greatest speed is declared"), std::string::npos);
  EXPECT_NE(robot.joints[0].remark.find("no greatest effort is declared"), std::string::npos);
}

TEST(RobotImport, RestIsTheMiddleOfARangeWithoutZero) {
  const ImportedRobot robot = import_urdf(two_links("revolute", R"(<axis xyz="0 0 1"/><limit lower="1" upper="3"/>)"));
  EXPECT_NEAR(only_joint(robot).low_deg, -kDegPerRad, 1e-12);
  EXPECT_NEAR(only_joint(robot).high_deg, kDegPerRad, 1e-12);
  EXPECT_EQ(robot.joints[0].rest, 2.0);
  EXPECT_NEAR(only_joint(robot).rotation_deg.y, 2.0 * kDegPerRad, 1e-9) << "+Z of the file is +Y of a character";
}

TEST(RobotImport, ContinuousJointsEndAt360DegreesAndThisIsSaid) {
  const ImportedRobot robot = import_urdf(two_links("continuous", ""));
  EXPECT_EQ(only_joint(robot).low_deg, -360.0);
  EXPECT_EQ(only_joint(robot).high_deg, 360.0);
  EXPECT_NE(robot.joints[0].remark.find("end at 360 degrees"), std::string::npos);
}

TEST(RobotImport, JointWithoutARangeIsFixed) {
  const ImportedRobot robot = import_urdf(two_links("revolute", R"(<limit lower="0" upper="0"/>)"));
  for (const PartDesc& part : robot.parts) EXPECT_TRUE(part.joints.empty());
  EXPECT_EQ(robot.joints[0].joint, "");
  EXPECT_EQ(robot.mass_kg, 3.0);
}

TEST(RobotImport, FollowingJointIsSaid) {
  const ImportedRobot robot =
      import_urdf(two_links("prismatic", R"(<limit lower="0" upper="1"/><mimic joint="other" multiplier="-2"/>)"));
  EXPECT_NE(robot.joints[0].remark.find("follows other * -2 + 0"), std::string::npos) << robot.joints[0].remark;
  EXPECT_NE(robot.files.back().text.find("follows other"), std::string::npos) << "the report says it";
}

// Three links in a row whose shapes do not touch at rest.
std::string three_in_a_row() {
  std::string text = "<robot name=\"r\">";
  for (const char* link : {"a", "b", "c"})
    text += "<link name=\"" + std::string(link) +
            "\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial><collision><geometry>"
            "<sphere radius=\"0.1\"/></geometry></collision></link>";
  for (const char* pair : {"ab", "bc"})
    text += "<joint name=\"" + std::string(pair) +
            "\" type=\"revolute\"><origin xyz=\"0 0 1\"/><axis xyz=\"0 1 0\"/>"
            "<parent link=\"" +
            pair[0] + "\"/><child link=\"" + pair[1] + "\"/><limit lower=\"-1\" upper=\"1\"/></joint>";
  return text + "</robot>";
}

TEST(RobotImport, PairsOfTheSrdfAreAllowedAndOthersAreJudged) {
  RobotModel model = *parse_urdf(three_in_a_row());
  const ImportedRobot strict = *import_robot(model, "r");
  EXPECT_EQ(character_of(strict)->judged_pairs().size(), 1U) << "a and c; neighbours may always touch";
  ASSERT_TRUE(
      add_srdf(R"(<robot name="r"><disable_collisions link1="c" link2="a" reason="Never"/></robot>)", model).ok());
  const ImportedRobot lenient = *import_robot(model, "r");
  EXPECT_EQ(lenient.pairs_of_file, 1);
  EXPECT_EQ(lenient.character.allowed_pairs.at(0).reason, "SRDF: Never");
  EXPECT_TRUE(character_of(lenient)->judged_pairs().empty());
}

TEST(RobotImport, StandsUpInACharactersAxes) {
  const Character character = *character_of(import_urdf(three_in_a_row()));
  EXPECT_EQ(character.joints().back().parent_from_joint.p_m, Vec3(0, 1, 0));
  EXPECT_EQ(character.joints().back().axis, Vec3(1, 0, 0)) << "left is +Y of the file";
}

TEST(RobotImport, MeshThatIsNotFoundGivesACapsuleOfTheInertia) {
  const std::string text = R"(<robot name="r"><link name="a"><inertial><mass value="3"/><inertia ixx="0.25" iyy="0.25"
    izz="0.01"/></inertial><collision><geometry><mesh filename="package://none/a.stl"/></geometry></collision></link>
    </robot>)";
  const TempFolder folder;
  std::ofstream(folder.path() + "/r.urdf") << text;
  const ImportedRobot robot = *import_robot(*read_robot(folder.path() + "/r.urdf", ""), "r");
  ASSERT_EQ(robot.parts[0].colliders.size(), 1U);
  const auto* capsule = std::get_if<Capsule>(&robot.parts[0].colliders[0].shape);
  ASSERT_NE(capsule, nullptr);
  EXPECT_GT(glm::distance(capsule->a_m, capsule->b_m), 4.0 * capsule->radius_m) << "it is long and thin";
  EXPECT_TRUE(says(robot.notes, "not found: a.stl"));
  EXPECT_TRUE(says(robot.notes, "guessed from a body's mass"));
}

// A tetrahedron with a corner at the origin.
std::string small_stl() {
  return "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
         "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid t\n";
}

TEST(RobotImport, MeshInAPackageBecomesItsHull) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() + "/arm_description/urdf");
  std::filesystem::create_directories(folder.path() + "/arm_description/meshes");
  std::ofstream(folder.path() + "/arm_description/meshes/a.stl") << small_stl();
  const std::string file = folder.path() + "/arm_description/urdf/r.urdf";
  std::ofstream(file) << R"(<robot name="r"><link name="a"><collision><geometry><mesh
    filename="package://arm_description/meshes/a.stl" scale="2 2 2"/></geometry></collision></link></robot>)";
  const ImportedRobot robot = *import_robot(*read_robot(file, ""), "r");
  ASSERT_EQ(robot.parts[0].colliders.size(), 1U);
  const auto* hull = std::get_if<ConvexHull>(&robot.parts[0].colliders[0].shape);
  ASSERT_NE(hull, nullptr);
  EXPECT_EQ(hull->points_m.size(), 4U);
  EXPECT_NE(std::ranges::find(hull->points_m, Vec3(0, 2, 0)), hull->points_m.end());
  EXPECT_NE(find_mesh(file, "../meshes/a.stl"), "");
  EXPECT_NE(find_mesh(file, "package://another_name/meshes/a.stl"), "") << "copies of packages have other names";
  EXPECT_EQ(find_mesh(file, "package://arm_description/urdf/../meshes/a.stl"), "");
  EXPECT_EQ(find_mesh(file, "/etc/hostname"), "");
  EXPECT_EQ(find_mesh(file, "file:///etc/hostname"), "");
}

TEST(RobotImport, FaultyMeshesAreRefused) {
  const std::string binary = std::string(80, ' ') + std::string("\xff\xff\xff\x7f", 4);
  EXPECT_EQ(mesh_points(binary, ".stl").issue().code, "mesh.truncated");
  EXPECT_EQ(mesh_points("solid x", ".stl").issue().code, "mesh.no_vertices");
  EXPECT_EQ(mesh_points("v 1 2 nan\n", ".obj").issue().code, "mesh.bad_number");
  EXPECT_EQ(mesh_points("v 1 2 3\n", ".dae").issue().code, "mesh.other_format");
  EXPECT_EQ(mesh_points("# c\nv 1 2 3\nvn 0 0 1\n", ".OBJ")->size(), 1U);
}

TEST(RobotImport, RobotWithoutMassesIsRemarked) {
  EXPECT_TRUE(says(import_urdf(R"(<robot name="r"><link name="a"/></robot>)").notes, "no masses"));
  EXPECT_FALSE(says(import_urdf(two_links("fixed", "")).notes, "no masses"));
}

TEST(RobotImport, LongRobotIsCutIntoSeveralParts) {
  std::string text = "<robot name=\"r\"><link name=\"l0\"/>";
  for (int i = 1; i <= 150; ++i)
    text += "<link name=\"l" + std::to_string(i) + "\"/><joint name=\"j" + std::to_string(i) +
            "\" type=\"continuous\"><parent link=\"l" + std::to_string(i - 1) + "\"/><child link=\"l" +
            std::to_string(i) + "\"/></joint>";
  const ImportedRobot robot = import_urdf(text + "</robot>");
  EXPECT_EQ(robot.parts.size(), 4U);
  EXPECT_EQ(character_of(robot)->joints().size(), 151U);
}

TEST(RobotImport, SecondAndThirdJointOfABodyKeepTheirAnchors) {
  const std::string world = R"(<body name="a"><freejoint/><geom size="0.1"/><body name="b" pos="0 0 1"><joint name="x"
    pos="0 0 0.1" axis="1 0 0"/><joint name="y" pos="0 0 0.3" axis="0 1 0"/><geom size="0.1"/></body></body>)";
  const RobotModel model = *parse_mjcf(in_mujoco(world), [](const std::string&) { return Issue{}; });
  const Character character = *character_of(*import_robot(model, "r"));
  ASSERT_EQ(character.joints().size(), 3U);
  EXPECT_NEAR(character.joint(1).parent_from_joint.p_m.y, 1.1, 1e-12);
  EXPECT_NEAR(character.joint(2).parent_from_joint.p_m.y, 0.2, 1e-12);
  const auto& shape = std::get<Sphere>(character.colliders().back().shape);
  EXPECT_NEAR(shape.center_m.y, -0.3, 1e-12) << "the body's own origin";
}

}  // namespace
}  // namespace contort
