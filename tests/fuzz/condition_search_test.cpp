// Known, planted conditions: a generator whose motions have a NaN exactly if a condition holds. The rule must name the
// values in the condition, and hold on 1,000 cases from which it was not learned.
#include "fuzz/condition_search.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "corpus/request.h"
#include "fuzz/population.h"
#include "fuzz/rule_learning.h"
#include "generator/built_in.h"

namespace contort::planted {
namespace {

using Values = std::map<std::string, RequestValue>;
using Holds = std::function<bool(const Values&)>;

double number_of(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found != values.end() ? found->second.number : std::numeric_limits<double>::quiet_NaN();
}

std::string word_of(const Values& values, const std::string& name) {
  const auto found = values.find(name);
  return found != values.end() ? found->second.word : "";
}

struct Planted {
  std::string name;
  std::vector<std::string> actions;  // actions that the request must have
  Holds holds;
  std::vector<std::set<std::string>> must_name;  // one of each set
  Spec example;                                  // a spec for which it holds
};

// Admits the same specs as the built-in generator, and stands at rest. Two frames are enough for a NaN.
class PlantedGenerator final : public Generator {
 public:
  explicit PlantedGenerator(const Planted& planted) : planted_(planted) {}
  const Manifest& manifest() const override { return built_in_.manifest(); }
  const Offers& offers(const Character& character) override { return built_in_.offers(character); }
  Result<Admission> admit(const Spec& spec) override { return built_in_.admit(spec); }
  Result<Done> run(const Spec& spec, Execution& execution) override {
    const Result<Character> built = build_character(spec.character, stock_library());
    if (!built) return built.issue();
    execution = {};
    execution.character = std::make_shared<const Character>(*built);
    Motion& motion = execution.motion;
    motion.rate_hz = spec.rate_hz, motion.coord_count = static_cast<int>(built->rest_coords().size());
    motion.frame_count = 1;
    motion.coords.assign(built->rest_coords().begin(), built->rest_coords().end());
    motion.root = {built->rest_root()};
    if (shows(spec, *built)) motion.coords.front() = std::numeric_limits<double>::quiet_NaN();
    return Done{};
  }
  std::unique_ptr<Generator> another() const override { return std::make_unique<PlantedGenerator>(planted_); }
  Result<std::unique_ptr<Generator>> with(const Library& library) const override { return built_in_.with(library); }

 private:
  bool shows(const Spec& spec, const Character& character) {
    std::vector<std::string> needs;
    for (const std::string& action : planted_.actions) needs.push_back(action + ".seconds");
    return std::ranges::any_of(requests_of(spec, needs, character, built_in_.offers(character)),
                               [&](const SpecRequest& request) {
                                 Values values;
                                 for (const RequestValue& value : request.values) values[value.name] = value;
                                 return planted_.holds(values);
                               });
  }

