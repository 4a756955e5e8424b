// Feet that an action has moved return to where they stood, and figures stand on any slope that specs allow.
#include <gtest/gtest.h>

#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "tests/character/stock.h"
#include "tests/generator/scenes_of_one.h"
#include "tests/stage_evaluator.h"

namespace contort {
namespace {

using fixtures::sequence;
using fixtures::use;

Spec spec_with(const std::string& character, const ActionUse& action, int hold_frames) {
  Spec spec;
  spec.character.name = character;
  spec.hold_frames = hold_frames;
  spec.sequences = {sequence({action})};
  return spec;
}

std::vector<Finding> findings_in(const Spec& spec, StageEvaluator& evaluator) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  EXPECT_TRUE(stage);
  return stage ? evaluator.run(*stage).findings : std::vector<Finding>{};
}

// A foot that had been lifted once hung over the ground for good, or went up and down there.
TEST(Landing, ALegThatWasHitIsBackWithinHalfASecond) {
  StageEvaluator evaluator;
  for (const std::string name : {"human", "mech", "quadruped"}) {
    const std::vector<Leg> legs = find_legs(fixtures::built({name, {}, {}}));
    for (int draw = 0; draw < 24; ++draw) {
      const Leg& leg = legs[at(draw) % legs.size()];
      const std::string slot = fixtures::built({name, {}, {}}).parts()[at(leg.part)].slot;
      ActionUse hit = use("hit_reaction", slot, 12, 12 + 2 * draw,
                          {{"azimuth_deg", 37 * draw % 340 - 170.0}, {"strength_deg", 20.0 + draw}});
      hit.blend_in_frames = ActionUse{}.blend_in_frames;
      for (const Finding& finding : findings_in(spec_with(name, hit, 40), evaluator))
        if (finding.check == "residue" || finding.check == "foot_slide" || finding.check == "ground_penetration")
          ADD_FAILURE() << name << " " << slot << " draw " << draw << ": " << finding.check;
      const Motion& motion = evaluator.motion();
      const std::span<const double> last = motion.row(motion.frame_count - 1), first = motion.row(0);
      EXPECT_TRUE(std::ranges::equal(first, last, [](double a, double b) { return std::fabs(a - b) < 1e-9; }))
          << name << " " << slot << " draw " << draw;
    }
  }
}

bool shows(const Spec& spec, StageEvaluator& evaluator, const std::string& check) {
  return std::ranges::any_of(findings_in(spec, evaluator), [&](const Finding& finding) { return finding.check == check; });
}

// The hand cannot go up because the thigh is too near, and the thigh cannot go back because of the hand: the leg stayed
// in the air for good.
TEST(Landing, ALegComesBackPastAHandThatWaitsForIt) {
  ActionUse hit = use("hit_reaction", "leg_left", 1, 30, {});
  hit.blend_in_frames = ActionUse{}.blend_in_frames;
  Spec spec = spec_with("human", hit, 60);
  ActionUse reach = use("reach", "arm_left", 0, 62, {{"target_m", Vec3(-0.05, 1.93, 0.07)}});
  reach.blend_in_frames = ActionUse{}.blend_in_frames;
  spec.sequences.front().clips.front().actions.push_back(reach);
  StageEvaluator evaluator;
  EXPECT_FALSE(shows(spec, evaluator, "residue"));
  const Motion& motion = evaluator.motion();
  const Character human = fixtures::built({"human", {}, {}});
  const Joint& hip = human.joint(human.find_joint("leg_left/hip_flex"));
  EXPECT_NEAR(motion.row(motion.frame_count - 1)[at(hip.coord)], 0.0, 1e-9);
  EXPECT_FALSE(shows(spec, evaluator, "self_collision"));
}

// The crouch takes the foot over as it was seen: turned by the hit, which must not turn it once more.
TEST(Landing, ACourseThatTakesOverAFootThatWasHitDoesNotPutItIntoTheGround) {
  StageEvaluator evaluator;
  for (const std::string course : {"crouch", "run", "walk"})
    for (const double azimuth_deg : {-120.0, 120.0, 0.0}) {
      ActionUse hit = use("hit_reaction", "foot_right", 0, 30, {{"azimuth_deg", azimuth_deg}, {"strength_deg", 34.0}});
      hit.blend_in_frames = ActionUse{}.blend_in_frames;
      Spec spec = spec_with("human", hit, 10);
      ActionUse taking = use(course, "waist", 4, 60, {});
      taking.blend_in_frames = ActionUse{}.blend_in_frames;
      spec.sequences.front().clips.front().actions.push_back(taking);
      EXPECT_FALSE(shows(spec, evaluator, "ground_penetration")) << course << " " << azimuth_deg;
    }
}

// The trunk that carries the leg swings back while the paw comes down: the paw lands where it will stand.
TEST(Landing, APawDoesNotSlideWhenTheTrunkIsHitWhileItLands) {
  StageEvaluator evaluator;
  for (const int start : {10, 19, 25}) {
    ActionUse leg = use("hit_reaction", "leg_fore_right", 0, 30, {});
    ActionUse trunk = use("hit_reaction", "trunk", start, 30, {{"azimuth_deg", 170.0}});
    leg.blend_in_frames = trunk.blend_in_frames = ActionUse{}.blend_in_frames;
    Spec spec = spec_with("quadruped", leg, 40);
    spec.sequences.front().clips.front().actions.push_back(trunk);
    EXPECT_FALSE(shows(spec, evaluator, "foot_slide")) << start;
  }
}

// The trunk bends until the fore legs can bend no further, and no paw moves. It is reported as unmet.
TEST(Landing, ATrunkGoesOnlyAsFarAsTheLegsThatItCarriesReach) {
  StageEvaluator evaluator;
  for (const auto& [joint, angle_deg] : {std::pair("lumbar_flex_deg", -29.0), std::pair("lumbar_flex_deg", 30.0),
                                         std::pair("lumbar_rot_deg", -25.0), std::pair("lumbar_lat_deg", 25.0)})
    for (const int frames : {20, 45, 90}) {
      const Spec spec = spec_with("quadruped", use("pose", "trunk", 0, frames, {{joint, angle_deg}}), 20);
      for (const Finding& finding : findings_in(spec, evaluator))
        ADD_FAILURE() << joint << " " << frames << ": " << finding.check << " " << finding.subject;
    }
  const Spec too_far = spec_with("quadruped", use("pose", "trunk", 0, 90, {{"lumbar_flex_deg", -29.0}}), 20);
  const Result<Stage> stage = build_stage(too_far, stock_library());
  ASSERT_TRUE(stage);
  const std::vector<UnmetRequest> unmet = intent_of(*stage).unmet;
  ASSERT_EQ(unmet.size(), 1U);
  EXPECT_EQ(unmet.front().why, Shortfall::out_of_reach);
}

// Three frames are not enough to stand up from a squat.
TEST(Landing, ASquatThatIsToFadeFasterThanLegsMoveBeginsToFadeEarlier) {
  StageEvaluator evaluator;
  for (const std::string name : {"human", "mech"})
    for (const int fade : {1, 3, 6}) {
      ActionUse squat = use("squat", "waist", 0, 30, {});
      squat.speed = 0.7, squat.blend_out_frames = fade, squat.blend_in_frames = ActionUse{}.blend_in_frames;
      const Spec spec = spec_with(name, squat, 10);
      for (const std::string check : {"angular_velocity", "pop", "foot_slide"})
        EXPECT_FALSE(shows(spec, evaluator, check)) << name << " " << fade << " " << check;
    }
}

// Hips that go ahead stretch the legs: just before a knee is straight it turns fast for a single frame, between the
// frames at which long squats were tried.
TEST(Landing, AKneeIsNotTooFastWhereALongSquatStretchesIt) {
  StageEvaluator evaluator;
  for (const int frames : {60, 72, 90, 120})
    for (const double back_m : {-0.3, -0.5}) {
      const ActionUse squat = use("squat", "waist", 0, frames, {{"share", 0.0}, {"back_m", back_m}});
      Spec spec = spec_with("mech", squat, 10);
      spec.character.parts = {{"leg_left", "mech_leg_reverse"}};
      for (const std::string check : {"angular_velocity", "angular_acceleration", "pop", "foot_slide"})
        EXPECT_FALSE(shows(spec, evaluator, check)) << frames << " " << back_m << " " << check;
    }
}

// Ankles tilt less far than the ground, and a leg need not become straight.
TEST(Landing, FiguresAtRestStandOnSlopesOfAnyHeading) {
  StageEvaluator evaluator;
  for (const std::string name : {"human", "mech", "quadruped"})
    for (const double slope_deg : {8.0, 16.0, 23.0, 25.0})
      for (double heading_deg = -180.0; heading_deg < 180.0; heading_deg += 15.0) {
        Spec spec;
        spec.character.name = name;
        spec.hold_frames = 3;
        spec.environment.ground = SlopeGround{slope_deg, heading_deg};
        for (const Finding& finding : findings_in(spec, evaluator))
          ADD_FAILURE() << name << " on " << slope_deg << " to " << heading_deg << ": " << finding.check << " "
                        << finding.subject;
      }
}

// The elbow of a fore leg does not open as far as to be straight.
TEST(Landing, ALegIsAsLongAsItsMiddleJointAllows) {
  for (const std::string name : {"human", "mech", "quadruped"}) {
    const Character character = fixtures::built({name, {}, {}});
    std::vector<Rigid> world(character.joints().size());
    for (const Leg& leg : find_legs(character)) {
      const ReachChain& chain = character.parts()[at(leg.part)].reach.front();
      const Joint& middle = character.joint(chain.middle);
      std::vector<double> row(character.rest_coords().begin(), character.rest_coords().end());
      double longest_m = 0.0;
      for (int step = 0; step <= 2000; ++step) {
        row[at(middle.coord)] = middle.low + (middle.high - middle.low) * step / 2000.0;
        forward_kinematics(character, character.rest_root(), row, world);
        longest_m = std::max(longest_m,
                             length(world_from_socket(character, world, chain.tip).p_m - world[at(chain.upper)].p_m));
      }
      EXPECT_NEAR(leg.length_m, longest_m, 1e-4) << name;
    }
  }
}

}  // namespace
}  // namespace contort
