// Shrinking: the same failure, not shallower than allowed, with nothing that the failure does not need.
#include "fuzz/shrink.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cmath>

#include "corpus/replay.h"
#include "fuzz/draw.h"
#include "tests/checks/family_text.h"
#include "tests/checks/small_character.h"
#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

ShrinkConfig config(double depth_floor, int evaluations = 300) {
  ShrinkConfig c;
  c.depth_floor = depth_floor;
  c.max_evaluations = evaluations;
  return c;
}

Case shrunk(const Case& original, const ShrinkConfig& how, const Library& library = stock_library()) {
  BuiltInGenerator generator(library);
  return shrink(original, generator, how).minimal;
}

// The deepest failure of each drawn spec that fails.
std::vector<Case> drawn_failures(int wanted) {
  std::vector<Case> failures;
  for (int i = 0; static_cast<int>(failures.size()) < wanted && i < 200; ++i) {
    const Spec spec = draw_spec({{"human", "mech"}}, stock_generator(), 21, i);
    const Result<Stage> stage = build_stage(spec, stock_library());
    if (!stage) continue;
    StageEvaluator evaluator;
    const Evaluation evaluation = evaluator.run(*stage);
    const Finding* deepest_of_all = nullptr;
    for (const Finding& f : evaluation.findings)
      if (deepest_of_all == nullptr || f.depth > deepest_of_all->depth) deepest_of_all = &f;
    if (deepest_of_all != nullptr)
      failures.push_back({spec, expectation_of(evaluator.execution(), evaluation, *deepest_of_all), {}});
  }
  return failures;
}

TEST(ShrinkLawsSlow, TheResultFailsTheSameWayAndDeepEnough) {
  for (const Case& original : drawn_failures(10))
    for (const double floor : {0.0, 0.5, 1.0}) {
      const Case least = shrunk(original, config(floor));
      EXPECT_EQ(family_of(least), family_of(original));
      EXPECT_GE(least.expect.depth, floor * original.expect.depth);
      EXPECT_FALSE(cheaper(original.spec, least.spec)) << pretty_spec(least.spec);
      EXPECT_EQ(least.provenance.shrunk_from, spec_id(original.spec));
      Evaluator evaluator(stock_generator());
      EXPECT_EQ(replay(least, evaluator).verdict, Verdict::same);
    }
}

int count_of_actions(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  return count;
}

TEST(ShrinkGuarded, ChangesNothingWhereNoCandidateEndsItsProcess) {
  const Case original = elbow_case();
  ShrinkConfig how = config(0.5);
  const Shrunk plain = shrink(original, stock_generator(), how);
  how.guarded = true;
  const Shrunk guarded = shrink(original, stock_generator(), how);
  EXPECT_EQ(print_case(guarded.minimal), print_case(plain.minimal));
  EXPECT_EQ(print_case(guarded.worst), print_case(plain.worst));
  EXPECT_EQ(guarded.evaluations, plain.evaluations);
}

TEST(ShrinkGuarded, GoesRoundWhatCrashesAndHandsItBack) {
  Case original = elbow_case();
  const Spec spec =
      spec_of({original.spec.sequences[0].clips[0].actions[0], pose_use("head", {}), pose_use("leg_left", {})});
  original = failing_case(spec, "joint_range", kElbow);
  ShrinkConfig how = config(0.5);
  how.guarded = true;
  how.before_run = [](const Spec& candidate) {
    if (count_of_actions(candidate) == 1) ::raise(SIGUSR1);
  };
  const Shrunk result = shrink(original, stock_generator(), how);
  EXPECT_EQ(result.stopped, "fixpoint");
  EXPECT_EQ(family_of(result.minimal), family_of(original));
  EXPECT_EQ(count_of_actions(result.minimal.spec), 2);
  const auto met = std::ranges::find(result.met, family("crash|human|SIGUSR1"),
                                     [](const Case& c) { return family_of(c); });
  ASSERT_NE(met, result.met.end());
  EXPECT_EQ(count_of_actions(met->spec), 1);
}

TEST(ShrinkLawsSlow, EqualInputGivesEqualOutput) {
  for (const Case& original : drawn_failures(3))
    EXPECT_EQ(shrunk(original, config(0.5)), shrunk(original, config(0.5)));
}

