// StageEvaluator: the one path from a stage to findings; and the manifest of checks with an exemplar on either side of
// each limit.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/stage_evaluator.h"
#include "fuzz/draw.h"
#include "generator/intent.h"
#include "tests/checks/small_character.h"
#include "tests/scenes.h"

namespace contort {

namespace {

// A motion of the small character, with its intent if that matters.
struct Shown {
  Motion motion;
  Intent intent{};
  Environment environment{};
};

// A motion that is inside of one limit of one check by this margin, in the check's unit; negative: outside.
using Exemplar = Shown (*)(const Character&, double margin);

Shown lifted(const Character& character, double margin) {
  Motion motion = small::at_rest(character);
  small::set(motion, 0, small::joint_of(character, "arm_left/lift"), 50 * kRadPerDeg - margin);
  return {motion};
}

Shown hurried(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 2);
  small::set(motion, 1, small::joint_of(character, "arm_left/lift"), (300 * kRadPerDeg - margin) / 60.0);
  return {motion};
}

Shown popped(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 4, 30.0);
  for (const int frame : {2, 3})
    small::set(motion, frame, small::joint_of(character, "arm_left/lift"), (300 * kRadPerDeg - margin) / 30.0);
  return {motion};
}

Shown jerked(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 3);
  const double change = 300 * kRadPerDeg / 0.02 - margin;
  small::set(motion, 2, small::joint_of(character, "arm_left/lift"), change / (60.0 * 60.0));
  return {motion};
}

Shown squeezed(const Character& character, double margin) {
  Motion motion = small::at_rest(character);
  for (const char* joint : {"arm_left/slide", "arm_right/slide"})
    small::set(motion, 0, small::joint_of(character, joint), -0.5 * (0.4 - margin));
  return {motion};
}

Shown aimed(const Character& character, double margin) {
  Motion motion = small::at_rest(character);
  const int socket = character.find_socket("arm_left/inside");
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[0], motion.row(0), world);
  const Rigid at = world_from_socket(character, world, socket);
  const Quat aside = axis_angle(Vec3(1, 0, 0), 0.1 * kRadPerDeg - margin);
  motion.aims = {{0, 0, socket, at.p_m + at.q * (aside * Vec3(0, 0, 5))}};
  return {motion};
}

Shown strained(const Character& character, double margin) {
  Motion motion = small::moved_by_dynamics(character);
  const Joint& lift = small::joint_of(character, "arm_left/lift");
  motion.response.efforts[small::freedom_of(character, lift)] = lift.strength_high * (1.0 - margin);
  return {motion};
}

Shown unbalanced(const Character& character, double margin) {
  Motion motion = small::moved_by_dynamics(character);
  motion.response.stances[0].margin_m = margin;
  return {motion};
}

Shown late(const Character& character, double margin) {
  Motion motion = small::moved_by_dynamics(character, 60);
  motion.response.impacts = {{0, 1, {}, {}}};
  small::set(motion, 59, small::joint_of(character, "arm_left/lift"), 3.0 * kRadPerDeg - margin);
  return {motion};
}

Shown sunk(const Character& character, double margin) {
  EnvironmentDesc desc;  // a tread under the left box
  desc.ground = StepsGround{90.0, 0.1, 1.0, 0.005 - margin, 1};
  return {small::at_rest(character), {}, *build_environment(desc)};
}

// The left box's outer side is at 0.4 m.
Shown pressed(const Character& character, double margin) {
  EnvironmentDesc desc;
  desc.obstacles = {{"wall", Box{{0.9, 0, 0}, {0.5, 3, 3}, {}}}};
  Motion motion = small::at_rest(character);
  small::set(motion, 0, small::joint_of(character, "arm_left/slide"), 0.005 - margin);
  return {motion, {}, *build_environment(desc)};
}

Shown slid(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 2);
  small::set(motion, 1, small::joint_of(character, "arm_left/slide"), 0.02 - margin);
  return {motion};
}

Shown flashed(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 5, 10.0);
  for (const int frame : {0, 1, 3, 4})
    small::set(motion, frame, small::joint_of(character, "arm_left/lift"), 10 * kRadPerDeg - margin);
  return {motion};
}

// The box's inner side is 0.2 m from the middle, and may be 0.25 m from it.
Shown strayed(const Character& character, double margin) {
  Motion motion = small::at_rest(character);
  small::set(motion, 0, small::joint_of(character, "arm_left/slide"), 0.05 - margin);
  return {motion};
}

