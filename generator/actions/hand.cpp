#include "generator/actions/hand.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/ik.h"
#include "generator/motion/kinematics.h"

namespace contort {

namespace {

int index_of(const Character& character, const Part& part) {
  return static_cast<int>(&part - character.parts().data());
}

}  // namespace

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

Vec3 rest_grip_m(const Character& character, const Part& arm) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  return world_from_socket(character, world, grip_of(character, arm)).p_m;  // the root's rest place is the frame
}

void rest_part(const Character& character, const Part& part, Posture& posture) {
  std::copy_n(character.rest_coords().begin() + part.first_coord, part.coord_count,
              posture.coords.begin() + part.first_coord);
}

double bring_grip_to(const RuleInput& in, const Vec3& point_world_m, Posture& posture) {
  constexpr int kPasses = 8;  // the hand turns with the forearm: each pass leaves about a tenth of the error
  if (in.part.reach.empty()) return rest_part(in.character, in.part, posture), 0.0;
  const int arm = index_of(in.character, in.part);
  for (const Part& part : in.character.parts())
    if (carrier_of(in.character, index_of(in.character, part)) == arm) rest_part(in.character, part, posture);
  const int grip = grip_of(in.character, in.part);
  const int last = in.character.sockets()[static_cast<std::size_t>(grip)].joint + 1;
  Vec3 target = point_world_m;
  double missing_m = 1e9;
  for (int pass = 0; pass < kPasses; ++pass) {
    reach_for(in.character, in.part.reach.front(), in.world, target, 0.0, posture.coords);
    forward_kinematics(in.character, posture.coords, in.part.first_joint, last, in.world);
    const Vec3 missing = point_world_m - world_from_socket(in.character, in.world, grip).p_m;
    const double before_m = missing_m;
    missing_m = std::sqrt(glm::dot(missing, missing));
    if (missing_m > 0.5 * before_m) break;  // out of reach: going on would only wind the arm up
    target += missing;
  }
  return missing_m;
}

}  // namespace contort
