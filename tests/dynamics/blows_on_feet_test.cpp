// Blows on feet that stand: the ground holds them from the first frame on, and a leg that overbends lets its foot go.
#include <gtest/gtest.h>

#include <cmath>

#include "generator/generate.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

struct Kick {
  const char* character;
  const char* slot;
  Vec3 impulse_N_s;
  int frame = 0;
};

Stage kicked(const Kick& kick, Mode mode) {
  Spec spec;
  spec.character.name = kick.character;
  spec.hold_frames = 40;
  spec.dynamics.mode = mode;
  spec.dynamics.impacts = {{kick.frame, kick.slot, "", Vec3(0.0), kick.impulse_N_s}};
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) throw std::logic_error(to_line(stage.issue()));
  return *stage;
}

// The greatest distance of any joint with one coordinate from its first angle, and beyond its range, rad.
struct Farthest {
  double from_start_rad = 0.0, beyond_rad = 0.0;
};
Farthest farthest(const Character& character, const Motion& motion) {
  Farthest out;
  for (const Joint& joint : character.joints()) {
    if (joint.kind != JointKind::hinge) continue;
    for (int f = 0; f < motion.frame_count; ++f) {
      const double angle = motion.row(f)[static_cast<std::size_t>(joint.coord)];
      const double start = motion.row(0)[static_cast<std::size_t>(joint.coord)];
      out.from_start_rad = std::max(out.from_start_rad, std::fabs(angle - start));
      out.beyond_rad = std::max({out.beyond_rad, angle - joint.high, joint.low - angle});
    }
  }
  return out;
}

TEST(BlowsOnFeet, AKickInTheFirstFrameFindsTheFootOnTheGround) {
  for (const double along : {-1.0, 1.0})
    for (const int frame : {0, 5}) {
      const Stage stage = kicked({"human", "foot_right", Vec3(0.5 * along, 0.0, 0.0), frame}, Mode::dynamic);
      const Motion motion = generate(stage);
      EXPECT_LT(farthest(*stage.character, motion).from_start_rad, 0.01) << frame;
      for (const Stance& stance : motion.response.stances) EXPECT_EQ(stance.footing, Footing::standing) << frame;
    }
}

TEST(BlowsOnFeet, TrackingStandsOnGroundThatHoldsItsSoles) {
  const Stage stage = kicked({"human", "foot_right", Vec3(0.0, 0.0, -4.0)}, Mode::tracking);
  const Motion motion = generate(stage);
  EXPECT_LT(farthest(*stage.character, motion).from_start_rad, 0.01);
}

TEST(BlowsOnFeet, ALegThatOverbendsLetsItsFootGo) {
  for (const double upward_N_s : {8.0, 10.5, 16.0}) {
    const Stage stage = kicked({"quadruped", "leg_fore_right", Vec3(0.0, upward_N_s, 0.0), 1}, Mode::dynamic);
    EXPECT_LT(farthest(*stage.character, generate(stage)).beyond_rad, 0.1) << upward_N_s;
  }
}

}  // namespace
}  // namespace contort