Shown lost(const Character& character, double margin) {
  Motion motion = small::at_rest(character);
  motion.root[0].p_m.x = 1000.0 - margin;
  return {motion};
}

// A sequence of one action on one part.
Intent intent_of_one(const char* action, Layer layer, int part, int last_frame) {
  Intent intent;
  intent.sequences = {{last_frame, {}}};
  IntendedAction intended;
  intended.name = action, intended.layer = layer;
  intended.part = intended.named = part;
  intended.end = last_frame;
  intent.actions = {intended};
  return intent;
}

// A grip must stay on a socket of the base, and is beside it.
Shown missed(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 13);
  for (int frame = 0; frame < 13; ++frame)
    small::set(motion, frame, small::joint_of(character, "arm_left/slide"), 0.001 - margin);
  const int arm = character.find_part("arm_left");
  motion.spans = {{0, 12, 0, 0, 0, arm}};
  motion.queue = {{0, 12, 0, 0}};
  Intent intent = intent_of_one("weapon_hold", Layer::ik, arm, 20);
  intent.goals = {{0, 12, arm, character.find_socket("arm_left/grip"), character.find_socket("base/left"), Vec3(0.0)}};
  return {motion, intent};
}

Shown left_over(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 3);
  small::set(motion, 2, small::joint_of(character, "arm_left/lift"), 0.1 * kRadPerDeg - margin);
  const int arm = character.find_part("arm_left");
  motion.spans = {{1, 1, 0, 0, 0, arm}};
  motion.queue = {{0, 2, 0, 0}};
  return {motion, intent_of_one("hit_reaction", Layer::additive, arm, 2)};
}

// Three frames longer than its content are 0.05 s at 60 Hz.
Shown lingering(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 14, 3.0 / (0.05 - margin));
  motion.queue = {{0, 13, 0, 0}};
  return {motion, intent_of_one("hit_reaction", Layer::additive, 0, 10)};
}

// It continues one frame too late, which is a millisecond at 1 kHz.
Shown skipping(const Character& character, double margin) {
  Motion motion = small::at_rest(character, 14, 1.0 / (0.001 - margin));
  motion.queue = {{0, 4, 0, 0}, {4, 6, 1, 0}, {6, 11, 0, 5}};
  Shown shown{motion, intent_of_one("hit_reaction", Layer::additive, 0, 10)};
  shown.intent.sequences.push_back({2, {}});
  return shown;
}

const std::map<std::string, Exemplar>& exemplars() {
  static const std::map<std::string, Exemplar> all = {
      {"non_finite", lost},
      {"joint_range", lifted},
      {"angular_velocity", hurried},
      {"pop", popped},
      {"angular_acceleration", jerked},
      {"bind_pose_flash", flashed},
      {"bone_position", strayed},
      {"aim_error", aimed},
      {"reach_error", missed},
      {"residue", left_over},
      {"stuck", lingering},
      {"queue_gap", skipping},
      {"joint_torque", strained},
      {"balance", unbalanced},
      {"tracking_error", late},
      {"ground_penetration", sunk},
      {"obstacle_penetration", pressed},
      {"foot_slide", slid},
      {"self_collision", squeezed},
  };
  return all;
}

std::vector<Finding> findings_of(const Character& character, const Shown& shown) {
  return StageEvaluator().judge(character, shown.motion, {}, shown.environment, &shown.intent);
}

TEST(Manifest, EveryCheckHasAnExemplarInsideThatPassesAndOneOutsideThatFails) {
  const Character character = small::build();
  for (const CheckDef& check : all_checks()) {
    if (check.needs >= Needs::clip) continue;  // clip_manifest_, foreign_checks_test.cpp
    const auto exemplar = exemplars().find(std::string(check.name));
    ASSERT_NE(exemplar, exemplars().end()) << check.name << " has no exemplar: add one to this file";
    for (const Finding& f : findings_of(character, exemplar->second(character, 2e-6)))
      ADD_FAILURE() << check.name << " inside: " << f.check << " " << f.subject;
    const std::vector<Finding> outside = findings_of(character, exemplar->second(character, -2e-6));
    ASSERT_EQ(outside.size(), 1U) << check.name;
    EXPECT_EQ(outside[0].check, check.name);
    EXPECT_NEAR(outside[0].worst_margin, -2e-6, 1e-12) << check.name;
    EXPECT_NEAR(outside[0].depth, 2e-6 / check.scale, 1e-12 / check.scale) << check.name;
  }
}

