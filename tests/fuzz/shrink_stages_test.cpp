// Stages of shrinking on planted failures: any rule about a spec, without a motion.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>
#include <functional>
#include <limits>

#include "corpus/ending_case.h"
#include "fuzz/edits.h"
#include "fuzz/shrink.h"
#include "tests/checks/family_text.h"
#include "tests/corpus/sample_cases.h"

namespace contort {

namespace {

// Fails with the depth that the rule returns; 0: does not fail.
class PlantedTrial final : public Trial {
 public:
  explicit PlantedTrial(std::function<double(const Spec&)> depth) : depth_(std::move(depth)) {}
  TrialResult run(const Spec& spec, int) override {
    const Result<Stage> stage = build_stage(spec, stock_library());
    TrialResult shown;
    if (!stage) return shown;
    shown.built = true;
    shown.character = stage->character;
    shown.most_frames = stage->most_frames;
    shown.depth = depth_(spec);
    shown.fails = shown.depth > 0.0;
    shown.expect = {"planted", "rule", "", 0, 0, 0, -shown.depth, shown.depth, "0", "0", ""};
    return shown;
  }
  std::vector<Case> others(const Spec&) override { return {}; }

 private:
  std::function<double(const Spec&)> depth_;
};

Shrunk shrunk(const Spec& spec, std::function<double(const Spec&)> depth, double floor = 0.0) {
  PlantedTrial trial(std::move(depth));
  Case original;
  original.spec = spec;
  original.expect = {"planted", "rule", "", 0, 0, 0, -1.0, 1.0, "0", "0", ""};
  ShrinkConfig config;
  config.depth_floor = floor;
  return shrink_with(trial, original, stock_generator(), config);
}

int staged_actions(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  return count;
}

double number(const Spec& spec, std::size_t action, const char* name) {
  const auto& params = spec.sequences[0].clips[0].actions[action].params;
  return params.contains(name) ? std::get<double>(params.at(name)) : 0.0;
}

TEST(ShrinkStages, TwoFieldsThatOnlyGoTogetherGo) {
  Spec spec = spec_of({pose_use("arm_left", {{"elbow_deg", 20.0}}), pose_use("arm_right", {{"elbow_deg", 20.0}})});
  const auto differ = [](const Spec& x) {
    return staged_actions(x) == 2 && number(x, 0, "elbow_deg") != number(x, 1, "elbow_deg");
  };
  const Shrunk result = shrunk(spec, [&](const Spec& x) { return staged_actions(x) == 2 && !differ(x) ? 1.0 : 0.0; });
  for (const ActionUse& use : result.minimal.spec.sequences[0].clips[0].actions) EXPECT_TRUE(use.params.empty());
}

TEST(ShrinkStages, ALoadGetsNoHeavierThanItWas) {
  const auto with_load = [](double mass_kg) {
    Spec spec = spec_of({});
    spec.dynamics.mode = Mode::tracking;
    LoadDesc& load = spec.dynamics.loads.emplace_back();
    load.slot = "torso", load.socket = "back", load.mass_kg = mass_kg;
    return spec;
  };
  const auto loaded = [](const Spec& spec) { return spec.dynamics.loads.empty() ? 0.0 : 1.0; };
  const double least_kg = shrunk(with_load(0.5), loaded).minimal.spec.dynamics.loads.at(0).mass_kg;
  const double most_kg = shrunk(with_load(40.0), loaded).minimal.spec.dynamics.loads.at(0).mass_kg;
  EXPECT_EQ(least_kg, 0.5);
  EXPECT_EQ(most_kg, LoadDesc().mass_kg);
}

TEST(ShrinkStages, TwoActionsThatOnlyGoTogetherGo) {
  std::vector<ActionUse> uses;
  for (const char* slot : {"arm_left", "arm_right", "leg_left", "leg_right", "head"})
    uses.push_back(pose_use(slot, {}));
  const Shrunk result = shrunk(spec_of(uses), [](const Spec& x) { return staged_actions(x) % 2 == 1 ? 1.0 : 0.0; });
  EXPECT_EQ(staged_actions(result.minimal.spec), 1);
}

TEST(ShrinkStages, ClipsAndSequencesBecomeOne) {
  Spec spec = spec_of({pose_use("arm_left", {})});
  spec.sequences[0].clips.push_back({"", 12, 0, 1.0, {pose_use("arm_right", {})}});
  spec.sequences.push_back(spec.sequences[0]);
  const Shrunk result = shrunk(spec, [](const Spec& x) { return staged_actions(x) == 4 ? 1.0 : 0.0; });
  ASSERT_EQ(result.minimal.spec.sequences.size(), 1U);
  EXPECT_EQ(result.minimal.spec.sequences[0].clips.size(), 1U);
  EXPECT_EQ(staged_actions(result.minimal.spec), 4);
}

// An interrupt may be moved into the queue, unless the failure needs the interruption.
TEST(ShrinkStages, WhatCutsInTakesItsTurnInTheQueueUnlessItMustCut) {
  Spec spec = spec_of({pose_use("arm_left", {})});
  InterruptDesc cut;
  cut.when.frame = 7;
  cut.sequence.clips = {{"", 0, 0, 1.0, {pose_use("arm_right", {}), pose_use("head", {})}}};
  spec.interrupts = {cut, cut};
  const auto uses_head = [](const Spec& x) { return print_spec(x).find("\"head\"") != std::string::npos; };
  const Spec queued = shrunk(spec, [&](const Spec& x) { return uses_head(x) ? 1.0 : 0.0; }).minimal.spec;
  EXPECT_EQ(print_spec(queued), print_spec(spec_of({pose_use("head", {})})));

  const auto two = [&](const Spec& x) {
    int moving = 0;
    for (std::size_t i = 0; i < sequence_count(x); ++i) moving += !sequence_at(x, i).clips.empty();
    return uses_head(x) && moving > 1 ? 1.0 : 0.0;
  };
  const Spec last = shrunk(spec, two).minimal.spec;
  EXPECT_TRUE(last.interrupts.empty());
  EXPECT_EQ(last.sequences.size(), 2U);

  const auto cuts = [&](const Spec& x) { return uses_head(x) && !x.interrupts.empty() ? 1.0 : 0.0; };
  EXPECT_EQ(shrunk(spec, cuts).minimal.spec.interrupts.size(), 1U);
}

TEST(ShrinkStages, AClipThatIsThereForItsTimeNeedsNothingInIt) {
  Spec spec = spec_of({pose_use("arm_left", {}), pose_use("head", {})});
  spec.sequences[0].clips[0].start_frame = 9;
  const auto waits = [](const Spec& x) {
    const bool has_one = x.sequences.size() == 1 && x.sequences[0].clips.size() == 1;
    return has_one && x.sequences[0].clips[0].start_frame > 1 ? 1.0 : 0.0;
  };
  const Spec least = shrunk(spec, waits).minimal.spec;
  EXPECT_EQ(staged_actions(least), 0);
  EXPECT_EQ(least.sequences[0].clips[0].start_frame, 2);
}

TEST(ShrinkStages, EverythingAroundGoesBackToStock) {
  Spec spec = bent_elbow(50);
  spec.environment.ground = SlopeGround{12, 30};
  spec.environment.obstacles = {{"ball", Sphere{}}, {"other", Sphere{}}};
  spec.character.attachments = {{"backpack", "torso", "back"}};
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts = {{3, "head", "", {}, {0, 20, 0}}, {9, "torso", "", {}, {3, 0, 0}}};
  spec.start.heading_deg = 90;
  spec.hold_frames = 5;
  const Shrunk all = shrunk(spec, [](const Spec& x) { return staged_actions(x) == 1 ? 1.0 : 0.0; });
  EXPECT_EQ(print_spec(all.minimal.spec), print_spec(spec_of({pose_use("arm_left", {})})));
  const auto needs = [](const Spec& x) {
    const bool struck = x.dynamics.impacts.size() == 1 && x.dynamics.impacts[0].impulse_N_s.y >= 7.0;
    return struck && x.dynamics.mode != Mode::kinematic && x.environment.obstacles.size() == 1 ? 1.0 : 0.0;
  };
  Spec one_blow = spec;
  one_blow.dynamics.impacts.pop_back();
  one_blow.environment.obstacles.pop_back();
  const Spec least = shrunk(one_blow, needs).minimal.spec;
  EXPECT_TRUE(least.sequences.empty());
  EXPECT_EQ(least.dynamics.mode, Mode::dynamic) << "in tracking, a figure cannot answer a blow";
  EXPECT_EQ(least.dynamics.impacts[0].impulse_N_s.y, 7.0);
  EXPECT_EQ(least.dynamics.impacts[0].frame, 0);
  EXPECT_TRUE(least.character.attachments.empty());
}

TEST(ShrinkStages, NumbersEndAtTheSmallestOfTwoDigits) {
  const auto least = [](double from, double needed) {
    const auto rule = [=](const Spec& x) {
      return staged_actions(x) == 1 && number(x, 0, "elbow_deg") * (needed < 0 ? -1 : 1) >= std::abs(needed) ? 1.0
                                                                                                             : 0.0;
    };
    return number(shrunk(bent_elbow(from), rule).minimal.spec, 0, "elbow_deg");
  };
  EXPECT_EQ(least(270, 37), 37);
  EXPECT_EQ(least(90, 37), 37);
  EXPECT_EQ(least(-90, -37), -37);
  EXPECT_EQ(least(179, 178.5), 179);
  EXPECT_EQ(least(270, 178.5), 180);
  EXPECT_EQ(least(33.25, 30.5), 31);
}

// Fails with any hip, but hardly with one at rest, so that the depth floor keeps the field.
TEST(ShrinkStages, AFieldThatMayHaveAnyValueIsFree) {
  const Spec spec = spec_of({pose_use("leg_left", {{"knee_deg", 90.0}, {"hip_flex_deg", 30.0}}, 60)});
  const auto rule = [](const Spec& x) {
    if (staged_actions(x) != 1 || number(x, 0, "knee_deg") < 60.0) return 0.0;
    return number(x, 0, "hip_flex_deg") == 0.0 ? 0.2 : 1.0;
  };
  const Shrunk result = shrunk(spec, rule, 0.5);
  const std::vector<std::string> expected = {"/sequences/0/clips/0/actions/0/params/hip_flex_deg"};
  EXPECT_EQ(result.minimal.free_fields, expected) << pretty_spec(result.minimal.spec);
}

// Each of these fields fails at its ends and in the middle; only its default or a quarter passes.
TEST(ShrinkStages, AFieldWhoseDefaultOrQuarterPassesIsNotFree) {
  const Spec spec = spec_of({pose_use("leg_left", {{"hip_flex_deg", 30.0}}, 60)});
  const auto free_fields = [&](const std::function<bool(double)>& fails) {
    const auto rule = [&](const Spec& x) {
      if (staged_actions(x) != 1) return 0.0;
      const double hip = number(x, 0, "hip_flex_deg");
      return !fails(hip) ? 0.0 : hip == 0.0 ? 0.2 : 1.0;
    };
    return shrunk(spec, rule, 0.5).minimal.free_fields;
  };
  EXPECT_EQ(free_fields([](double hip) { return hip != 0.0; }), std::vector<std::string>{});
  EXPECT_EQ(free_fields([](double hip) { return std::abs(hip + 180.0) > 45.0; }), std::vector<std::string>{});
  EXPECT_EQ(free_fields([](double) { return true; }).size(), 1U) << "the rule alone makes the difference";
}

TEST(ShrinkStages, TheWorstIsDeeperWithTheStructureOfTheMinimal) {
  const auto rule = [](const Spec& x) {
    return staged_actions(x) == 1 ? std::max(0.0, 100.0 - std::abs(number(x, 0, "elbow_deg") - 300.0)) : 0.0;
  };
  const Shrunk result = shrunk(bent_elbow(240), rule, 0.5);
  EXPECT_EQ(number(result.minimal.spec, 0, "elbow_deg"), 220);
  EXPECT_GT(result.worst.expect.depth, 90.0);
  EXPECT_NEAR(number(result.worst.spec, 0, "elbow_deg"), 300, 10);
  EXPECT_EQ(staged_actions(result.worst.spec), 1);
}

// NaN is another fault, whatever its depth: its minimal spec would not explain the original.
TEST(ShrinkStages, AFailureWithANumberKeepsOne) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Spec two = spec_of({pose_use("arm_left", {}), pose_use("arm_right", {})});
  EXPECT_EQ(
      staged_actions(shrunk(two, [](const Spec& x) { return staged_actions(x) == 2 ? 1.0 : kNone; }).minimal.spec), 2);
  EXPECT_EQ(staged_actions(shrunk(two, [](const Spec& x) { return staged_actions(x) > 0 ? kNone : 1.0; }).minimal.spec),
            1);
  const auto over_200 = [](const Spec& x) {
    const double elbow_deg = staged_actions(x) == 1 ? number(x, 0, "elbow_deg") : 0.0;
    return elbow_deg > 260 ? kNone : elbow_deg - 200;
  };
  const double deepest = shrunk(bent_elbow(240), over_200, 0.5).worst.expect.depth;
  EXPECT_GT(deepest, 40.0);
  EXPECT_LE(deepest, 60.0);
}

TEST(ShrinkStages, WhatDoesNotFailTheSameWayTwiceIsFlakyAndStays) {
  class Flaky final : public Trial {
   public:
    TrialResult run(const Spec&, int) override {
      TrialResult shown;
      shown.built = shown.fails = true;
      shown.expect.motion_hash = std::to_string(++runs_);
      return shown;
    }
    std::vector<Case> others(const Spec&) override { return {}; }

   private:
    int runs_ = 0;
  } trial;
  const Case original = elbow_case();
  const Shrunk result = shrink_with(trial, original, stock_generator(), {});
  EXPECT_EQ(result.stopped, "flaky");
  EXPECT_EQ(result.minimal.spec, original.spec);
  EXPECT_EQ(result.evaluations, 2);
}

TEST(ShrinkStages, WhatDoesNotFailAnyMoreIsGone) {
  const Case original = elbow_case();
  Case healthy = original;
  healthy.spec = bent_elbow(100);
  const Shrunk result = shrink(healthy, stock_generator(), {});
  EXPECT_EQ(result.stopped, "gone");
  EXPECT_EQ(result.minimal.spec, healthy.spec);
}

// A trial with the family "planted|human|rule" and others beside it: "old" in all specs, "shallow" with less than half
// the depth in specs that do not fail, "gone" only in specs that fail, "later" only in specs that do not.
class CrowdedTrial final : public Trial {
 public:
  TrialResult run(const Spec& spec, int) override {
    TrialResult shown;
    shown.built = shown.fails = true;
    shown.depth = 1.0;
    shown.met = {of_check("at_once", spec, 1.0)};
    return shown;
  }
  std::vector<Case> others(const Spec& spec) override {
    const bool holds = spec.hold_frames > 0;
    return {of_check(holds ? "gone" : "later", spec, 1.0), of_check("nan", spec, std::nan("")),
            of_check("old", spec, holds ? 4.0 : 2.0), of_check("shallow", spec, holds ? 4.0 : 1.9)};
  }

