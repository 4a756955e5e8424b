// Requests of specs, rules as texts, files and C++, and their merging.
#include "corpus/condition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "corpus/merge.h"
#include "corpus/request.h"
#include "corpus/rules_header.h"
#include "generator/built_in.h"
#include "model/motion/kinematics.h"
#include "tests/corpus/temp_folder.h"

namespace contort::rules {
namespace {

Condition any_condition() {
  Condition condition{.cause = "0123456789ab",
                      .headline = "Left hand goes through right thigh during reach",
                      .character = "human",
                      .character_hash = "00ff",
                      .tool = "0.1.0",
                      .learned_from = "0123",
                      .needs = {"reach.seconds"}};
  condition.any_of = {{{.name = "reach.seconds", .op = known::Op::below, .limit = 0.4, .lowest = 0.38, .highest = 0.41},
                       {.name = "reach.target_m.x", .is_mirrored = true, .op = known::Op::above, .limit = 0.1}},
                      {{.name = "reach.slot", .op = known::Op::is, .word = "arm_left"}}};
  condition.drawn = 300, condition.failing = 50;
  condition.trial = {60, 57, 60, 3, 0.25};
  return condition;
}

known::Question request_of(const std::vector<known::Value>& values) { return {"human", values}; }

TEST(Conditions, AreSentences) {
  Condition condition = any_condition();
  EXPECT_EQ(condition_text(condition),
            "Fails in 95 % of 60 fresh cases where reach.seconds < 0.4 and reach.target_m.x (as on the left) > 0.1, or "
            "reach.slot is arm_left, and in 5 % of 60 others.");
  condition.any_of.clear();
  EXPECT_EQ(condition_text(condition),
            "No rule of at most 4 comparisons tells when it fails (17 % of 300 drawn cases do).");
}

TEST(Conditions, HaveThePrecisionAndRecallOfTheirTrial) {
  const RuleTrial trial{60, 57, 60, 3, 0.25};
  EXPECT_DOUBLE_EQ(precision_of(trial), 0.95);
  EXPECT_DOUBLE_EQ(failing_outside(trial), 0.05);
  EXPECT_DOUBLE_EQ(recall_of(trial), 0.25 * 0.95 / (0.25 * 0.95 + 0.75 * 0.05));
  EXPECT_EQ(recall_of({}), 0.0);
}

TEST(Conditions, AreReadAsTheyAreWritten) {
  Condition never = any_condition();
  never.character = "mech", never.any_of.clear(), never.trial = {};
  const std::vector<Condition> all = {any_condition(), never};
  const Result<std::vector<Condition>> read = parse_conditions(print_conditions(all));
  ASSERT_TRUE(read) << to_line(read.issue());
  EXPECT_EQ(*read, all);
  const Result<std::vector<Condition>> bad = parse_conditions(R"({"format": "contort.rules/1", "rules": [{"cause": 5}]})");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.issue().pointer, "/rules/0/cause");
}

TEST(Rules, HoldOnlyIfTheRequestTellsWhatTheyNeed) {
  const RuleTable table({any_condition()});
  ASSERT_EQ(table.rules().size(), 1U);
  const known::KnownRule& rule = table.rules().front();
  EXPECT_FALSE(known::holds(rule, request_of({{"reach.slot", 0, "arm_left"}})));  // no reach.seconds
  EXPECT_TRUE(known::holds(rule, request_of({{"reach.seconds", 2}, {"reach.slot", 0, "arm_left"}})));
  EXPECT_FALSE(known::holds(rule, {"mech", std::vector<known::Value>{{"reach.seconds", 2}, {"reach.slot", 0, "arm_left"}}}));
  EXPECT_FALSE(known::holds(rule, request_of({{"reach.seconds", 0.3}})));
}

TEST(Rules, CountWhatTheRightSideDoesMirrored) {
  const RuleTable table({any_condition()});
  const known::KnownRule& rule = table.rules().front();
  const auto holds = [&](const char* slot, double x) {
    return known::holds(rule, request_of({{"reach.seconds", 0.3}, {"reach.target_m.x", x}, {"reach.slot", 0, slot}}));
  };
  EXPECT_TRUE(holds("arm_right", -0.2));
  EXPECT_FALSE(holds("arm_right", 0.2));
  EXPECT_TRUE(holds("head", 0.2));
  EXPECT_FALSE(holds("head", -0.2));
}

TEST(Rules, CompareQuantitiesThatAreMadeOfAValueAndTheLengthOfItsAction) {
  const auto amount = [](known::Quantity quantity, double seconds) {
    const known::Value values[] = {{"walk.speed_m_s", -3.0}, {"walk.seconds", seconds}};
    double told = 0.0;
    return known::tells_amount({"human", values}, {"walk.speed_m_s", quantity}, told) ? told : -1e9;
  };
  EXPECT_EQ(amount(known::Quantity::value, 2.0), -3.0);
  EXPECT_EQ(amount(known::Quantity::magnitude, 2.0), 3.0);
  EXPECT_EQ(amount(known::Quantity::per_second, 2.0), -1.5);
  EXPECT_EQ(amount(known::Quantity::magnitude_per_second, 2.0), 1.5);
  EXPECT_EQ(amount(known::Quantity::times_seconds, 2.0), -6.0);
  EXPECT_EQ(amount(known::Quantity::per_second, 0.0), -1e9) << "an action without length has no rates";
}

// ---- requests

Spec two_reaches() {
  Spec spec;
  spec.character.name = "human";
  spec.rate_hz = 50.0;
  ActionUse reach;
  reach.action = "reach", reach.slot = "arm_left", reach.duration_frames = 20, reach.start_frame = 10;
  reach.params["target_m"] = Vec3(0.2, 1.4, 0.3);
  ActionUse other = reach;
  other.slot = "arm_right", other.start_frame = 0, other.duration_frames = 5;
  ActionUse squat;
  squat.action = "squat", squat.slot = "waist", squat.duration_frames = 40;
  ClipDesc fast, slow;
  fast.actions = {reach, other}, fast.speed = 2.0, fast.start_frame = 4;
  slow.actions = {squat};
  spec.sequences = {{"", 0, {fast}}, {"", 80, {slow}}};
  return spec;
}

class Requests : public testing::Test {
 protected:
  std::vector<SpecRequest> of(const Spec& spec, const std::vector<std::string>& needs) {
    const Result<Character> character = build_character(spec.character, stock_library());
    return requests_of(spec, needs, *character, generator_.offers(*character));
  }
  static double number(const SpecRequest& request, const std::string& name) {
    const auto found = std::ranges::find(request.values, name, &RequestValue::name);
    return found != request.values.end() ? found->number : std::nan("");
  }