TEST(Manifest, EveryExemplarBelongsToACheck) {
  std::set<std::string> names;
  for (const CheckDef& check : all_checks()) names.insert(std::string(check.name));
  EXPECT_EQ(names.size(), all_checks().size());
  for (const auto& exemplar : exemplars()) EXPECT_EQ(names.count(exemplar.first), 1U) << exemplar.first;
}

// Some checks judge the whole figure, and bone_position only the regions in the character's file.
int fewest_subjects(std::string_view check, const Character& character) {
  for (const char* name : {"balance", "bind_pose_flash", "queue_gap", "root_pop", "stuck"}) if (check == name) return 1;
  if (check == "self_collision") return static_cast<int>(character.judged_pairs().size());
  if (check == "bone_position") return static_cast<int>(character.regions().size());
  return static_cast<int>(character.parts().size());
}

TEST(Manifest, SubjectsOfACheckHaveDifferentNamesAndUnits) {
  std::vector<Character> characters = {small::build()};
  for (const char* name : {"human", "mech", "quadruped"})
    characters.push_back(*build_character({name, {}, {}}, stock_library()));
  for (const Character& character : characters)
    for (const CheckDef& check : all_checks()) {
      if (check.needs == Needs::clip) continue;  // nodes of a file
      const std::vector<std::string> subjects = small::subjects_of(std::string(check.name), character);
      EXPECT_GE(static_cast<int>(subjects.size()), fewest_subjects(check.name, character)) << check.name;
      EXPECT_EQ(std::set<std::string>(subjects.begin(), subjects.end()).size(), subjects.size()) << check.name;
      for (int s = 0; s < check.subject_count(character); ++s) EXPECT_FALSE(check.subject(character, s).unit.empty());
      EXPECT_GT(check.scale, 0.0);
      EXPECT_FALSE(check.help.empty());
    }
}

Stage staged(const Spec& spec) {
  Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) ADD_FAILURE() << to_line(stage.issue());
  return std::move(stage).value();
}

std::vector<Stage> stages() {
  std::vector<Stage> all;
  for (const NamedScene& named : all_scenes()) all.push_back(staged(scene(named.name)));
  for (int i = 0; i < 48; ++i)
    all.push_back(staged(draw_spec({{"human", "mech", "quadruped"}}, stock_generator(), 11, i)));
  return all;
}

TEST(Evaluator, JudgingTheGeneratedMotionIsTheSameAsRunning) {
  std::size_t findings = 0;
  for (const Stage& stage : stages()) {
    StageEvaluator runs, judges;
    const Evaluation evaluation = runs.run(stage);
    Execution made;
    execute(stage, *std::make_unique<GenerateScratch>(), made);
    EXPECT_EQ(evaluation.findings, judges.judge(*stage.character, made.motion, {}, stage.environment, &*made.intent));
    EXPECT_EQ(runs.execution().intent, made.intent);
    EXPECT_EQ(evaluation.motion_hash, motion_hash(made.motion));
    EXPECT_EQ(evaluation.frame_count, made.motion.frame_count);
    EXPECT_EQ(runs.motion(), made.motion);
    findings += evaluation.findings.size();
  }
  EXPECT_GT(findings, 20U);
}

TEST(Evaluator, OneCheckAloneFindsWhatItFindsAmongAll) {
  for (const Stage& stage : stages()) {
    StageEvaluator all, alone;
    const std::vector<Finding> findings = all.run(stage).findings;
    for (const CheckDef& check : all_checks()) {
      std::vector<Finding> expected;
      for (const Finding& f : findings)
        if (f.check == check.name) expected.push_back(f);
      EXPECT_EQ(alone.run(stage, check.name).findings, expected) << check.name;
    }
  }
}

TEST(Evaluator, NothingOfOneRunReachesTheNext) {
  const std::vector<Stage> all = stages();
  StageEvaluator shared;
  for (const Stage& stage : all) {
    for (const Stage* other : {&all.front(), &all.back()}) {
      const Evaluation alone = StageEvaluator().run(stage);
      EXPECT_EQ(shared.run(stage), alone);
      shared.run(*other, other == &all.front() ? "joint_range" : "");
      EXPECT_EQ(shared.run(stage), alone);
    }
  }
}