// The floor is a share of the depth before any shrinking, so half does not become a quarter.
TEST(ShrinkLawsSlow, ShrinkingAgainChangesNothing) {
  for (const Case& original : drawn_failures(30))
    for (const double floor : {0.0, 0.5, 1.0}) {
      const Case once = shrunk(original, config(floor, 20000));
      ASSERT_EQ(once.provenance.shrink_stopped, "fixpoint");
      EXPECT_EQ(print_case(shrunk(once, config(floor, 20000))), print_case(once)) << family_of(original);
    }
}

TEST(ShrinkLawsSlow, TheWorstAndTheOthersFailAsTheySay) {
  std::size_t others = 0;
  for (const Case& original : drawn_failures(30)) {
    const Shrunk result = shrink(original, stock_generator(), config(0.5));
    EXPECT_GE(result.worst.expect.depth, result.minimal.expect.depth);
    std::vector<Case> all = result.met;
    others += all.size();
    all.push_back(result.worst);
    for (const Case& shown : all) {
      Evaluator evaluator(stock_generator());
      EXPECT_EQ(replay(shown, evaluator).verdict, Verdict::same) << family_of(shown);
    }
  }
  EXPECT_GT(others, 0U);  // measured: 92
}

TEST(ShrinkLaws, WithAnotherFloorItGoesOnFromTheDepthOfTheFirst) {
  const Case half = shrunk(elbow_case(250), config(0.5));
  const Case quarter = shrunk(half, config(0.25));
  EXPECT_LT(quarter.expect.depth, half.expect.depth);
  EXPECT_EQ(quarter.spec, shrunk(elbow_case(250), config(0.25)).spec);
  EXPECT_EQ(quarter.provenance.shrunk_from, half.provenance.shrunk_from);
}

TEST(ShrinkLaws, NeverTakesMoreEvaluationsThanAllowed) {
  const std::vector<Case> failures = drawn_failures(3);
  ASSERT_EQ(failures.size(), 3U);
  for (const Case& original : failures)
    for (const int allowed : {0, 1, 2, 7, 40}) {
      const Case least = shrunk(original, config(0.5, allowed));
      EXPECT_LE(least.provenance.shrink_evaluations, allowed);
      if (least.provenance.shrink_stopped == "evaluations")
        EXPECT_EQ(least.provenance.shrink_evaluations, allowed);
      else
        EXPECT_EQ(least.provenance.shrink_stopped, "fixpoint");
    }
}

TEST(ShrinkLaws, NoEvaluationsChangeNothing) {
  const Case original = elbow_case();
  const Case same = shrunk(original, config(0.5, 0));
  EXPECT_EQ(same.spec, original.spec);
  EXPECT_EQ(same.expect, original.expect);
}

TEST(ShrinkLaws, NothingIsExplainedOrClimbedOnceTheBudgetIsSpent) {
  const Shrunk early = shrink(elbow_case(250, 77), stock_generator(), config(0.5, 4));
  EXPECT_EQ(early.stopped, "evaluations");
  EXPECT_EQ(early.worst.spec, early.minimal.spec);
  EXPECT_TRUE(early.minimal.free_fields.empty());
}

TEST(ShrinkLaws, TimeThatIsUpStopsItBeforeTheNextEvaluation) {
  ShrinkConfig how = config(0.5);
  int asked = 0;
  how.out_of_time = [&asked] { return ++asked > 4; };
  const Case least = shrunk(elbow_case(250, 77), how);
  EXPECT_EQ(least.provenance.shrink_stopped, "time");
  EXPECT_LE(least.provenance.shrink_evaluations, 4);
}

// The elbow bends to 150 degrees. With a floor of 0.24 of the 30 degrees beyond, it must reach 157.2. Requests for more
// than 188 degrees within 30 frames do not get there in time.
Case cluttered() {
  Spec spec = spec_of({pose_use("arm_left", {{"elbow_deg", 180.0}, {"shoulder_deg", Vec3(10, 20, 30)}}, 43),
                       pose_use("leg_left", {{"knee_deg", 90.0}}), pose_use("head", {{"neck_flex_deg", 10.0}})});
  spec.sequences[0].clips[0].actions[0].speed = 2.0;
  spec.sequences[0].clips[0].name = "clutter";
  spec.sequences[0].clips.push_back({"", 10, 50, 2.0, {pose_use("arm_right", {{"elbow_deg", 30.0}})}});
  spec.sequences.push_back({"after", 90, {{"", 0, 0, 1.0, {pose_use("torso", {{"lumbar_flex_deg", 20.0}})}}}});
  spec.character.attachments.push_back({"backpack", "torso", "back"});
  spec.hold_frames = 9;
  spec.rate_hz = 50;
  return failing_case(spec, "joint_range", kElbow);
}

