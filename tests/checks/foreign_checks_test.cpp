// Checks of generators that are programs of their own: each has a motion just inside its limit and one just outside.
#include <gtest/gtest.h>

#include <map>

#include "checks/judge.h"
#include "model/core/math.h"
#include "tests/checks/small_character.h"

namespace contort {
namespace {

constexpr double kDegree = 1.0 * kRadPerDeg;

// Rest for three frames, with facts that say nothing wrong.
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

// The figure is said to stand while its root rises this far.
Execution rising(double room) {
  Execution made = resting();
  made.foreign->contacts = {{0, 0, made.motion.frame_count - 1}};
  made.motion.root.back().p_m.y += 0.02 - room;
  return made;
}

using ForeignExemplar = Execution (*)(double room);

const std::map<std::string, ForeignExemplar>& foreign_exemplars() {
  static const std::map<std::string, ForeignExemplar> all = {
      {"quaternion_length", with_length},
      {"off_axis", turned_off_axis},
      {"contact_slide", rising},
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
    if (check.needs != Needs::foreign) continue;
    const auto exemplar = foreign_exemplars().find(std::string(check.name));
    ASSERT_NE(exemplar, foreign_exemplars().end()) << check.name << " has no exemplar: add one to this file";
    EXPECT_TRUE(Judge().evaluate(exemplar->second(2e-6)).findings.empty()) << check.name;
    const Evaluation outside = Judge().evaluate(exemplar->second(-2e-6));
    ASSERT_EQ(outside.findings.size(), 1U) << check.name;
    EXPECT_EQ(outside.findings[0].check, check.name);
    EXPECT_NEAR(outside.findings[0].worst_margin, -2e-6, 1e-12) << check.name;
  }
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