 private:
  BuiltInGenerator generator_{stock_library()};
};

TEST_F(Requests, ThereIsOneForEachUseWithItsLengthAsPlayed) {
  const std::vector<SpecRequest> requests = of(two_reaches(), {"reach.seconds"});
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_DOUBLE_EQ(number(requests[0], "reach.seconds"), 20 / 2.0 / 50.0);
  EXPECT_DOUBLE_EQ(number(requests[1], "reach.seconds"), 5 / 2.0 / 50.0);
  EXPECT_EQ(number(requests[0], "reach.target_m.y"), 1.4);
  EXPECT_EQ(number(requests[0], "reach.blend_in_frames"), -1.0);
}

// The fast clip is 15 frames long from frame 4; the squat begins in frame 19 and is stretched to twice its length.
TEST_F(Requests, AGapCountsFromTheEndOfTheEarlierActionToTheStartOfTheLaterOne) {
  const std::vector<SpecRequest> requests = of(two_reaches(), {"reach.seconds", "squat.seconds"});
  ASSERT_EQ(requests.size(), 2U);
  EXPECT_DOUBLE_EQ(number(requests[0], "squat.seconds"), 80 / 50.0);
  EXPECT_NEAR(number(requests[0], "gap_seconds"), (19 - (4 + 15)) / 50.0, 1e-12);
  EXPECT_NEAR(number(requests[1], "gap_seconds"), (19 - (4 + 2.5)) / 50.0, 1e-12);
}

TEST_F(Requests, AreNotMadeOfSpecsThatLackWhatTheCauseNeeds) {
  EXPECT_TRUE(of(two_reaches(), {"walk.seconds"}).empty());
  EXPECT_TRUE(of(two_reaches(), {"reach.seconds", "simulated"}).empty());
  EXPECT_TRUE(of(two_reaches(), {"impact.impulse_N_s"}).empty());
  Spec pushed = two_reaches();
  pushed.dynamics.mode = Mode::dynamic;
  pushed.dynamics.impacts = {{3, "torso", "", {}, {3, 0, 4}}, {9, "head", "", {}, {0, 0, 4}}};
  const std::vector<SpecRequest> requests = of(pushed, {"impact.impulse_N_s", "simulated"});
  ASSERT_EQ(requests.size(), 1U);
  EXPECT_EQ(number(requests[0], "impact.impulse_N_s"), 5.0);
}

TEST_F(Requests, TellHowFarATargetIsInLengthsOfTheLimb) {
  Spec spec = two_reaches();
  const auto share = [&](double scale) {
    const Result<Character> human = build_character(spec.character, stock_library());
    const ReachChain& arm = human->parts()[static_cast<std::size_t>(human->find_part("arm_left"))].reach.front();
    std::vector<Rigid> world(human->joints().size());
    forward_kinematics(*human, human->rest_root(), human->rest_coords(), world);
    const Vec3 shoulder = world[static_cast<std::size_t>(arm.upper)].p_m;
    const double arm_m = length(world[static_cast<std::size_t>(arm.middle)].p_m - shoulder) +
                         length(world_from_socket(*human, world, arm.tip).p_m -
                                world[static_cast<std::size_t>(arm.middle)].p_m);
    spec.sequences[0].clips[0].actions[0].params["target_m"] = shoulder + Vec3(0, 0, scale * arm_m);
    return number(of(spec, {"reach.seconds"}).front(), "reach.target_m.of_reach");
  };
  EXPECT_NEAR(share(0.5), 0.5, 1e-12);
  EXPECT_NEAR(share(1.1), 1.1, 1e-12);
}

// ---- as C++

// Compiles the header as a game would, and asks it.
TEST(RulesHeader, AnswersAsTheRulesDo) {
  const TempFolder folder;
  Condition always = any_condition();
  always.cause = "ffff", always.headline = "Says \"\\ouch?\?/\n", always.needs = {}, always.any_of = {{}};
  always.character = "mech";
  spill(folder / "rules.h", rules_header({any_condition(), always}, "a \\ \"corpus\""));
  spill(folder / "game.cpp", R"(#include "rules.h"
using namespace contort::known;
static bool goes_wrong(const Question& question) { return find_rule(kRules, question) != nullptr; }
int main() {
  const Value left[] = {{"reach.slot", 0, "arm_left"}, {"reach.seconds", 2}};
  const Value fast[] = {{"reach.slot", 0, "arm_right"}, {"reach.seconds", 0.3}, {"reach.target_m.x", -0.2}};
  const Value slow[] = {{"reach.slot", 0, "arm_right"}, {"reach.seconds", 0.5}, {"reach.target_m.x", -0.2}};
  if (kRules.size() != 2 || !goes_wrong({"human", left}) || !goes_wrong({"human", fast})) return 1;
  if (goes_wrong({"human", slow}) || goes_wrong({"human", {}}) || !goes_wrong({"mech", {}})) return 2;
  return find_rule(kRules, {"mech", {}})->text.starts_with("Says \"\\ouch?\?/\n: Fails") ? 0 : 3;
}
)");
  const std::string compile = "c++ -std=c++20 -Wall -Wextra -Wconversion -Wshadow -Werror -o " + (folder / "game") + " " +
                              (folder / "game.cpp");
  ASSERT_EQ(std::system(compile.c_str()), 0);
  EXPECT_EQ(std::system((folder / "game").c_str()), 0);
}

TEST(RulesHeader, OfNoRulesCompiles) {
  const TempFolder folder;
  spill(folder / "rules.h", rules_header({}, "nothing"));
  spill(folder / "game.cpp", "#include \"rules.h\"\nint main() { return contort::known::kRules.empty() ? 0 : 1; }\n");
  ASSERT_EQ(std::system(("c++ -std=c++20 -Wall -Wextra -Werror -o " + (folder / "game") + " " + (folder / "game.cpp")).c_str()), 0);
  EXPECT_EQ(std::system((folder / "game").c_str()), 0);
}

// ---- merging

TEST(Conditions, MergeInAnyOrderToTheBestOfEachCauseAndCharacter) {
  Condition worse = any_condition();
  worse.trial.inside_failing = 50;
  Condition other = any_condition();
  other.character = "mech";
  const std::vector<Condition> merged = merged_conditions({worse, other, any_condition()});
  EXPECT_EQ(merged, (std::vector<Condition>{any_condition(), other}));
  EXPECT_EQ(merged_conditions({any_condition(), worse, other, worse}), merged);
}

void store(const Corpus& corpus, const Condition& condition) {
  ASSERT_TRUE(change_conditions(corpus, [&](std::vector<Condition>& stored) { stored.push_back(condition); }));
}

// Two programs that learn at the same time both read before either writes.
TEST(Conditions, AChangeKeepsWhatWasStoredSinceTheyWereRead) {
  const TempFolder folder;
  const Result<Corpus> corpus = Corpus::create(folder / "a");
  ASSERT_TRUE(corpus);
  ASSERT_TRUE(conditions_of(*corpus)->empty());
  Condition other = any_condition();
  other.character = "mech";
  store(*corpus, any_condition()), store(*corpus, other);
  EXPECT_EQ(*conditions_of(*corpus), (std::vector<Condition>{any_condition(), other}));
}

TEST(Conditions, AreNotReadFromOutsideTheCorpusNorOverwrittenWhereTheyAreDamaged) {
  const TempFolder folder;
  const Result<Corpus> corpus = Corpus::create(folder / "a"), from = Corpus::create(folder / "b");
  ASSERT_TRUE(corpus && from);
  store(*from, any_condition());
  std::filesystem::create_symlink(folder / "b/rules.json", folder / "a/rules.json");
  EXPECT_EQ(conditions_of(*corpus).issue().code, "file.outside");
  std::filesystem::remove(folder / "a/rules.json");
  spill(folder / "a/rules.json", "{");
  const Result<Merged> merged = merge({*from}, *corpus);
  ASSERT_TRUE(merged);
  EXPECT_EQ(merged->damaged.size(), 1U);
  EXPECT_EQ(slurp(folder / "a/rules.json"), "{");
}

TEST(Conditions, ComeAlongWhenCorporaMerge) {
  const TempFolder folder;
  const Result<Corpus> a = Corpus::create(folder / "a"), b = Corpus::create(folder / "b"), into = Corpus::create(folder / "c");
  ASSERT_TRUE(a && b && into);
  Condition other = any_condition();
  other.character = "mech";
  store(*a, any_condition()), store(*b, other);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(merge({*b, *a}, *into));
    const Result<std::vector<Condition>> merged = conditions_of(*into);
    ASSERT_TRUE(merged);
    EXPECT_EQ(*merged, (std::vector<Condition>{any_condition(), other}));
  }
}

TEST(Conditions, OfACorpusWithoutRulesAreNone) {
  const TempFolder folder;
  const Result<Corpus> corpus = Corpus::create(folder / "a");
  ASSERT_TRUE(corpus);
  EXPECT_EQ(*conditions_of(*corpus), std::vector<Condition>{});
  spill(folder / "a/rules.json", "{");
  EXPECT_EQ(conditions_of(*corpus).issue().code, "json.syntax");
}

}  // namespace
}  // namespace contort::rules
