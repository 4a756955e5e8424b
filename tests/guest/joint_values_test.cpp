// Tables of joint values as motions of a character.
#include "guest/joint_values.h"

#include <gtest/gtest.h>

#include <cmath>

#include "checks/judge.h"
#include "tests/checks/small_character.h"

namespace contort {
namespace {

std::shared_ptr<const Character> small_one() {
  static const auto character = std::make_shared<const Character>(small::build());
  return character;
}

Result<ValuesMotion> moved(const std::string& text, const FileJoints& joints = {}, bool in_degrees = false) {
  const Result<JointTable> table = parse_joint_table(text);
  EXPECT_TRUE(table.ok()) << to_line(table.issue());
  return motion_of_values({*table, small_one(), joints, in_degrees});
}

double coord_at(const ValuesMotion& made, int frame, const char* joint) {
  const Joint& own = small_one()->joint(small_one()->find_joint(joint));
  return made.execution.motion.row(frame)[static_cast<std::size_t>(own.coord)];
}

const FileJoints kJoints = {{"l", {"arm_left/lift", 0.5}},
                            {"r", {"arm_right/lift", 0.0, "l", 2.0, 0.1}},
                            {"s", {"arm_left/slide"}},
                            {"far", {"arm_right/slide", 0.0, "s", 1.0, 0.0}},
                            {"bolt", {}}};

TEST(JointValues, MoveTheJointsThatColumnsName) {
  const Result<ValuesMotion> made = moved("t,l,arm_left/slide,hum,bolt\n0,0.6,0.01,1,0\n0.1,0.7,0.02,x,0\n", kJoints);
  ASSERT_TRUE(made.ok()) << to_line(made.issue());
  EXPECT_NEAR(coord_at(*made, 1, "arm_left/lift"), 0.2, 1e-12) << "0 of the character is 0.5 of the file";
  EXPECT_EQ(coord_at(*made, 1, "arm_left/slide"), 0.02);
  EXPECT_NEAR(coord_at(*made, 1, "arm_right/lift"), 2.0 * 0.7 + 0.1, 1e-12) << "it follows";
  EXPECT_EQ(coord_at(*made, 1, "arm_right/slide"), 0.02);
  EXPECT_EQ(made->columns, 2);
  EXPECT_EQ(made->strange_columns, std::vector<std::string>{"hum"});
  EXPECT_EQ(made->fixed_columns, std::vector<std::string>{"bolt"});
  EXPECT_EQ(made->computed.size(), 2U);
  EXPECT_EQ(made->joints_at_rest, (std::vector<std::string>{"arm_left/wrist", "arm_right/wrist"}));
  EXPECT_TRUE(made->execution.couplings.empty());
  EXPECT_DOUBLE_EQ(made->execution.motion.rate_hz, 10.0);
}

TEST(JointValues, BelongToTheJointWithoutItsPathAndEnding) {
  for (const char* name : {"l", "l/position", "l_pos", "/joint_states/l/position", "robot/l", "l.position"}) {
    const Result<ValuesMotion> made = moved("t," + std::string(name) + "\n0,0.6\n", kJoints);
    ASSERT_TRUE(made.ok()) << name << to_line(made.issue());
    EXPECT_NEAR(coord_at(*made, 0, "arm_left/lift"), 0.1, 1e-12) << name;
  }
  EXPECT_EQ(moved("t,/joint_states/l/velocity\n0,0.6\n", kJoints).issue().code, "check.nothing_matches");
  EXPECT_EQ(moved("t,l,a/l\n0,0.6,1\n", kJoints).issue().code, "table.duplicate_joint");
}

TEST(JointValues, AreInTheUnitThatTheirNameOrTheCallerSays) {
  EXPECT_NEAR(coord_at(*moved("t,l [deg]\n0,90\n", kJoints), 0, "arm_left/lift"), 0.5 * kPi - 0.5, 1e-12);
  EXPECT_NEAR(coord_at(*moved("t,l,s\n0,90,0.1\n", kJoints, true), 0, "arm_left/lift"), 0.5 * kPi - 0.5, 1e-12);
  EXPECT_EQ(coord_at(*moved("t,l,s\n0,90,0.1\n", kJoints, true), 0, "arm_left/slide"), 0.1) << "metres all the same";
  EXPECT_NEAR(coord_at(*moved("t,l [rad],s [mm]\n0,0.5,20\n", kJoints, true), 0, "arm_left/slide"), 0.02, 1e-12);
  EXPECT_EQ(moved("t,l [mm]\n0,90\n", kJoints).issue().code, "table.wrong_unit");
  EXPECT_EQ(moved("t,s [deg]\n0,90\n", kJoints).issue().code, "table.wrong_unit");
  EXPECT_EQ(moved("t,l [volt]\n0,90\n", kJoints).issue().code, "table.wrong_unit");
}

TEST(JointValues, ThatMatchNothingNameBoth) {
  const Issue issue = moved("t,a,b\n0,1,2\n", kJoints).issue();
  EXPECT_EQ(issue.code, "check.nothing_matches");
  EXPECT_NE(issue.text.find("columns are a, b; joints are far, l, r, s"), std::string::npos) << issue.text;
  EXPECT_EQ(moved("t,bolt\n0,1\n", kJoints).issue().code, "check.nothing_matches") << "it cannot move";
  const Issue own = moved("t,a\n0,1\n").issue();
  EXPECT_NE(own.text.find("joints are arm_left/slide, arm_left/lift"), std::string::npos) << own.text;
}

TEST(JointValues, OfAJointAreAllNumbers) {
  const Issue issue = moved("t,l\n0,0.6\n1,nan\n", kJoints).issue();
  EXPECT_EQ(issue.code, "table.not_finite");
  EXPECT_EQ(issue.pointer, "line 3");
}

TEST(JointValues, ThatDoNotFollowTheirLeaderAreAFinding) {
  const auto findings = [&](const char* right) {
    const Result<ValuesMotion> made = moved("t,l,r\n0,0.05,0.2\n1,0.06," + std::string(right) + "\n", kJoints);
    return Judge().evaluate(made->execution, "mimic_error").findings;
  };
  EXPECT_TRUE(findings("0.22").empty());
  EXPECT_TRUE(findings("0.23").empty()) << "half a degree off";
  const std::vector<Finding> off = findings("0.3");
  ASSERT_EQ(off.size(), 1U);
  EXPECT_EQ(off[0].subject, "arm_right/lift");
  EXPECT_EQ(off[0].worst_frame, 1);
  EXPECT_NEAR(off[0].worst_margin, 1.0 * kRadPerDeg - 0.08, 1e-9);
}

TEST(JointValues, AreJudgedAtTheirOwnTimesIfTheseAreUneven) {
  const Motion even = moved("t,l\n0.000,0.5\n0.033,0.5\n0.067,0.5\n0.100,0.5\n", kJoints)->execution.motion;
  EXPECT_TRUE(even.times_s.empty()) << "times are only rounded";
  EXPECT_NEAR(even.rate_hz, 30.0, 1e-9);
  const std::string text = "t,l\n0,0.5\n0.1,0.6\n0.2,0.7\n0.22,0.9\n0.32,1.0\n";
  const Result<ValuesMotion> uneven = moved(text, kJoints);
  EXPECT_EQ(uneven->execution.motion.times_s, (std::vector<double>{0.0, 0.1, 0.2, 0.22, 0.32}));
  const std::vector<Finding> fast = Judge().evaluate(uneven->execution).findings;
  const Finding* speed = deepest(fast, "pop", "arm_left/lift");
  ASSERT_NE(speed, nullptr) << "0.2 rad in 0.02 s are 10 rad/s, and 1 rad/s is before and after";
  EXPECT_EQ(speed->worst_frame, 3);
  EXPECT_NEAR(speed->worst_margin, 300.0 * kRadPerDeg - 10.0, 1e-9);
}

constexpr char kRootHead[] = "t,l,base_x,base_y,base_z [cm],base_qw,base_qx,base_qy,base_qz,hum\n";

std::string on_root(const std::string& numbers) { return kRootHead + std::string("0,0.6,") + numbers + ",x\n"; }

TEST(JointValues, SayWhereTheRootIsInTheAxesOfARobot) {
  // 90 degrees about +Z turn the robot to its left: from +Z to +X of the character, about +Y.
  const Result<ValuesMotion> made = moved(on_root("1,2,300,0.7071,0,0,0.7071"), kJoints);
  ASSERT_TRUE(made.ok()) << to_line(made.issue());
  EXPECT_EQ(made->execution.path, RootPath::told);
  EXPECT_EQ(made->root_columns.size(), 7U);
  EXPECT_EQ(made->strange_columns, std::vector<std::string>{"hum"});
  const Rigid root = made->execution.motion.root.at(0);
  EXPECT_LT(length(root.p_m - Vec3(2, 3, 1)), 1e-12);
  EXPECT_LT(length(root.q * Vec3(0, 0, 1) - Vec3(1, 0, 0)), 1e-12);
}

TEST(JointValues, SayWhereTheRootIsInTheCharactersAxesIfAsked) {
  const Result<JointTable> table = parse_joint_table(on_root("1,2,300,0.7071,0,0.7071,0"));
  const Result<ValuesMotion> made = motion_of_values({*table, small_one(), kJoints, false, true});
  const Rigid root = made->execution.motion.root.at(0);
  EXPECT_LT(length(root.p_m - Vec3(1, 2, 3)), 1e-12);
  EXPECT_LT(length(root.q * Vec3(0, 0, 1) - Vec3(1, 0, 0)), 1e-12);
}

TEST(JointValues, TurnTheRootFromTheRestOfItsBodyInTheFile) {
  const Result<JointTable> table = parse_joint_table(on_root("0,0,0,0,0,0,1"));
  const double half = std::sqrt(0.5);
  const Result<ValuesMotion> made = motion_of_values({*table, small_one(), kJoints, false, false, {half, 0, 0, half}});
  EXPECT_LT(length(made->execution.motion.root.at(0).q * Vec3(0, 0, 1) - Vec3(1, 0, 0)), 1e-12)
      << "half a turn, of which a quarter is that of the file";
}

TEST(JointValues, OfTheRootAreAllThereOnce) {
  const Issue incomplete = moved("t,l,root_x,root_y,root_qw\n0,0,0,0,1\n", kJoints).issue();
  EXPECT_EQ(incomplete.code, "table.incomplete_root");
  EXPECT_NE(incomplete.text.find("\"root_x\", \"root_y\", \"root_qw\"; missing are root_z, root_qx, root_qy, root_qz"),
            std::string::npos)
      << incomplete.text;
  const Issue twice = moved("t,l,root_x,pose.position.x\n0,0,0,0\n", kJoints).issue();
  EXPECT_EQ(twice.code, "table.duplicate_root");
  EXPECT_NE(twice.text.find("\"root_x\" and \"pose.position.x\""), std::string::npos) << twice.text;
  const FileJoints slides = {{"l", {"arm_left/lift"}}, {"root_x", {"arm_left/slide"}}};
  EXPECT_EQ(moved("t,l,root_x\n0,0,0\n", slides)->columns, 2) << "a joint of this name comes first";
}

TEST(JointValues, OfTheRootAreNumbersAndRotations) {
  EXPECT_EQ(moved(on_root("0,0,oops,1,0,0,0"), kJoints).issue().code, "table.bad_number");
  EXPECT_EQ(moved("t,l,root_x [deg],root_y,root_z,root_qw,root_qx,root_qy,root_qz\n0,0,0,0,0,1,0,0,0\n", kJoints).issue().code,
            "table.wrong_unit");
  for (const char* bad : {"0,0,0,0,0,0,0", "0,0,0,1,0,0,0.3", "0,0,0,0.5,0.5,0.5,0"}) {
    const Issue issue = moved(on_root(bad), kJoints).issue();
    EXPECT_EQ(issue.code, "table.bad_quaternion") << bad;
    EXPECT_EQ(issue.pointer, "row 1");
  }
}

TEST(JointValues, HaveNoPathOfTheRoot) {
  const Result<ValuesMotion> made = moved("t,arm_left/lift\n0,0.5\n1,0.5\n");
  EXPECT_EQ(made->execution.path, RootPath::unknown);
  const Evaluation judged = Judge().evaluate(made->execution);
  EXPECT_TRUE(judged.findings.empty());
  for (const JudgedCheck& check : judged.judged) EXPECT_NE(check.check, "ground_penetration");
}

}  // namespace
}  // namespace contort
