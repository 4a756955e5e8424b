// Fields of a spec that have defaults: all are found, with correct pointers, and each can be set separately.
#include "fuzz/spec_field.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "fuzz/draw.h"
#include "tests/corpus/sample_cases.h"
#include "tests/stage_evaluator.h"

namespace contort {

namespace {

using Json = nlohmann::json;

Spec drawn_at_random() {
  return draw_spec({{"human", "mech"}}, stock_generator(), *rc::gen::inRange(0, 100), *rc::gen::inRange(0, 1000));
}

std::vector<SpecField> places(const Spec& spec) {
  const Result<Character> character = build_character(spec.character, stock_library());
  return spec_fields_of(spec, stock_generator(), character ? &*character : nullptr);
}

RC_GTEST_PROP(SpecFields, PointersLeadToTheirValuesInTheFile, ()) {
  const Spec spec = drawn_at_random();
  const Json file = Json::parse(print_spec(spec));
  for (const SpecField& place : places(spec)) {
    const Json& value = file.at(Json::json_pointer(place.pointer));
    if (value.is_number()) RC_ASSERT(place.is_number && value.get<double>() == place.value);
  }
}

RC_GTEST_PROP(SpecFields, EveryNumberIsSetAlone, ()) {
  const Spec spec = drawn_at_random();
  const std::vector<SpecField> all = places(spec);
  for (const SpecField& place : all) {
    if (!place.is_number || place.low == place.high) continue;
    Spec changed = spec;
    set_spec_field(changed, place, place.value + 1.0);
    Json before = Json::parse(print_spec(spec)), after = Json::parse(print_spec(changed));
    // A number that is at its default now is not in the file; all others are as they were.
    const Json::json_pointer at(place.pointer);
    if (!after.contains(at)) continue;
    RC_ASSERT(after.at(at).get<double>() == place.value + 1.0);
    after[at] = before[at];
    RC_ASSERT(after == before);
  }
}

RC_GTEST_PROP(SpecFields, AfterAResetOfAllThereIsNoneLeft, ()) {
  Spec spec = drawn_at_random();
  spec.rate_hz = 30;
  spec.recording.from_s = 2.0;
  spec.start.position_m = Vec3(1.0, 0.0, 2.0);
  spec.sequences[0].name = spec.sequences[0].clips[0].name = "named";
  const std::size_t actions = spec.sequences[0].clips[0].actions.size();
  reset_spec_fields(spec, places(spec));
  for (const SpecField& place : places(spec))  // a vector stays, with three defaults in it
    ADD_FAILURE() << place.pointer;
  RC_ASSERT(spec.rate_hz == 60.0 && spec.start == StartDesc{} && spec.recording == RecordingDesc{});
  RC_ASSERT(std::holds_alternative<PlaneGround>(spec.environment.ground));
  RC_ASSERT(spec.sequences[0].clips[0].actions.size() == actions);
}

RC_GTEST_PROP(SpecFields, ResettingOneByOneIsResettingAtOnce, ()) {
  const Spec spec = drawn_at_random();
  Spec at_once = spec, one_by_one = spec;
  const std::vector<SpecField> all = places(spec);
  reset_spec_fields(at_once, all);
  for (const SpecField& place : all) reset_spec_fields(one_by_one, std::span(&place, 1));
  RC_ASSERT(at_once == one_by_one);
}

const SpecField& place_at(const std::vector<SpecField>& all, const std::string& end) {
  for (const SpecField& place : all)
    if (place.pointer.ends_with(end)) return place;
  ADD_FAILURE() << "no place " << end;
  static const SpecField none;
  return none;
}

TEST(SpecFields, NumbersHaveTheLimitsAndLatticesOfTheirDeclarations) {
  Spec spec = spec_of({pose_use("arm_right", {{"elbow_deg", 80.0}, {"shoulder_deg", Vec3(1, 2, 3)}}, 90)});
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.loads = {{"torso", "back", {}, {0.3, 0.4, 0.15}, 7.0}};
  spec.dynamics.impacts = {{3, "head", "", {}, {0, 20, 0}}};
  const std::vector<SpecField> all = places(spec);
  const SpecField& elbow = place_at(all, "/params/elbow_deg");
  EXPECT_EQ(elbow.value, 80.0);
  EXPECT_EQ(elbow.low, -360.0);
  EXPECT_EQ(elbow.high, 360.0);
  EXPECT_EQ(elbow.steps_per_unit, 1.0);
  EXPECT_EQ(place_at(all, "/params/shoulder_deg/2").value, 3.0);
  EXPECT_EQ(place_at(all, "/duration_frames").high, 180.0) << "twice what it is";
  EXPECT_EQ(place_at(all, "/loads/0/mass_kg").preset, 5.0);
  EXPECT_EQ(place_at(all, "/loads/0/mass_kg").steps_per_unit, 2.0);
  EXPECT_EQ(place_at(all, "/impacts/0/impulse_N_s/1").low, -40.0);
}

TEST(SpecFields, AModeIsLoweredByOne) {
  Spec spec = bent_elbow(90);
  spec.dynamics.mode = Mode::dynamic;
  EXPECT_EQ(place_at(places(spec), "/dynamics/mode").value, 2.0);
  set_spec_field(spec, place_at(places(spec), "/dynamics/mode"), 1.0);
  EXPECT_EQ(spec.dynamics.mode, Mode::tracking);
}

TEST(SpecFields, AModeWithAnImpactIsNotLoweredBecauseOnlyDynamicControlAnswersIt) {
  Spec spec = bent_elbow(90);
  spec.dynamics.mode = Mode::dynamic;
  spec.dynamics.impacts.emplace_back().slot = "head";
  for (const SpecField& place : places(spec)) EXPECT_FALSE(place.pointer.ends_with("/dynamics/mode"));
}

TEST(SpecFields, WithoutTheCharacterParametersHaveNoLimits) {
  const Spec spec = bent_elbow(90);
  const SpecField elbow = place_at(spec_fields_of(spec, stock_generator(), nullptr), "/params/elbow_deg");
  EXPECT_EQ(elbow.preset, 0.0);
  EXPECT_TRUE(std::isinf(elbow.low) && std::isinf(elbow.high));
}

TEST(SpecFields, ASpecAsItIsByDefaultHasNone) { EXPECT_TRUE(spec_fields_of(Spec{}, stock_generator(), nullptr).empty()); }

}  // namespace

}  // namespace contort
