// weapon_hold: a second hand on an attached object. The wrist straightens, and the arm keeps the grip on a point of the
// object while whatever carries the object moves it.
#include <algorithm>

#include "generator/actions/action.h"
#include "generator/motion/ik.h"
#include "generator/motion/kinematics.h"

namespace contort {

namespace {

void rest_part(const Character& character, const Part& part, Posture& posture) {
  std::copy_n(character.rest_coords().begin() + part.first_coord, part.coord_count,
              posture.coords.begin() + part.first_coord);
}

// The part's own grip, or that of the part that hangs on it; else the tip of its reach chain.
int grip_of(const Character& character, const Part& part) {
  const int own = static_cast<int>(&part - character.parts().data());
  for (int s = 0; s < static_cast<int>(character.sockets().size()); ++s) {
    const Socket& socket = character.sockets()[static_cast<std::size_t>(s)];
    const int carrying = character.joints()[static_cast<std::size_t>(socket.joint)].part;
    if (std::string_view(socket.name).ends_with("/grip") && (carrying == own || carrier_of(character, carrying) == own))
      return s;
  }
  return part.reach.front().tip;
}

}  // namespace

std::vector<ParamDef> weapon_hold_params(const Character&, const Part&) {
  ParamDef point;
  point.name = "point";
  point.type = ParamType::object_point;
  point.preset = std::string("foregrip");
  point.help = "The point of an attached object that the hand holds.";
  return {point};
}

bool weapon_hold_supports(const Character& character, const Part& part) {
  return part.kind == "arm" && !part.reach.empty() && !object_points(character, part).empty();
}

void weapon_hold_rule(const RuleInput& in, Posture& posture) {
  if (in.part.reach.empty()) return rest_part(in.character, in.part, posture);
  const int arm = static_cast<int>(&in.part - in.character.parts().data());
  // The hand is moved after the arm, which must know already how it will be.
  for (const Part& part : in.character.parts())
    if (carrier_of(in.character, static_cast<int>(&part - in.character.parts().data())) == arm)
      rest_part(in.character, part, posture);
  constexpr int kPasses = 8;  // the hand turns with the forearm: each pass leaves about a tenth of the error
  const auto joint_of = [&](int socket) { return in.character.sockets()[static_cast<std::size_t>(socket)].joint; };
  const Vec3 wanted = world_from_socket(in.character, in.world, static_cast<int>(in.params[0])).p_m;
  const int grip = grip_of(in.character, in.part);
  Vec3 target = wanted;
  for (int pass = 0; pass < kPasses; ++pass) {
    reach_for(in.character, in.part.reach.front(), in.world, target, 0.0, posture.coords);
    forward_kinematics(in.character, posture.coords, in.part.first_joint, joint_of(grip) + 1, in.world);
    target += wanted - world_from_socket(in.character, in.world, grip).p_m;
  }
}

}  // namespace contort