 private:
  static Case of_check(const std::string& check, const Spec& spec, double depth) {
    Case other;
    other.spec = spec;
    other.expect.check = check;
    other.expect.subject = "it";
    other.expect.worst_margin = -depth;
    other.expect.depth = std::isnan(depth) ? 0.0 : depth;
    return other;
  }
};

Case holding() {
  Case original;
  original.spec = spec_of({pose_use("arm_left", {}), pose_use("head", {})});
  original.spec.hold_frames = 5;
  return original;
}

TEST(ShrinkStages, OtherFamiliesOnTheWayAreHandedBackWithTheirCheapestSpecs) {
  CrowdedTrial trial;
  const Shrunk result = shrink_with(trial, holding(), stock_generator(), {});
  ASSERT_EQ(result.met.size(), 2U) << "what the original shows is no news";
  EXPECT_EQ(family_of(result.met[0]), family("at_once|human|it"));
  EXPECT_EQ(family_of(result.met[1]), family("later|human|it"));
  for (const Case& other : result.met) EXPECT_EQ(other.spec, result.minimal.spec);
}

TEST(ShrinkStages, TheMinimalCaseNamesWhatOfTheOriginalItStillShowsHalfAsDeep) {
  CrowdedTrial trial;
  const Shrunk result = shrink_with(trial, holding(), stock_generator(), {});
  EXPECT_EQ(result.minimal.co_failures, (std::vector<Family>{family("nan|human|it"), family("old|human|it")}));
  EXPECT_TRUE(result.worst.co_failures.empty());
  const Shrunk again = shrink_with(trial, result.minimal, stock_generator(), {});
  EXPECT_EQ(print_case(again.minimal), print_case(result.minimal)) << "what led here stays on record";
}

TEST(ShrinkStages, NothingIsMadeReadyForATrialOnceTheBudgetIsSpent) {
  ShrinkConfig config;
  config.max_evaluations = 6;
  int ready = 0;
  config.allowed = [&](const Spec&) { return ++ready, false; };  // costs no evaluation
  PlantedTrial trial([](const Spec& spec) { return staged_actions(spec) >= 2 ? 1.0 : 0.0; });
  EXPECT_EQ(shrink_with(trial, holding(), stock_generator(), config).stopped, "fixpoint");
  const int all = ready;
  ready = 0;
  config.out_of_time = [&] { return ready >= 1; };
  config.allowed = [&](const Spec&) { return ++ready, true; };
  EXPECT_EQ(shrink_with(trial, holding(), stock_generator(), config).stopped, "time");
  EXPECT_GT(all, 1);
  EXPECT_EQ(ready, 1);
}

TEST(ShrinkStages, WhatRunsOutOfEvaluationsSaysAsWellWhatItShows) {
  CrowdedTrial trial;
  ShrinkConfig config;
  config.max_evaluations = 2;
  const Shrunk result = shrink_with(trial, holding(), stock_generator(), config);
  EXPECT_EQ(result.stopped, "evaluations");
  EXPECT_EQ(result.minimal.co_failures,
            (std::vector<Family>{family("gone|human|it"), family("nan|human|it"), family("old|human|it"),
                                 family("shallow|human|it")}));
}

Shrunk shrunk_ending(const Spec& spec, const Ending& ending, const std::function<void(const Spec&)>& work) {
  const Case original = ending_case(spec, ending);
  EndingTrial trial(original.expect, work, {});
  return shrink_with(trial, original, stock_generator(), {});
}

TEST(ShrinkEndings, ACrashIsShrunkToWhatCrashes) {
  Spec spec = spec_of({pose_use("arm_left", {{"elbow_deg", 120.0}, {"shoulder_deg", Vec3(1, 2, 3)}}, 77),
                       pose_use("head", {{"neck_flex_deg", 10.0}})});
  spec.hold_frames = 7;
  const auto work = [](const Spec& x) {
    if (staged_actions(x) > 0 && number(x, 0, "elbow_deg") > 50.0) ::raise(SIGSEGV);
  };
  const Shrunk result = shrunk_ending(spec, {Ending::Kind::crash, "SIGSEGV", ""}, work);
  EXPECT_EQ(result.stopped, "fixpoint");
  EXPECT_EQ(print_spec(result.minimal.spec), print_spec(spec_of({pose_use("arm_left", {{"elbow_deg", 51.0}})})));
  EXPECT_EQ(family_of(result.minimal), family("crash|human|SIGSEGV"));
}

TEST(ShrinkEndings, AnotherSignalIsAnotherFamily) {
  Spec spec = spec_of({pose_use("arm_left", {}), pose_use("head", {})});
  const auto work = [](const Spec& x) { ::raise(staged_actions(x) == 2 ? SIGSEGV : SIGFPE); };
  const Shrunk result = shrunk_ending(spec, {Ending::Kind::crash, "SIGSEGV", ""}, work);
  EXPECT_EQ(staged_actions(result.minimal.spec), 2);
  ASSERT_EQ(result.met.size(), 1U);
  EXPECT_EQ(family_of(result.met[0]), family("crash|human|SIGFPE"));
}

TEST(ShrinkEndings, ARealSpecThatFinishesIsGone) {
  const Case crashed = ending_case(bent_elbow(100), {Ending::Kind::crash, "SIGSEGV", ""});
  EXPECT_EQ(shrink(crashed, stock_generator(), {}).stopped, "gone");
}

}  // namespace

}  // namespace contort
