#include "generator/actions/hand.h"

#include <algorithm>
#include <cmath>

#include "generator/actions/limb_reach.h"
#include "generator/motion/ik.h"
#include "model/core/detmath.h"
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

HeldObject held_object(const Character& character, int arm, int point) {
  const std::string_view name = character.sockets()[static_cast<std::size_t>(point)].name;
  const auto body = std::ranges::find(character.bodies(), name.substr(0, name.rfind('/')), &Body::name);
  if (body == character.bodies().end()) return {};
  const int grip = grip_of(character, character.parts()[static_cast<std::size_t>(arm)]);
  return {character.sockets()[static_cast<std::size_t>(grip)].joint,
          static_cast<int>(body - character.bodies().begin())};
}

void rest_part(const Character& character, const Part& part, Posture& posture) {
  std::copy_n(character.rest_coords().begin() + part.first_coord, part.coord_count,
              posture.coords.begin() + part.first_coord);
}

namespace {

constexpr int kWristPasses = 4;

// A place for a hand, in the world: the grip goes to the point, and the palm faces the direction.
struct HandPlace {
  Vec3 point_m{0.0};
  Vec3 palm{0.0, 0.0, 1.0};  // a unit vector
};

const Limb& limb_of(const RuleInput& in) {
  return in.room.limb_of(static_cast<std::size_t>(index_of(in.character, in.part)));
}

void place(const RuleInput& in, const Posture& posture) {
  forward_kinematics(in.character, posture.coords, limb_of(in).joints, in.world);
}

double& angle_of(const RuleInput& in, int joint, Posture& posture) {
  return posture.coords[static_cast<std::size_t>(in.character.joint(joint).coord)];
}

// Calls visit(joint index) for the hinges between the elbow and the grip, outermost first; as many as are remembered.
template <class Visit>
void for_wrist(const RuleInput& in, const ReachChain& chain, Visit visit) {
  const int grip = in.character.sockets()[static_cast<std::size_t>(chain.tip)].joint;
  int visited = 0;
  for (int j = grip; j > chain.middle && visited < kMaxAimCoords; j = in.character.joint(j).parent)
    if (in.character.joint(j).kind == JointKind::hinge) visit(j), ++visited;
}

double off_palm_rad(const RuleInput& in, const ReachChain& chain, const Vec3& palm) {
  const Vec3 facing = world_from_socket(in.character, in.world, chain.tip).q * Vec3(0, 0, 1);
  return det::acos(std::clamp(dot(facing, palm), -1.0, 1.0));
}

void turn_wrist(const RuleInput& in, const ReachChain& chain, const Vec3& palm, Posture& posture) {
  for_wrist(in, chain, [&](int j) {
    const Joint& joint = in.character.joint(j);
    const Vec3 facing = world_from_socket(in.character, in.world, chain.tip).q * Vec3(0, 0, 1);
    double& angle = angle_of(in, j, posture);
    angle += angle_towards(in.world[static_cast<std::size_t>(j)].q * joint.axis, facing, palm);
    angle = std::clamp(angle, joint.low, joint.high);
    place(in, posture);
  });
}

// Wrist and arm in turn, as each moves what the other one has reached; from the wrist as it is.
void reach_and_turn(const RuleInput& in, const ReachChain& chain, const HandPlace& hand_at, double swivel_rad,
                    Posture& posture) {
  for (int pass = 0; pass < kWristPasses; ++pass) {
    reach_for(in.character, chain, in.world, hand_at.point_m, swivel_rad, posture.coords);
    place(in, posture);
    turn_wrist(in, chain, hand_at.palm, posture);
  }
  reach_for(in.character, chain, in.world, hand_at.point_m, swivel_rad, posture.coords);
  place(in, posture);
}

double swivel_for(const RuleInput& in, const ReachChain& chain, const HandPlace& hand_at, Posture& posture) {
  constexpr double kOfPalm = 2.0;  // each radian
  return cheapest_swivel(in.part.side, [&](double swivel) {
    for_wrist(in, chain, [&](int j) { angle_of(in, j, posture) = 0.0; });
    reach_and_turn(in, chain, hand_at, swivel, posture);
    return cost_of_placed(in, posture) + kOfPalm * off_palm_rad(in, chain, hand_at.palm);
  });
}

void rest_carried(const Character& character, int carrier, Posture& posture) {
  for (const Part& part : character.parts())
    if (carrier_of(character, index_of(character, part)) == carrier) rest_part(character, part, posture);
}

ReachChain chain_to_grip(const Character& character, const Part& arm) {
  ReachChain chain = arm.reach.front();
  chain.tip = grip_of(character, arm);
  return chain;
}

// Gives a hand, which is moved after its arm, the angles that the arm found for it. Fingers stay at rest.
void take_wrist(const RuleInput& in, int hand, Posture& posture) {
  rest_part(in.character, in.part, posture);
  const Part& arm = in.character.parts()[static_cast<std::size_t>(carrier_of(in.character, hand))];
  if (arm.reach.empty()) return;
  std::size_t at = 0;
  for_wrist(in, chain_to_grip(in.character, arm), [&](int j) {
    const double angle = in.body.aimed[at++];
    if (in.character.joint(j).part == hand) angle_of(in, j, posture) = angle;
  });
}

double bring_palm_to(const RuleInput& in, const HandPlace& hand_at, Posture& posture) {
  const int own = index_of(in.character, in.part);
  if (in.part.reach.empty()) return take_wrist(in, own, posture), 0.0;
  const ReachChain chain = chain_to_grip(in.character, in.part);
  const bool begins = in.body.begun != in.took_over;
  rest_carried(in.character, own, posture);
  reach_with_travels(in, chain, hand_at.point_m, std::nullopt, posture);  // travels come out
  if (begins) in.body.swivel_rad = swivel_for(in, chain, hand_at, posture);
  std::size_t at = 0;
  for_wrist(in, chain, [&](int j) { angle_of(in, j, posture) = begins ? 0.0 : in.body.aimed[at++]; });
  reach_and_turn(in, chain, hand_at, in.body.swivel_rad, posture);
  at = 0;
  for_wrist(in, chain, [&](int j) { in.body.aimed[at++] = angle_of(in, j, posture); });
  return length(world_from_socket(in.character, in.world, chain.tip).p_m - hand_at.point_m);
}

// The least distance from a plane of the bodies that the elbow moves, m.
double over_plane_m(const RuleInput& in, const Vec3& point_m, const Vec3& normal) {
  double least_m = 1e30;
  for (const int j : limb_of(in).joints)
    if (j >= in.part.reach.front().middle) least_m = std::min(least_m, in.room.over_plane_m(j, point_m, normal, in.world));
  return least_m;
}

struct Laid {
  double missing_m = 0.0;  // from the grip to its place
  double off_m = 0.0;      // by which that place was moved off the surface
};

// Moves the hand's place off the surface by as much as hand and forearm need.
Laid lay_on_plane(const RuleInput& in, const Vec3& surface_m, HandPlace hand_at, Posture& posture) {
  constexpr double kClear_m = 0.002;
  constexpr int kPasses = 3;  // a forearm comes nearer or farther as the grip is moved
  Laid laid{bring_palm_to(in, hand_at, posture)};
  if (in.part.reach.empty()) return laid;
  for (int pass = 0; pass < kPasses; ++pass) {
    const double lacks_m = kClear_m - over_plane_m(in, surface_m, -hand_at.palm);
    if (lacks_m <= 0.0) break;
    laid.off_m += lacks_m;
    hand_at.point_m -= lacks_m * hand_at.palm;
    laid.missing_m = bring_palm_to(in, hand_at, posture);
  }
  return laid;
}

}  // namespace

double bring_grip_to(const RuleInput& in, const Vec3& point_world_m, Posture& posture) {
  if (in.part.reach.empty()) return rest_part(in.character, in.part, posture), 0.0;
  const int arm = index_of(in.character, in.part);
  rest_carried(in.character, arm, posture);
  // With the hand at rest the grip is as fixed to the forearm as the wrist is: two bones, the second one longer.
  return follow_with_travels(in, chain_to_grip(in.character, in.part), point_world_m, posture);
}

double lay_hand_on(const RuleInput& in, const Vec3& point_m, const Vec3& normal, double gap_m, Posture& posture) {
  const HandPlace hand_at{point_m + gap_m * normal, -normal};
  const bool begins = in.body.begun != in.took_over;
  const Laid laid = lay_on_plane(in, point_m, hand_at, posture);
  if (!begins || laid.off_m <= 0.0) return laid.missing_m;
  // The swivel was chosen for a hand in the surface: it is chosen again for one that is on it.
  in.body.begun = -1;
  bring_palm_to(in, {hand_at.point_m + laid.off_m * normal, -normal}, posture);
  return lay_on_plane(in, point_m, hand_at, posture).missing_m;
}

}  // namespace contort
