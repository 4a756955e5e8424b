// The audit of a generator: its rows, its draws and its counts.
#include "fuzz/audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/fuzz/small_runs.h"
#include "tests/swing_generator.h"

namespace contort {
namespace {

using swing::SwingGenerator;

std::vector<AuditRow> rows_of(const AuditOptions& options, Generator& generator) {
  Result<std::vector<AuditRow>> rows = audit_rows(options, generator);
  EXPECT_TRUE(rows) << to_line(rows.issue());
  return rows ? std::move(rows).value() : std::vector<AuditRow>{};
}

std::vector<AuditRow> audited(const AuditOptions& options, Generator& generator) {
  std::vector<AuditRow> rows = rows_of(options, generator);
  const Result<Done> done = audit(options, {}, generator, rows, [](int) {});
  EXPECT_TRUE(done) << to_line(done.issue());
  return rows;
}

int sum_of_findings(const AuditRow& row) {
  int sum = 0;
  for (const auto& [check, count] : row.findings) sum += count;
  return sum;
}

TEST(Audit, HasARowForEachActionOfEachPartOnce) {
  BuiltInGenerator generator(stock_library());
  std::set<std::string> seen;
  for (const AuditRow& row : rows_of({}, generator)) {
    std::string objects;
    for (const AttachmentDesc& attachment : row.character.attachments)
      objects += attachment.object + " at " + attachment.slot + "/" + attachment.socket;
    EXPECT_TRUE(seen.insert(row.character.name + " " + objects + " " + row.slot + " " + row.part + " " + row.action +
                            " " + row.point)
                    .second)
        << row.character.name << " " << row.slot << " " << row.action;
  }
  for (const std::string& action : generator.manifest().actions)
    EXPECT_TRUE(std::ranges::any_of(seen, [&](const std::string& name) {
      return name.find(" " + action + " ") != std::string::npos;
    })) << action;
}

TEST(Audit, MakesTheSameMotionsAsThoseOfFiguresWithMass) {
  BuiltInGenerator generator(stock_library());
  AuditOptions options;
  options.characters = {"human"}, options.actions = {"turn"}, options.draws = 2;
  const AuditRow kinematic = rows_of(options, generator).front();
  options.dynamics = Mode::dynamic;
  const AuditRow dynamic = rows_of(options, generator).front();
  Spec drawn = audit_spec(dynamic, generator, 1, 0);
  EXPECT_EQ(drawn.dynamics.mode, Mode::dynamic);
  drawn.dynamics.mode = Mode::kinematic;
  EXPECT_EQ(drawn, audit_spec(kinematic, generator, 1, 0));
}

TEST(Audit, HasARowForEveryPartWithJointsThatASlotMayHold) {
  BuiltInGenerator generator(stock_library());
  std::set<std::string> parts, with_joints;
  for (const AuditRow& row : rows_of({}, generator)) parts.insert(row.part);
  for (const auto& [name, desc] : stock_library().characters)
    for (const SlotDesc& slot : desc.slots)
      for (const std::string& part : slot.parts)
        if (!stock_library().parts.at(part).joints.empty()) with_joints.insert(part);
  EXPECT_TRUE(std::ranges::includes(parts, with_joints));
}

TEST(Audit, DrawsOneActionInsideItsLimitsAndAtTheirEndsToo) {
  SwingGenerator generator;
  const AuditRow row = rows_of({}, generator).at(0);
  std::set<double> angles;
  for (int i = 0; i < 200; ++i) {
    const Spec spec = audit_spec(row, generator, 1, i);
    ASSERT_EQ(spec.sequences.size(), 1U);
    ASSERT_EQ(spec.sequences[0].clips.size(), 1U);
    ASSERT_EQ(spec.sequences[0].clips[0].actions.size(), 1U);
    const ActionUse& use = spec.sequences[0].clips[0].actions[0];
    angles.insert(use.params.contains("angle_deg") ? std::get<double>(use.params.at("angle_deg")) : 0.0);
  }
  EXPECT_EQ(*angles.begin(), -120.0);
  EXPECT_EQ(*angles.rbegin(), 120.0);
  EXPECT_TRUE(angles.contains(0.0)) << "its value where a spec does not say one";
  EXPECT_GT(angles.size(), 100U);
}

TEST(Audit, AsksForNoWallOfAGeneratorThatKnowsNone) {
  SwingGenerator generator;
  const AuditRow row = rows_of({}, generator).at(0);
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(audit_spec(row, generator, 1, i).environment.obstacles.empty());
}

TEST(Audit, CountsEveryDrawOnceAndKeepsTheWorst) {
  SwingGenerator generator;
  AuditOptions options;
  options.draws = 60;
  const AuditRow row = audited(options, generator).at(0);
  EXPECT_EQ(row.draws, 60);
  EXPECT_GT(row.clean, 0);
  EXPECT_LT(row.clean, 60) << "half a turn within a frame is found";
  EXPECT_GE(sum_of_findings(row), 60 - row.clean);
  Evaluator evaluator(generator);
  const Result<Evaluation> again = evaluator.run(row.worst);
  ASSERT_TRUE(again) << to_line(again.issue());
  EXPECT_TRUE(std::ranges::any_of(again->findings, [&](const Finding& found) { return found.depth == row.depth; }));
}

TEST(Audit, DoesNotDependOnTheNumberOfThreads) {
  AuditOptions one, three;
  one.draws = three.draws = 25, three.jobs = 3;
  one.characters = three.characters = {"small"};
  EXPECT_EQ(audited(one, small_runs::generator()), audited(three, small_runs::generator()));
}

TEST(Audit, OfOtherSeedsDrawsOtherMotions) {
  SwingGenerator generator;
  const AuditRow row = rows_of({}, generator).at(0);
  EXPECT_NE(audit_spec(row, generator, 1, 0), audit_spec(row, generator, 2, 0));
  EXPECT_NE(audit_spec(row, generator, 1, 0), audit_spec(row, generator, 1, 1));
}

AuditRow only_row(const char* action, const char* slot) {
  AuditOptions options;
  options.draws = 40, options.characters = {"human"}, options.actions = {action}, options.slots = {slot};
  BuiltInGenerator generator(stock_library());
  return audited(options, generator).at(0);
}

// A row in which nothing moves would be clean without any meaning.
TEST(Audit, HandsHaveAWallToTouch) {
  const AuditRow row = only_row("touch", "arm_left");
  EXPECT_LT(row.still, row.draws / 2);
}

TEST(Audit, TellsWhyRequestsWereUnmet) {
  const AuditRow row = only_row("turn", "waist");
  EXPECT_EQ(row.unmet, row.reasons.at("joint_speed")) << "half a second to one and a half are too short for most turns";
  EXPECT_GT(row.unmet, 0);
  EXPECT_EQ(row.still, 0);
}

Issue refusal(const char* character, const char* action, const char* slot, Generator& generator) {
  AuditOptions options;
  if (*character != 0) options.characters = {character};
  if (*action != 0) options.actions = {action};
  if (*slot != 0) options.slots = {slot};
  const Result<std::vector<AuditRow>> rows = audit_rows(options, generator);
  return rows ? Issue{} : rows.issue();
}

TEST(Audit, RefusesNamesThatAreNotThere) {
  SwingGenerator generator;
  const Issue character = refusal("pendulun", "", "", generator);
  EXPECT_EQ(character.code, "audit.unknown_character");
  EXPECT_EQ(character.text, "there is no character \"pendulun\"; there are pendulum; did you mean \"pendulum\"?");
  EXPECT_EQ(refusal("", "jump", "", generator).code, "audit.unknown_action");
  EXPECT_EQ(refusal("", "", "tail", generator).code, "audit.unknown_slot");
  BuiltInGenerator all(stock_library());
  EXPECT_EQ(refusal("", "walk", "head", all).code, "audit.nothing_matches");
}

// The built-in generator keeps arms off walls: forearm and shield, too, not only the hand that is laid on one.
TEST(Audit, ArmsThatTouchWallsDoNotEnterThem) {
  BuiltInGenerator generator(stock_library());
  AuditOptions options;
  options.actions = {"touch"}, options.draws = 40, options.slots = {"arm_left"};
  for (const AuditRow& row : audited(options, generator)) {
    EXPECT_GE(row.clean, 38) << row.character.name << " " << row.part;
    EXPECT_LT(row.still, row.draws / 2) << row.part;
  }
}

// Beside the hip there is no room for a hand at a near wall; farther in front there is.
TEST(Audit, ArmsFindRoomToTouchNearWalls) {
  BuiltInGenerator generator(stock_library());
  AuditOptions options;
  options.actions = {"touch"}, options.draws = 40, options.slots = {"arm_left"};
  for (const AuditRow& row : audited(options, generator)) EXPECT_LE(row.unmet, row.draws / 8) << row.part;
}

}  // namespace
}  // namespace contort
