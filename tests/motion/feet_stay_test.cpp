// Standing feet stay in place while walk, run, crouch and squat blend in, follow one another or fade out.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/stage_evaluator.h"
#include "generator/generate.h"
#include "tests/character/stock.h"

namespace contort {
namespace {

ActionUse legs(const std::string& character, const std::string& action, int start, int duration, int blend_frames,
               std::map<std::string, ParamValue> params) {
  ActionUse use;
  use.action = action, use.slot = character == "quadruped" ? "hips" : "waist";
  use.start_frame = start, use.duration_frames = duration;
  use.blend_in_frames = use.blend_out_frames = blend_frames;
  use.params = std::move(params);
  return use;
}

Spec spec_of(const std::string& character, const std::vector<ActionUse>& uses) {
  Spec spec;
  spec.character.name = character;
  spec.sequences.resize(1);
  spec.sequences[0].clips.resize(1);
  spec.sequences[0].clips[0].actions = uses;
  return spec;
}

// A crouch cuts a walk, and feet stay apart.
Spec cut_walk(const std::string& character, int frame, int blend_frames) {
  Spec spec = spec_of(character, {legs(character, "walk", 0, 240, 0, {{"speed_m_s", 0.6}})});
  InterruptDesc interrupt;
  interrupt.when.frame = frame;
  interrupt.sequence.clips.resize(1);
  interrupt.sequence.clips[0].actions = {legs(character, "crouch", 0, 60, blend_frames, {{"share", 0.1}})};
  interrupt.resume = false;
  spec.interrupts = {interrupt};
  return spec;
}

Stage stage_of(const Spec& spec) {
  Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return std::move(stage).value();
}

// Findings of feet, and jumps: "foot_slide foot_left/foot at 61, -0.03 m".
std::vector<std::string> of_feet(const Spec& spec) {
  const Stage stage = stage_of(spec);
  StageEvaluator evaluator;
  std::vector<std::string> found;
  for (const Finding& finding : evaluator.run(stage).findings)
    if (finding.check == "foot_slide" || finding.check == "ground_penetration" || finding.check == "pop")
      found.push_back(finding.check + " " + finding.subject + " at " + std::to_string(finding.worst_frame) + ", " +
                      std::to_string(finding.worst_margin) + " m");
  return found;
}

class FeetStay : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, FeetStay, ::testing::Values("human", "mech", "quadruped"),
                         [](const auto& of) { return of.param; });

TEST_P(FeetStay, WhereOneFollowsAnother) {
  EXPECT_EQ(of_feet(spec_of(GetParam(), {legs(GetParam(), "crouch", 0, 60, 0, {{"share", 0.1}}),
                                         legs(GetParam(), "walk", 60, 180, 20, {{"speed_m_s", 0.6}}),
                                         legs(GetParam(), "squat", 240, 90, 20, {{"share", 0.1}})})),
            std::vector<std::string>{});
}

TEST_P(FeetStay, WhereOneFadesOutAndTheNextComesIn) {
  EXPECT_EQ(of_feet(spec_of(GetParam(), {legs(GetParam(), "crouch", 0, 60, 20, {{"share", 0.1}, {"back_m", 0.05}}),
                                         legs(GetParam(), "crouch", 60, 90, 20, {{"share", 0.1}, {"lean_deg", 10.0}}),
                                         legs(GetParam(), "walk", 150, 180, 20, {{"speed_m_s", 0.5}})})),
            std::vector<std::string>{});
}

TEST_P(FeetStay, WhereAnInterruptCutsAWalk) {
  for (const int frame : {60, 75, 90, 105, 120})
    EXPECT_EQ(of_feet(cut_walk(GetParam(), frame, 15)), std::vector<std::string>{}) << "cut at " << frame;
}

// Hips that rose to their height at rest over feet that still stand apart pulled knees straight at once.
TEST_P(FeetStay, AndKneesAreSlowWhereABendThatCutAWalkFades) {
  StageEvaluator evaluator;
  for (const int frame : {75, 80, 85, 90, 95})
    for (const int blend_frames : {10, 15, 20}) {
      const Stage stage = stage_of(cut_walk(GetParam(), frame, blend_frames));
      for (const Finding& finding : evaluator.run(stage).findings)
        ADD_FAILURE() << "cut at " << frame << ", " << blend_frames << ": " << finding.check << " " << finding.subject;
    }
}

// Steps of a centimetre are lifted, too: feet that only almost leave the ground slide farther with each of them.
TEST_P(FeetStay, WhereStepsAreShort) {
  const auto walk = [](int start, int duration, double speed_m_s) {
    return legs(GetParam(), "walk", start, duration, 20, {{"speed_m_s", speed_m_s}});
  };
  EXPECT_EQ(of_feet(spec_of(GetParam(), {walk(0, 38, 1.2), walk(38, 33, 1.6), walk(71, 58, 0.7), walk(130, 31, 1.4)})),
            std::vector<std::string>{});
  for (const double speed_m_s : {0.01, 0.03, 0.06, 0.1})
    EXPECT_EQ(of_feet(spec_of(GetParam(), {walk(0, 1200, speed_m_s)})), std::vector<std::string>{}) << speed_m_s;
}

TEST_P(FeetStay, AWalkThatFadesOutStaysWhereItWent) {
  const auto walk = [](int blend_frames) {
    return spec_of(GetParam(), {legs(GetParam(), "walk", 0, 300, blend_frames, {{"speed_m_s", 0.6}})});
  };
  const Motion plain = generate(stage_of(walk(0))), faded = generate(stage_of(walk(30)));
  EXPECT_GT(plain.root.back().p_m.z, 1.0);
  EXPECT_NEAR(faded.root.back().p_m.z, plain.root.back().p_m.z, 1e-9);
  EXPECT_EQ(of_feet(walk(30)), std::vector<std::string>{});
}

// Fore legs go along a course while the trunk that carries them turns: they bent beyond their ranges to reach the
// ground.
TEST(FeetStay, WhereATrunkTurnsOverACourse) {
  StageEvaluator evaluator;
  for (const char* course : {"run", "walk", "squat"})
    for (const double elevation_deg : {-20.0, 10.0, 30.0}) {
      ActionUse look;
      look.action = "direction", look.slot = "trunk";
      look.params = {{"elevation_deg", elevation_deg}, {"azimuth_deg", 15.0}};
      const Spec spec = spec_of("quadruped", {legs("quadruped", course, 0, 90, 10, {}), look});
      for (const Finding& finding : evaluator.run(stage_of(spec)).findings)
        ADD_FAILURE() << course << " " << elevation_deg << ": " << finding.check << " " << finding.subject;
    }
}

// The hips of a figure on a slope are as low as its lower foot needs. They were 5 mm lower after a bend, and a bend that
// is cut went there within a frame.
TEST(FeetStay, HipsOnASlopeAreAsHighAfterABendAsBefore) {
  for (const char* character : {"human", "mech"})
    for (const double slope_deg : {3.0, 5.0, 8.0})
      for (const int blend_frames : {1, 10}) {
        Spec spec = spec_of(character, {legs(character, "crouch", 10, 40, blend_frames, {{"share", 0.2}})});
        spec.environment.ground = SlopeGround{.slope_deg = slope_deg, .heading_deg = 70.0};
        spec.sequences[0].clips[0].actions[0].blend_in_frames = 10;
        spec.hold_frames = 10;
        const Stage stage = stage_of(spec);
        const Motion motion = generate(stage);
        EXPECT_NEAR(motion.root.back().p_m.y, motion.root.front().p_m.y, 1e-6) << character << " " << slope_deg;
        EXPECT_EQ(blend_frames > 1 ? broken_in(stage) : "", "") << character << " " << slope_deg;
      }
}

}  // namespace
}  // namespace contort
