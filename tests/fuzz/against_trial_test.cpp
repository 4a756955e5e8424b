// Shrinking with two builds: the smallest spec fails here and passes in the base.
#include "fuzz/against_trial.h"

#include <gtest/gtest.h>

#include "fuzz/shrink.h"
#include "tests/corpus/sample_cases.h"
#include "tests/fuzz/two_builds.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

// A base that answers by a rule: the findings for a spec.
class RuleBase final : public BaseBuild {
 public:
  using Rule = std::function<std::vector<SubjectMargin>(const Spec&)>;
  explicit RuleBase(Rule rule) : rule_(std::move(rule)) {}
  void ask(const MeasureRequest& request) override { spec_ = request.spec, ++asked; }
  Measurement answer(const std::function<void()>&) override {
    Measurement measured;
    measured.motion_hash = "0123456789abcdef";
    measured.findings = rule_(spec_);
    return measured;
  }
  int asked = 0;

 private:
  Rule rule_;
  Spec spec_;
};

ShrinkConfig against_rule(RuleBase& base) {
  ShrinkConfig config;
  config.base = &base;
  config.rules = {0.1, own_hello("").checks};
  return config;
}

Case held_elbow(int hold_frames) {
  Spec spec = bent_elbow(175);
  spec.hold_frames = hold_frames;
  return failing_case(spec, "joint_range", kElbow);
}

TEST(ShrinkAgainst, KeepsWhatTheBaseNeedsInOrderToPass) {
  const Case original = held_elbow(40);
  RuleBase base([](const Spec& spec) -> std::vector<SubjectMargin> {
    if (spec.hold_frames >= 7) return {};
    return {{"joint_range", kElbow, -2.0}};
  });
  const Shrunk both = shrink(original, stock_generator(), against_rule(base));
  EXPECT_EQ(both.stopped, "fixpoint");
  EXPECT_EQ(both.minimal.spec.hold_frames, 7);
  EXPECT_GE(both.worst.spec.hold_frames, 7);
  EXPECT_GT(base.asked, 4);
  EXPECT_LE(base.asked, both.evaluations + 4) << "the base runs only what fails in this build";
  EXPECT_EQ(shrink(original, stock_generator(), {}).minimal.spec.hold_frames, 0) << "alone it needs no pause";
}

TEST(ShrinkAgainst, GivesUpWhatTheBaseShowsAsWell) {
  RuleBase base([](const Spec&) { return std::vector<SubjectMargin>{{"joint_range", kElbow, -4.0}}; });
  EXPECT_EQ(shrink(held_elbow(40), stock_generator(), against_rule(base)).stopped, "gone");
}

TEST(ShrinkAgainst, CallsAChangingBaseFlaky) {
  class Changing final : public BaseBuild {
   public:
    void ask(const MeasureRequest&) override { ++asked_; }
    Measurement answer(const std::function<void()>&) override {
      Measurement measured;
      measured.motion_hash = std::string(15, '0') + std::to_string(asked_ % 2);
      return measured;
    }

   private:
    int asked_ = 0;
  } changing;
  ShrinkConfig config;
  config.base = &changing;
  config.rules = {0.1, own_hello("").checks};
  EXPECT_EQ(shrink(held_elbow(40), stock_generator(), config).stopped, "flaky");
}

TEST(ShrinkAgainst, StaysWhereTheBaseHasNoFindingOfTheCheck) {
  RuleBase base([](const Spec& spec) -> std::vector<SubjectMargin> {
    if (spec.hold_frames < 7 || spec.hold_frames > 30) return {{"joint_range", "arm_right/elbow max", -2.0}};
    return {};
  });
  EXPECT_EQ(shrink(held_elbow(40), stock_generator(), against_rule(base)).minimal.spec.hold_frames, 0)
      << "the first candidates have no pause, and the original was no better";
  const Shrunk clean = shrink(held_elbow(20), stock_generator(), against_rule(base));
  EXPECT_EQ(clean.minimal.spec.hold_frames, 7);
}

TEST(ShrinkAgainst, ShrinksWhatGotWorseAsLongAsItIsWorse) {
  const Case original = held_elbow(40);
  const double depth = original.expect.depth;
  ASSERT_GT(depth, 3.0);
  RuleBase base([depth](const Spec& spec) -> std::vector<SubjectMargin> {
    return {{"joint_range", kElbow, spec.hold_frames >= 5 ? -0.2 * depth : -0.9 * depth}};
  });
  const Shrunk worse = shrink(original, stock_generator(), against_rule(base));
  EXPECT_EQ(worse.stopped, "fixpoint");
  EXPECT_EQ(worse.minimal.spec.hold_frames, 5);
}

TEST(ShrinkAgainst, IsAFixpoint) {
  RuleBase base([](const Spec& spec) -> std::vector<SubjectMargin> {
    if (spec.hold_frames >= 7) return {};
    return {{"joint_range", kElbow, -2.0}};
  });
  const Case once = shrink(held_elbow(40), stock_generator(), against_rule(base)).minimal;
  EXPECT_EQ(shrink(once, stock_generator(), against_rule(base)).minimal.spec, once.spec);
}

TEST(ShrinkAgainst, TellsOnlyOfOtherFailuresThatAreNewToo) {
  const Case original = held_elbow(0);
  Evaluator evaluator(stock_generator());
  CheckTrial alone(original.expect, stock_generator(), {});
  alone.run(original.spec, kMaxFrames);
  const std::vector<Case> others = alone.others(original.spec);
  ASSERT_FALSE(others.empty());
  const Family known = family_of(others.front());
  RuleBase base([&](const Spec&) { return std::vector<SubjectMargin>{{known.check, known.subject, -1e6}}; });
  const ShrinkConfig config = against_rule(base);
  AgainstTrial both(alone, original.expect, base, config.rules, {});
  both.run(original.spec, kMaxFrames);
  for (const Case& other : both.others(original.spec)) EXPECT_NE(family_of(other), known);
}

}  // namespace
}  // namespace contort
