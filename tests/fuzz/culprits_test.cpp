// Finds the actions of a minimal case that fail alone, with a generator whose actions are exactly known.
#include "fuzz/culprits.h"

#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <numeric>

#include "checks/judge.h"
#include "tests/swing_generator.h"

namespace contort {
namespace {

// The pendulum. Each of its actions adds an angle to all hinges, whose range is 90 degrees.
class AddingGenerator final : public Generator {
 public:
  const Manifest& manifest() const override { return pendulum_.manifest(); }
  const Offers& offers(const Character& character) override { return pendulum_.offers(character); }
  Result<Admission> admit(const Spec& spec) override { return pendulum_.admit(spec); }
  Result<Done> run(const Spec& spec, Execution& execution) override {
    static const std::map<std::string, double> kAngles_deg = {{"little", 50.0}, {"much", 100.0}, {"most", 120.0}, {"none", 0.0}};
    ++runs;
    double sum_deg = 0.0;
    for (const LoneAction& one : lone_actions_of(spec)) sum_deg += kAngles_deg.at(one.action);
    Spec swung = spec;
    ActionUse use;
    use.action = "swing";
    use.params["angle_deg"] = sum_deg;
    swung.interrupts.clear();
    swung.sequences.resize(1), swung.sequences[0].clips.resize(1);
    swung.sequences[0].clips[0].actions = {use};
    return pendulum_.run(swung, execution);
  }
  std::unique_ptr<Generator> another() const override { return std::make_unique<AddingGenerator>(); }
  Result<std::unique_ptr<Generator>> with(const Library& library) const override { return pendulum_.with(library); }

  int runs = 0;

 private:
  swing::SwingGenerator pendulum_;
};

Spec spec_with(const std::vector<std::string>& actions) {
  Spec spec;
  spec.character.name = "pendulum";
  spec.sequences.resize(1);
  for (const std::string& action : actions) {
    ClipDesc& clip = spec.sequences[0].clips.emplace_back();
    clip.actions.emplace_back().action = action;
  }
  return spec;
}

class Culprits : public ::testing::Test {
 protected:
  Cause cause_with(const std::vector<std::string>& actions) {
    Evaluator evaluator(generator_);
    const Spec spec = spec_with(actions);
    const Result<Evaluation> evaluation = evaluator.run(spec);
    EXPECT_TRUE(evaluation.ok());
    const Finding* finding = deepest(evaluation->findings, "joint_range", "body/knee max");
    if (finding == nullptr) {
      ADD_FAILURE() << "the knee is in its range";
      return {};
    }
    const Case minimal{spec, expectation_of(evaluator.execution(), *evaluation, *finding), {}};
    generator_.runs = 0;
    return find_cause(minimal, evaluator).cause;
  }
  AddingGenerator generator_;
};

TEST_F(Culprits, OneThatFailsAloneIsNamed) {
  const Cause cause = cause_with({"little", "much", "none"});
  EXPECT_EQ(cause.scope, CauseScope::alone);
  EXPECT_EQ(cause.names, (std::vector<std::string>{"much"}));
  EXPECT_TRUE(cause.also.empty());
  EXPECT_EQ(generator_.runs, 3);
}

TEST_F(Culprits, OfSeveralTheDeepestNamesTheCause) {
  const Cause cause = cause_with({"much", "most"});
  EXPECT_EQ(cause.names, (std::vector<std::string>{"most"}));
  EXPECT_EQ(cause.also, (std::vector<std::string>{"much"}));
}

TEST_F(Culprits, ActionsThatFailOnlyTogetherAreNamedTogether) {
  const Cause cause = cause_with({"little", "none", "little"});
  EXPECT_EQ(cause.scope, CauseScope::company);
  EXPECT_EQ(cause.names, (std::vector<std::string>{"little", "none"})) << "without an intent all actions are in force";
}

TEST_F(Culprits, ASingleActionNeedsNoExperiment) {
  EXPECT_EQ(cause_with({"much"}).names, (std::vector<std::string>{"much"}));
  EXPECT_EQ(generator_.runs, 0);
}

TEST_F(Culprits, AnActionThatEndsItsProcessShowsNothingAndIsMet) {
  Evaluator evaluator(generator_);
  Case minimal{spec_with({"little", "much"}), {}, {}};
  const Result<Evaluation> evaluation = evaluator.run(minimal.spec);
  ASSERT_TRUE(evaluation);
  const Finding* finding = deepest(evaluation->findings, "joint_range", "body/knee max");
  ASSERT_NE(finding, nullptr);
  minimal.expect = expectation_of(evaluator.execution(), *evaluation, *finding);
  CauseSearch search;
  search.before_run = [](const Spec& spec) {
    if (lone_actions_of(spec).size() == 1 && lone_actions_of(spec)[0].action == "much") ::raise(SIGUSR1);
  };
  search.guard = Isolation{};
  const FoundCause found = find_cause(minimal, evaluator, search);
  EXPECT_EQ(found.cause.scope, CauseScope::company);
  EXPECT_EQ(found.cause.names, (std::vector<std::string>{"little", "much"}));
  ASSERT_EQ(found.met.size(), 1U);
  EXPECT_EQ(found.met[0].expect.check, "crash");
  EXPECT_EQ(found.met[0].expect.subject, "SIGUSR1");
}

TEST_F(Culprits, AProcessThatEndedIsNotRunAgain) {
  Evaluator evaluator(generator_);
  Case ended{spec_with({"little", "much"}), {}, {}};
  ended.expect.check = "crash", ended.expect.subject = "SIGSEGV";
  EXPECT_EQ(find_cause(ended, evaluator).cause.scope, CauseScope::company);
  EXPECT_EQ(generator_.runs, 0);
}

}  // namespace
}  // namespace contort
