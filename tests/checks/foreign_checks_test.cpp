// Checks of generators that are programs of their own: each has a motion just inside its limit and one just outside.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "checks/judge.h"
#include "model/core/math.h"
#include "model/motion/kinematics.h"
#include "tests/checks/small_character.h"

namespace contort {
namespace {

constexpr double kDegree = 1.0 * kRadPerDeg;

// Rest for three frames, with facts without faults.
Execution resting() {
  Execution made;
  made.character = std::make_shared<const Character>(small::build());
  const Character& character = *made.character;
  made.motion.frame_count = 3;
  made.motion.coord_count = character.coord_count();
  for (int frame = 0; frame < 3; ++frame) {
    made.motion.root.push_back(character.rest_root());
    made.motion.coords.insert(made.motion.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
  }
  ForeignFacts& facts = made.foreign.emplace();
  facts.quaternion_lengths.assign(3 * character.joints().size(), 1.0);
  facts.off_axis_rad.assign(3 * character.joints().size(), 0.0);
  return made;
}

std::size_t first_of(const Character& character, JointKind kind) {
  for (std::size_t j = 1; j < character.joints().size(); ++j)
    if (character.joints()[j].kind == kind) return j;
  return 0;
}

// A motion of one frame that is equal but for the first hinge, which is off by this angle.
EqualMotion off_by(const Execution& made, Equality why, double angle_rad) {
  EqualMotion other{why, 1, 1, {}, {made.motion.root[1]}};
  other.coords.assign(made.motion.row(1).begin(), made.motion.row(1).end());
  const Joint& hinge = made.character->joints()[first_of(*made.character, JointKind::hinge)];
  other.coords[static_cast<std::size_t>(hinge.coord)] += angle_rad;
  return other;
}

Execution with_other(Equality why, double limit_rad, double room) {
  Execution made = resting();
  made.foreign->equals.push_back(off_by(made, why, limit_rad - room));
  return made;
}

Execution with_length(double room) {
  Execution made = resting();
  made.foreign->quaternion_lengths[1] = 1.001 - room;
  return made;
}

Execution turned_off_axis(double room) {
  Execution made = resting();
  made.foreign->off_axis_rad[first_of(*made.character, JointKind::hinge)] = kDegree - room;
  return made;
}

// The figure is declared to stand while its root rises by this distance.
Execution rising(double room) {
  Execution made = resting();
  made.foreign->contacts = {{0, 0, made.motion.frame_count - 1}};
  made.motion.root.back().p_m.y += 0.02 - room;
  return made;
}

constexpr int kPopFrame = 6;  // of twelve frames

// Rest, except that from one frame on the root is higher, or rotated.
Execution root_elsewhere(double up_m, double turn_rad) {
  Execution made = resting();
  Motion& motion = made.motion;
  const std::vector<double> row(motion.row(0).begin(), motion.row(0).end());
  for (; motion.frame_count < 12; ++motion.frame_count) {
    motion.root.push_back(made.character->rest_root());
    motion.coords.insert(motion.coords.end(), row.begin(), row.end());
  }
  for (int frame = kPopFrame; frame < 12; ++frame) {
    Rigid& root = motion.root[static_cast<std::size_t>(frame)];
    root.p_m.y += up_m;
    root.q = axis_angle(Vec3(0, 1, 0), turn_rad) * root.q;
  }
  made.foreign->quaternion_lengths.assign(12 * made.character->joints().size(), 1.0);
  made.foreign->off_axis_rad.assign(12 * made.character->joints().size(), 0.0);
  return made;
}

// A twentieth of the figure's size.
Execution root_raised(double room) {
  const Character character = small::build();
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  Vec3 low = world[0].p_m, high = low;
  for (const Rigid& joint : world) low = glm::min(low, joint.p_m), high = glm::max(high, joint.p_m);
  const Vec3 size = high - low;
  return root_elsewhere(0.05 * std::max({0.2, size.x, size.y, size.z}) - room, 0.0);
}

// The right arm must lift half as far as the left one, and a degree more.
Execution not_following(double room) {
  Execution made = resting();
  const int left = made.character->find_joint("arm_left/lift"), right = made.character->find_joint("arm_right/lift");
  made.couplings = {{right, left, 0.5, kDegree}};
  for (int frame = 0; frame < made.motion.frame_count; ++frame) {
    made.motion.row(frame)[static_cast<std::size_t>(made.character->joint(left).coord)] = 4.0 * kDegree;
    made.motion.row(frame)[static_cast<std::size_t>(made.character->joint(right).coord)] = 2.0 * kDegree + room;
  }
  return made;
}

TEST(ForeignChecks, AFollowerThatIsReadFromARotationMayBeWholeTurnsAway) {
  Execution made = not_following(2e-6);
  const Joint& right = made.character->joint(made.couplings[0].joint);
  for (int frame = 0; frame < made.motion.frame_count; ++frame)
    made.motion.row(frame)[static_cast<std::size_t>(right.coord)] -= 2.0 * kPi;
  const auto count = [&] { return Judge().evaluate(made, "mimic_error").findings.size(); };
  EXPECT_EQ(count(), 1U);
  made.couplings[0].is_of_rotation = true;
  EXPECT_EQ(count(), 0U);
}

using ForeignExemplar = Execution (*)(double room);

const std::map<std::string, ForeignExemplar>& foreign_exemplars() {
  static const std::map<std::string, ForeignExemplar> all = {
      {"quaternion_length", with_length},
      {"off_axis", turned_off_axis},
      {"contact_slide", rising},
      {"root_pop", root_raised},
      {"mimic_error", not_following},
      {"rest_error", [](double room) { return with_other(Equality::rest, kDegree, room); }},
      {"fresh_error", [](double room) { return with_other(Equality::fresh, kDegree, room); }},
      {"none_error", [](double room) { return with_other(Equality::none, kDegree, room); }},
      {"history_error", [](double room) { return with_other(Equality::history, kDegree, room); }},
      {"undo_error", [](double room) { return with_other(Equality::undo, kDegree, room); }},
      {"gain_error", [](double room) { return with_other(Equality::gain, 5.0 * kDegree, room); }},
      {"mirror_error", [](double room) { return with_other(Equality::mirror, kDegree, room); }},
      {"rate_error", [](double room) { return with_other(Equality::rate, 5.0 * kDegree, room); }},
  };
  return all;
}

TEST(ForeignChecks, HaveALimitThatTheyKeep) {
  for (const CheckDef& check : all_checks()) {
    if (check.needs != Needs::foreign && check.needs != Needs::couplings) continue;
    const auto exemplar = foreign_exemplars().find(std::string(check.name));
    ASSERT_NE(exemplar, foreign_exemplars().end()) << check.name << " has no exemplar: add one to this file";
    EXPECT_TRUE(Judge().evaluate(exemplar->second(2e-6)).findings.empty()) << check.name;
    const Evaluation outside = Judge().evaluate(exemplar->second(-2e-6));
    ASSERT_EQ(outside.findings.size(), 1U) << check.name;
    EXPECT_EQ(outside.findings[0].check, check.name);
    EXPECT_NEAR(outside.findings[0].worst_margin, -2e-6, 1e-12) << check.name;
  }
}

std::vector<std::string> pops_of_root(const Execution& made) {
  std::vector<std::string> subjects;
  for (const Finding& finding : Judge().evaluate(made, "root_pop").findings) subjects.push_back(finding.subject);
  return subjects;
}

TEST(RootPop, IsATurnThatTheDeclaredSpeedDoesNotAllow) {
  Execution made = root_elsewhere(0.0, 0.3);
  EXPECT_TRUE(pops_of_root(root_elsewhere(0.0, 0.2)).empty());
  made.foreign->root_max_speed_rad_s = 0.29 * made.motion.rate_hz;
  EXPECT_EQ(pops_of_root(made), std::vector<std::string>{"root rotation"});
  made.foreign->root_max_speed_rad_s = 0.31 * made.motion.rate_hz;
  EXPECT_TRUE(pops_of_root(made).empty());
}

TEST(RootPop, IsNoneWhereTheManifestAllowsOne) {
  Execution made = root_elsewhere(0.5, 1.0);
  EXPECT_EQ(pops_of_root(made).size(), 2U);
  made.foreign->travels = {{kPopFrame - 2, kPopFrame}};
  EXPECT_TRUE(pops_of_root(made).empty());
  made.foreign->travels = {{0, kPopFrame - 1}};
  EXPECT_EQ(pops_of_root(made).size(), 2U);
  made.foreign->jumps = {kPopFrame};
  EXPECT_TRUE(pops_of_root(made).empty());
}

TEST(RootPop, IsNoneInAWalkThatBeginsAtOnce) {
  Execution made = root_elsewhere(0.0, 0.0);
  for (int frame = kPopFrame; frame < 12; ++frame)
    made.motion.root[static_cast<std::size_t>(frame)].p_m.z += 0.2 * (frame - kPopFrame + 1);
  EXPECT_TRUE(pops_of_root(made).empty());
}

TEST(ForeignChecks, DoNotJudgeTheBuiltInGenerator) {
  Execution made = with_length(-1.0);
  made.foreign.reset();
  const Evaluation evaluation = Judge().evaluate(made);
  EXPECT_TRUE(evaluation.findings.empty());
  for (const JudgedCheck& judged : evaluation.judged) EXPECT_FALSE(foreign_exemplars().contains(std::string(judged.check)));
}

TEST(ForeignChecks, CompareTheRootByPositionAndByRotation) {
  Execution made = resting();
  EqualMotion other = off_by(made, Equality::fresh, 0.0);
  other.root[0].p_m.x += 0.02;
  other.root[0].q = axis_angle(Vec3(0.0, 1.0, 0.0), 0.1) * other.root[0].q;
  made.foreign->equals = {other};
  const Evaluation evaluation = Judge().evaluate(made);
  ASSERT_EQ(evaluation.findings.size(), 2U);
  EXPECT_EQ(evaluation.findings[0].subject, "root position");
  EXPECT_NEAR(evaluation.findings[0].worst_margin, 0.01 - 0.02, 1e-12);
  EXPECT_EQ(evaluation.findings[1].subject, "root rotation");
}

// A jump is excused in the frame in which an action may cut, and in no other.
TEST(ForeignChecks, ExcuseJumpsOnlyWhereTheManifestAllowsThem) {
  Execution made = resting();
  const Joint& hinge = made.character->joints()[first_of(*made.character, JointKind::hinge)];
  for (int frame = 1; frame < 3; ++frame) made.motion.row(frame)[static_cast<std::size_t>(hinge.coord)] = 0.5;
  EXPECT_FALSE(Judge().evaluate(made, "pop").findings.empty());
  made.foreign->jumps = {2};
  EXPECT_FALSE(Judge().evaluate(made, "pop").findings.empty());
  made.foreign->jumps = {1};
  for (const char* check : {"pop", "angular_velocity", "angular_acceleration"})
    EXPECT_TRUE(Judge().evaluate(made, check).findings.empty()) << check;
}

}  // namespace
}  // namespace contort
