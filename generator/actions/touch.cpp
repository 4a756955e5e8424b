// touch: the hand lightly touches the nearest obstacle while something else goes on. Where none is near enough, the arm
// does what it did.
#include "generator/actions/hand.h"
#include "generator/actions/limb_way.h"
#include "model/motion/kinematics.h"

namespace contort {

std::vector<ParamDef> touch_params(const Character&, const Part&) {
  ParamDef within;
  within.name = "within_m";
  within.low = 0.0, within.high = 3.0;
  within.preset = 0.6;
  within.help = "Greatest distance between the hand and a surface that it touches.";
  ParamDef gap;
  gap.name = "gap_m";
  gap.low = 0.0, gap.high = 0.5;
  gap.preset = 0.03;
  gap.help = "Least distance between the grip and the surface; a hand that needs more keeps more.";
  return {within, gap};
}

bool touch_supports(const Character& character, const Part& part) { return is_arm(character, part); }

void touch_rule(const RuleInput& in, Posture& posture) {
  constexpr double kTouch_m = 0.005;
  // Seen from where the hand would be easily, not from where it is: else the touch would follow itself along the wall.
  const Rigid world_from_character = in.world[0] * inverse(in.character.rest_root());
  const Surface surface = in.environment.nearest_obstacle(world_from_character * in.easy_grip_m);
  if (surface.obstacle < 0 || surface.distance_m > in.params[0]) return;
  const double missing_m = lay_hand_on(in, surface.point_m, surface.normal, in.params[1], posture);
  if (!in.part.reach.empty()) go_round(in, posture);
  in.feedback.contact = !in.part.reach.empty() && missing_m < kTouch_m;
}

}  // namespace contort
