#include "generator/actions/hand.h"

#include <algorithm>
#include <cmath>

#include "generator/actions/limb_reach.h"
#include "generator/motion/ik.h"
#include "model/motion/legs.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

int index_of(const Character& character, const Part& part) {
  return static_cast<int>(&part - character.parts().data());
}

}  // namespace

bool is_arm(const Character& character, const Part& part) {
  return !part.reach.empty() && find_sole(character, index_of(character, part)) < 0;
}

int grip_of(const Character& character, const Part& arm) {
  const int own = index_of(character, arm);
  for (int s = 0; s < static_cast<int>(character.sockets().size()); ++s) {
    const Socket& socket = character.sockets()[static_cast<std::size_t>(s)];
    const int carrying = character.joints()[static_cast<std::size_t>(socket.joint)].part;
    if (std::string_view(socket.name).ends_with("/grip") && (carrying == own || carrier_of(character, carrying) == own))
      return s;
  }
  return arm.reach.front().tip;
}

Vec3 easy_grip_m(const Character& character, const Part& arm) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  // The root's rest place is the frame.
  const Vec3 shoulder = world[static_cast<std::size_t>(arm.reach.front().upper)].p_m;
  return shoulder + 0.8 * (world_from_socket(character, world, grip_of(character, arm)).p_m - shoulder);
}

void rest_part(const Character& character, const Part& part, Posture& posture) {
  std::copy_n(character.rest_coords().begin() + part.first_coord, part.coord_count,
              posture.coords.begin() + part.first_coord);
}

double bring_grip_to(const RuleInput& in, const Vec3& point_world_m, Posture& posture) {
  if (in.part.reach.empty()) return rest_part(in.character, in.part, posture), 0.0;
  const int arm = index_of(in.character, in.part);
  for (const Part& part : in.character.parts())
    if (carrier_of(in.character, index_of(in.character, part)) == arm) rest_part(in.character, part, posture);
  // With the hand at rest the grip is as fixed to the forearm as the wrist is: two bones, the second one longer.
  ReachChain chain = in.part.reach.front();
  chain.tip = grip_of(in.character, in.part);
  return reach_with_travels(in, chain, point_world_m, std::nullopt, posture);
}

}  // namespace contort
