// Skeletons of motion capture as characters.
#include "import/asf_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "formats/mocap/asf.h"
#include "import/robot.h"
#include "model/core/index.h"
#include "tests/cli/program.h"
#include "tests/robot/robot_text.h"

namespace contort {
namespace {

// A trunk with a leg of two bones on either side, in inches of 1 / 0.5; 34 units are 1.7 m.
constexpr char kWalker[] = R"(:version 1.10
:name walker
:units
  length 0.5
  angle deg
:root
  order TX TY TZ RX RY RZ
  axis XYZ
  position 0 0 0
  orientation 0 0 0
:bonedata
begin
name trunk
direction 0 1 0
length 16
axis 0 0 0 XYZ
dof ry
limits (-30 30)
end
begin
name lhipjoint
direction 1 0 0
length 2
axis 0 0 0 XYZ
end
begin
name lfemur
direction 0 -1 0
length 9
axis 0 0 20 XYZ
dof rx ry rz
limits (-160 20)
(-70 70)
(-60 50)
end
begin
name ltibia
direction 0 -1 0
length 9
axis 0 0 0 XYZ
dof rx
limits (-10 170)
end
:hierarchy
begin
root trunk lhipjoint
lhipjoint lfemur
lfemur ltibia
end
)";

RobotModel walker(const ImportOptions& options = {}) { return robot_of_asf(*parse_asf(kWalker), options); }

const RobotBody& body(const RobotModel& robot, const char* name) { return robot.bodies[at(find_body(robot, name))]; }

TEST(AsfImport, KeepsLimitsAxesAndPlaces) {
  const RobotModel robot = walker();
  const std::vector<RobotJoint>& femur = body(robot, "lfemur").joints;
  ASSERT_EQ(femur.size(), 3U);
  EXPECT_EQ(femur[0].name, "lfemur_rz") << "it is applied last, so that it is outermost";
  EXPECT_EQ(femur[2].name, "lfemur_rx");
  EXPECT_NEAR(femur[2].low, -160.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(femur[0].high, 50.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(femur[2].axis.y, std::cos(20.0 * kRadPerDeg), 1e-12) << "+X of the file is +Y of a robot";
  EXPECT_NEAR(femur[2].axis.z, std::sin(20.0 * kRadPerDeg), 1e-12);
  EXPECT_TRUE(body(robot, "lhipjoint").joints.empty());
  EXPECT_NEAR(body(robot, "ltibia").parent_from_body.p_m.z, -9.0 * 0.0254 / 0.5, 1e-12) << "inches";
}

TEST(AsfImport, IsInMetres) {
  const auto shin_m = [](const ImportOptions& options) {
    return -body(walker(options), "ltibia").parent_from_body.p_m.z;
  };
  ImportOptions scaled, tall;
  scaled.metres_per_unit = 0.1, tall.height_m = 3.4;
  EXPECT_NEAR(shin_m(scaled), 0.9, 1e-12);
  EXPECT_NEAR(shin_m(tall), 0.9, 1e-12) << "34 units are 3.4 m";
  std::string strange = kWalker;
  strange.replace(strange.find("length 0.5"), 10, "length 1e5");
  const RobotModel small = robot_of_asf(*parse_asf(strange), {});
  EXPECT_NEAR(-body(small, "ltibia").parent_from_body.p_m.z, 0.9, 1e-9) << "no inches: 34 units would be 8.6 micrometres";
}

TEST(AsfImport, WeighsWhatPeopleOfItsHeightWeigh) {
  const ImportedRobot made = *import_robot(walker(), "walker");
  const double height_m = 34.0 * 0.0254 / 0.5;
  EXPECT_NEAR(made.mass_kg, 24.1 * height_m * height_m, 1e-6);
  for (const PartDesc& part : made.parts) EXPECT_FALSE(part.colliders.empty()) << part.name;
  EXPECT_TRUE(std::ranges::any_of(made.character.slots, [](const SlotDesc& s) { return s.name == "leg_left"; }));
}

std::string amc_of(const std::vector<std::string>& shins, const std::string& femur) {
  std::string out = ":fully-specified\n:degrees\n";
  for (std::size_t i = 0; i < shins.size(); ++i)
    out += std::to_string(i + 1) + "\nroot 0 18 0 0 0 0\ntrunk 0\nlfemur " + femur + "\nltibia " + shins[i] + "\n";
  return out;
}

TEST(AsfImport, JudgesItsMotionsAsThoseOfTheCharacter) {
  const TempFolder folder;
  spill(folder / "walker.asf", kWalker);
  const Ran imported = contort_program({"import", folder / "walker.asf", "-o", folder / "people"});
  ASSERT_EQ(imported.code, 0) << imported.err;
  const auto check = [&](const std::string& amc) {
    spill(folder / "walk.amc", amc);
    return contort_program({"--library", folder / "people", "check", folder / "walk.amc", "--character", "walker"});
  };
  const Ran fine = check(amc_of({"20", "21", "22", "23"}, "-30 20 10"));
  EXPECT_EQ(fine.code, 0) << fine.out << fine.err;
  EXPECT_EQ(fine.out.find("left out"), std::string::npos) << "three hinges take over all of a turn: " << fine.out;
  EXPECT_NE(fine.out.find("ground_penetration"), std::string::npos);
  const Ran bent = check(amc_of({"-20", "-20", "-20", "-20"}, "0 0 60"));
  EXPECT_EQ(bent.code, 1);
  EXPECT_NE(bent.out.find("joint_range  ltibia rx min"), std::string::npos) << bent.out;
  EXPECT_NE(bent.out.find("joint_range  lfemur rz max"), std::string::npos) << bent.out;
}

TEST(AsfImport, RefusesOptionsOfModels) {
  const TempFolder folder;
  spill(folder / "walker.asf", kWalker);
  const Ran ran = contort_program({"import", folder / "walker.asf", "-o", folder / "people", "--mesh"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_NE(ran.err.find("import.not_for_skeletons"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace contort