TEST(ShrinkPlanted, EndsAtExactlyTheKnownMinimalSpec) {
  const Case least = shrunk(cluttered(), config(0.24, 2000));
  EXPECT_EQ(print_spec(least.spec), print_spec(bent_elbow(160, 30)));  // 158 would be enough, but is no round number
  EXPECT_EQ(least.provenance.shrink_stopped, "fixpoint");
}

TEST(ShrinkPlanted, WithTheWholeDepthTheAngleStays) {
  const Case least = shrunk(cluttered(), config(1.0, 2000));
  EXPECT_EQ(print_spec(least.spec), print_spec(bent_elbow(180, 30)));
}

TEST(ShrinkPlanted, SwapsThatDoNotMatterVanishAndTheOneThatDoesStays) {
  Spec spec = spec_of({pose_use("arm_right", {{"extend_m", 5.0}})}, "mech");
  spec.character.parts = {{"torso", "mech_torso_heavy"},
                          {"head", "mech_head_turret"},
                          {"arm_left", "mech_arm_shield"},
                          {"arm_right", "mech_arm_extend"},
                          {"back", "mech_pack_large"}};
  const Case least = shrunk(failing_case(spec, "joint_range", "arm_right/extend max"), config(1.0, 2000));
  const std::map<std::string, std::string> needed = {{"arm_right", "mech_arm_extend"}};
  EXPECT_EQ(least.spec.character.parts, needed);
}

// Each arm slides to the middle; only together do they meet.
TEST(ShrinkPlanted, TwoActionsThatNeedEachOtherBothStay) {
  const Library library = small::library();
  const char* const arms = "arm_left/slide ~ arm_right/slide";
  const auto slides = [](const char* slot) { return pose_use(slot, {{"slide_m", -0.215}}); };
  for (const char* slot : {"arm_left", "arm_right"})
    EXPECT_EQ(broken_in(*build_stage(spec_of({slides(slot)}, "small"), library)).find(arms), std::string::npos) << slot;
  Spec spec = spec_of({slides("arm_left"), slides("arm_right")}, "small");
  spec.sequences[0].clips.push_back({"", 70, 0, 1.0, {pose_use("arm_left", {{"lift_deg", 20.0}})}});
  const Case least = shrunk(failing_case(spec, "self_collision", arms, library), config(0.9), library);
  ASSERT_EQ(least.spec.sequences.size(), 1U);
  ASSERT_EQ(least.spec.sequences[0].clips.size(), 1U);
  const std::vector<ActionUse>& actions = least.spec.sequences[0].clips[0].actions;
  ASSERT_EQ(actions.size(), 2U);
  EXPECT_EQ(actions[0].slot, "arm_left");
  EXPECT_EQ(actions[1].slot, "arm_right");
}

// Both arms slide together until they overlap by 3 cm; with the broken part their places are NaN. A NaN failure must
// not become a shallow finite one.
TEST(ShrinkPlanted, NaNStaysNaN) {
  Library library = small::library();
  PartDesc broken = small::arm_part();
  broken.name = "broken_arm";
  broken.joints[0].position_m.x = std::numeric_limits<double>::quiet_NaN();
  library.parts["broken_arm"] = broken;
  library.characters["small"].slots[1].parts.push_back("broken_arm");
  Spec spec =
      spec_of({pose_use("arm_left", {{"slide_m", -0.215}}), pose_use("arm_right", {{"slide_m", -0.215}})}, "small");
  const char* const arms = "arm_left/slide ~ arm_right/slide";
  ASSERT_FALSE(std::isnan(failing_case(spec, "self_collision", arms, library).expect.worst_margin));
  spec.character.parts["arm_left"] = "broken_arm";
  const Case original = failing_case(spec, "self_collision", arms, library);
  ASSERT_TRUE(std::isnan(original.expect.worst_margin));
  const Case smaller = shrunk(original, config(0.5), library);
  EXPECT_TRUE(std::isnan(smaller.expect.worst_margin));
  EXPECT_EQ(smaller.spec.character.parts, spec.character.parts);
  EXPECT_TRUE(smaller.spec.sequences.empty()) << pretty_spec(smaller.spec);
}

}  // namespace

}  // namespace contort