  const Planted& planted_;
  BuiltInGenerator built_in_{stock_library()};
};

Spec spec_of(const std::string& character, std::vector<ActionUse> uses) {
  Spec spec;
  spec.character.name = character;
  spec.sequences = {{"", 0, {ClipDesc{}}}};
  spec.sequences.front().clips.front().actions = std::move(uses);
  return spec;
}

ActionUse use_of(const std::string& action, const std::string& slot, int frames,
                 std::map<std::string, ParamValue> params) {
  ActionUse use;
  use.action = action, use.slot = slot, use.duration_frames = frames, use.params = std::move(params);
  return use;
}

Spec after(Spec spec, const std::function<void(Spec&)>& change) {
  change(spec);
  return spec;
}

double of(const Values& values, const std::string& name) { return number_of(values, name); }

// An angle of a part of the right side, as if the left side did it.
double mirrored(const Values& values, const std::string& name, const std::string& slot) {
  return word_of(values, slot).ends_with("_right") ? -of(values, name) : of(values, name);
}

const Spec kReach = spec_of("human", {use_of("reach", "arm_left", 6, {{"target_m", Vec3(0.3, 1.2, 0.7)}})});
const Spec kWalk = spec_of("human", {use_of("walk", "waist", 120, {{"speed_m_s", 1.4}, {"heading_deg", 80.0}})});
const Spec kSquat = spec_of("human", {use_of("squat", "waist", 8, {{"share", 0.5}})});
const Spec kHit = spec_of("human", {use_of("hit_reaction", "arm_left", 30, {{"strength_deg", 50.0}})});
const Spec kTwo = spec_of("human", {use_of("squat", "waist", 40, {{"share", 0.5}}),
                                    use_of("direction", "head", 40, {{"elevation_deg", 50.0}})});
const Spec kPushed = after(kHit, [](Spec& spec) {
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts = {{10, "torso", "", Vec3(0.0), Vec3(0.0, 0.0, 40.0)}};
  spec.dynamics.loads = {{"hand_left", "grip", Vec3(0.0), Vec3(0.3, 0.4, 0.15), 12.0}};
});

const std::vector<Planted>& planted_conditions() {
  static const std::vector<Planted> all = {
      {"a short action", {"reach"}, [](const Values& v) { return of(v, "reach.seconds") < 0.25; },
       {{"reach.seconds"}}, kReach},
      {"a parameter beyond a value", {"walk"}, [](const Values& v) { return of(v, "walk.speed_m_s") > 0.9; },
       {{"walk.speed_m_s"}}, kWalk},
      {"an angle to either side", {"walk"}, [](const Values& v) { return std::abs(of(v, "walk.heading_deg")) > 60.0; },
       {{"walk.heading_deg"}}, kWalk},
      {"a way", {"walk"}, [](const Values& v) { return of(v, "walk.speed_m_s") * of(v, "walk.seconds") > 0.8; },
       {{"walk.speed_m_s"}, }, kWalk},
      {"a rate", {"squat"}, [](const Values& v) { return of(v, "squat.share") / of(v, "squat.seconds") > 0.8; },
       {{"squat.share"}}, kSquat},
      {"two parameters", {"squat"},
       [](const Values& v) { return of(v, "squat.share") > 0.2 && of(v, "squat.back_m") < 0.1; },
       {{"squat.share"}, {"squat.back_m"}}, kSquat},
      {"an angle on one side of the body", {"hit_reaction"},
       [](const Values& v) { return mirrored(v, "hit_reaction.azimuth_deg", "hit_reaction.slot") > 30.0; },
       {{"hit_reaction.azimuth_deg"}},
       after(kHit, [](Spec& spec) { spec.sequences[0].clips[0].actions[0].params["azimuth_deg"] = 90.0; })},
      {"a target beyond reach", {"reach"},
       [](const Values& v) { return of(v, "reach.target_m.of_reach") > 0.95; }, {{"reach.target_m.of_reach"}},
       after(kReach, [](Spec& spec) { spec.sequences[0].clips[0].actions[0].params["target_m"] = Vec3(0.2, 1.2, 1.5); })},
      {"one slot", {"hit_reaction"}, [](const Values& v) { return word_of(v, "hit_reaction.slot") == "arm_left"; },
       {{"hit_reaction.slot"}}, kHit},
      {"one part", {"hit_reaction"}, [](const Values& v) { return word_of(v, "hit_reaction.part") == "mech_arm_shield"; },
       {{"hit_reaction.part"}},
       after(kHit, [](Spec& spec) {
         spec.character.name = "mech";
         spec.character.parts["arm_left"] = "mech_arm_shield";
       })},
      {"while it fades out", {"hit_reaction"}, [](const Values& v) { return of(v, "hit_reaction.blend_out_frames") > 0; },
       {{"hit_reaction.blend_out_frames"}},
       after(kHit, [](Spec& spec) { spec.sequences[0].clips[0].actions[0].blend_out_frames = 3; })},
      {"two actions that overlap", {"squat", "direction"}, [](const Values& v) { return of(v, "gap_seconds") < -0.1; },
       {{"gap_seconds"}}, kTwo},
      {"two actions, with a parameter of each", {"squat", "direction"},
       [](const Values& v) { return of(v, "squat.share") > 0.2 && of(v, "direction.elevation_deg") > 10.0; },
       {{"squat.share"}, {"direction.elevation_deg"}}, kTwo},
      {"a strong impact", {}, [](const Values& v) { return of(v, "impact.impulse_N_s") > 30.0; },
       {{"impact.impulse_N_s"}}, kPushed},
      {"a heavy load", {}, [](const Values& v) { return of(v, "load.mass_kg") > 10.0; }, {{"load.mass_kg"}}, kPushed},
      {"one of two reasons", {"reach"},
       [](const Values& v) { return of(v, "reach.seconds") < 0.15 || of(v, "reach.target_m.y") > 1.3; },
       {{"reach.seconds"}, {"reach.target_m.y"}}, kReach},
  };
  return all;
}

// The minimal case of the planted fault.
Case case_of(const Planted& planted, Generator& generator) {
  Evaluator evaluator(generator);
  const Result<Evaluation> run = evaluator.run(planted.example);
  EXPECT_TRUE(run) << planted.name << ": " << to_line(run.issue());
  Case minimal;
  minimal.spec = planted.example;
  if (!run || run->findings.empty()) return ADD_FAILURE() << planted.name << " does not fail", minimal;
  minimal.expect = expectation_of(evaluator.execution(), *run, run->findings.front());
  minimal.cause = cause_without_experiments(minimal.spec);
  return minimal;
}

struct Shares {
  double precision = 0.0, recall = 0.0;
};

// Measured on 1,000 draws that were used neither for learning the rule nor for trying it.
Shares shares_on_fresh_cases(const Condition& condition, const Case& minimal, Generator& generator) {
  const Result<Population> population = Population::like(minimal, generator);
  Evaluator evaluator(generator);
  int told = 0, failing = 0, both = 0;
  for (std::int64_t i = 0, drawn = 0; drawn < 1000; ++i) {
    const std::optional<DrawnRequest> one = population->draw(generator, (std::int64_t{1} << 40) + i);
    if (!one) continue;
    ++drawn;
    const bool fails = !evaluator.run(one->spec)->findings.empty(), is_told = rule_holds(condition.any_of, one->request);
    told += is_told, failing += fails, both += is_told && fails;
  }
  return {told > 0 ? 1.0 * both / told : 0.0, failing > 0 ? 1.0 * both / failing : 0.0};
}

bool names_all(const Condition& condition, const Planted& planted) {
  const std::string rule = rule_text(condition.any_of);
  return std::ranges::all_of(planted.must_name, [&](const std::set<std::string>& names) {
    return std::ranges::any_of(names, [&](const std::string& name) { return rule.find(name) != std::string::npos; });
  });
}

TEST(ConditionSearch, FindsThePlantedConditions) {
  int named = 0;
  for (const Planted& planted : planted_conditions()) {
    PlantedGenerator generator(planted);
    const Case minimal = case_of(planted, generator);
    const Result<Condition> found = find_condition(minimal, generator, {}, {.jobs = 2});
    ASSERT_TRUE(found) << planted.name << ": " << to_line(found.issue());
    EXPECT_TRUE(has_rule(*found)) << planted.name << ": " << condition_text(*found);
    const Shares shares = shares_on_fresh_cases(*found, minimal, generator);
    EXPECT_GE(shares.precision, 0.9) << planted.name << ": " << condition_text(*found);
    EXPECT_GE(shares.recall, 0.8) << planted.name << ": " << condition_text(*found);
    EXPECT_TRUE(names_all(*found, planted)) << planted.name << ": " << condition_text(*found);
    named += names_all(*found, planted);
    std::printf("%-40s %.2f %.2f  %s\n", planted.name.c_str(), shares.precision, shares.recall,
                rule_text(found->any_of).c_str());
  }
  EXPECT_EQ(named, std::ssize(planted_conditions()));
}

TEST(ConditionSearch, DoesNotDependOnTheNumberOfThreads) {
  const Planted& planted = planted_conditions()[5];
  PlantedGenerator generator(planted);
  const Case minimal = case_of(planted, generator);
  EXPECT_EQ(*find_condition(minimal, generator, {}, {.jobs = 1}), *find_condition(minimal, generator, {}, {.jobs = 3}));
}

TEST(ConditionSearch, SaysAlwaysOfWhatAlwaysFails) {
  const Planted planted{"always", {"squat"}, [](const Values&) { return true; }, {}, kSquat};
  PlantedGenerator generator(planted);
  const Result<Condition> found = find_condition(case_of(planted, generator), generator, {}, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->any_of, std::vector<Conjunction>{{}});
  EXPECT_EQ(condition_text(*found), "Fails in 100 % of 60 fresh cases, whatever their values are.");
}

// A rule that was learned from noise does not hold on fresh cases, so none is reported.
TEST(ConditionSearch, TellsNoRuleForAFailureThatFollowsNone) {
  const auto noise = [](const Values& v) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(of(v, "squat.share")) ^ std::bit_cast<std::uint64_t>(of(v, "squat.seconds"));
    for (int i = 0; i < 3; ++i) bits = (bits ^ (bits >> 31)) * 0x9e3779b97f4a7c15ULL;
    return bits >> 63 == 0;
  };
  const Planted planted{"noise", {"squat"}, noise, {}, kSquat};
  PlantedGenerator generator(planted);
  Case minimal = case_of({"always", {"squat"}, [](const Values&) { return true; }, {}, kSquat}, generator);
  minimal.expect.check = "non_finite";
  const Result<Condition> found = find_condition(minimal, generator, {}, {.jobs = 2});
  ASSERT_TRUE(found);
  EXPECT_FALSE(has_rule(*found)) << condition_text(*found);
  EXPECT_GT(found->failing, 60);
  EXPECT_LT(found->failing, found->drawn - 60);
}

TEST(ConditionSearch, LearnsNothingAboutEndingsAndRecordings) {
  Case ending;
  ending.expect.check = "crash";
  EXPECT_FALSE(can_have_condition(ending));
  Case recorded;
  recorded.expect.check = "pop", recorded.spec = kSquat, recorded.spec.recording.name = "clip";
  EXPECT_FALSE(can_have_condition(recorded));
  recorded.spec.recording.name = "";
  EXPECT_TRUE(can_have_condition(recorded));
}

}  // namespace
}  // namespace contort::planted