int place_of(const std::string& check) {
  for (std::size_t i = 0; i < all_checks().size(); ++i)
    if (all_checks()[i].name == check) return static_cast<int>(i);
  return -1;
}

TEST(Evaluator, FindingsStandByFirstFrameThenCheckThenSubject) {
  bool tied = false;
  for (const Stage& stage : stages()) {
    const std::vector<Finding> findings = StageEvaluator().run(stage).findings;
    std::map<std::string, std::vector<std::string>> subjects;
    for (const CheckDef& check : all_checks())
      subjects[std::string(check.name)] = small::subjects_of(std::string(check.name), *stage.character);
    const auto key = [&](const Finding& f) {
      const std::vector<std::string>& names = subjects[f.check];
      return std::tuple(f.first_frame, place_of(f.check), std::find(names.begin(), names.end(), f.subject));
    };
    for (std::size_t i = 0; i + 1 < findings.size(); ++i) {
      EXPECT_LT(key(findings[i]), key(findings[i + 1]));
      tied = tied || findings[i].first_frame == findings[i + 1].first_frame;
    }
  }
  EXPECT_TRUE(tied) << "no two findings began together: the order was not tried";
}

TEST(Evaluator, DeepestIsTheDeepestOfItsCheckAndSubject) {
  const auto finding = [](const char* check, const char* subject, int first, double depth) {
    return Finding{check, subject, "rad", first, first, first, -depth, depth};
  };
  const std::vector<Finding> findings = {finding("a", "x", 1, 1.0), finding("a", "x", 5, 3.0),
                                         finding("a", "x", 9, 3.0), finding("b", "x", 2, 9.0)};
  EXPECT_EQ(deepest(findings, "a", "x"), &findings[1]);
  EXPECT_EQ(deepest(findings, "a", "y"), nullptr);
  EXPECT_EQ(deepest({}, "a", "x"), nullptr);
}

TEST(Evaluator, ARootThatIsNowhereIsAFindingAndNoCrash) {
  const Character character = small::build();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Motion motion = small::at_rest(character, 3);
    motion.root[1].p_m.y = bad;
    const std::vector<Finding> findings = StageEvaluator().judge(character, motion);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].check, "non_finite") << "the cause comes first";
    EXPECT_EQ(findings[0].subject, "root");
    EXPECT_NE(deepest(findings, "self_collision", "arm_left/slide ~ arm_right/slide"), nullptr);
    for (const Finding& f : findings) {
      EXPECT_FALSE(f.worst_margin >= 0.0) << f.check;
      EXPECT_TRUE(std::isinf(f.depth)) << f.check;
      EXPECT_EQ(f.first_frame, 1) << f.check;
      EXPECT_EQ(f.last_frame, 1) << f.check;
    }
  }
}

TEST(Evaluator, HugeCoordinatesDoNotCrash) {
  const Result<Character> human = build_character({}, stock_library());
  ASSERT_TRUE(human);
  for (const double huge : {1e30, -1e160, 1e308, std::numeric_limits<double>::infinity()}) {
    Motion motion = small::at_rest(*human, 2);
    for (double& value : motion.row(1)) value = huge;
    EXPECT_FALSE(StageEvaluator().judge(*human, motion).empty()) << huge;
  }
}

TEST(Evaluator, AMotionWithoutFramesHasNoFindings) {
  const Character character = small::build();
  EXPECT_TRUE(StageEvaluator().judge(character, small::at_rest(character, 0)).empty());
}

// An ease away from a limit came out 5.6e-17 rad beyond it, which no one would call a failure.
TEST(Evaluate, RoundingAtALimitIsNoFinding) {
  const Character character = small::build();
  const Joint& lift = small::joint_of(character, "arm_left/lift");
  StageEvaluator evaluator;
  for (const double beyond : {5.6e-17, 0.9e-9, 1.1e-9}) {
    Motion motion = small::at_rest(character);
    small::set(motion, 0, lift, lift.high + beyond);
    EXPECT_EQ(evaluator.judge(character, motion, "joint_range").size(), beyond > 1e-9 ? 1U : 0U) << beyond;
  }
}

}  // namespace

}  // namespace contort
