// weapon_hold: a second hand on an attached object. The wrist straightens, and the arm keeps the grip on a point of the
// object while whatever carries the object moves it.
#include "generator/actions/hand.h"
#include "generator/actions/limb_way.h"
#include "model/motion/kinematics.h"

namespace contort {

std::vector<ParamDef> weapon_hold_params(const Character&, const Part&) {
  ParamDef point;
  point.name = "point";
  point.type = ParamType::object_point;
  point.preset = std::string("foregrip");
  point.help = "The point of an attached object that the hand holds.";
  return {point};
}

bool weapon_hold_supports(const Character& character, const Part& part) {
  return is_arm(character, part) && !object_points(character, part).empty();
}

void weapon_hold_rule(const RuleInput& in, Posture& posture) {
  const Vec3 point_m = world_from_socket(in.character, in.world, static_cast<int>(in.params[0])).p_m;
  in.feedback.shortfall = bring_grip_to(in, point_m, posture);
  if (!in.part.reach.empty()) go_round(in, posture);
}

}  // namespace contort
