// aim: a point of an arm, a head or a torso, or of what it carries, is directed at a target while the body moves (P13).
// A limb's first posture comes from the aim table; every frame goes on from the one before, so that joints turn little.
#include <algorithm>
#include <array>
#include <cmath>

#include "generator/actions/hand.h"
#include "generator/actions/limb_way.h"
#include "generator/actions/two_hands.h"
#include "generator/motion/blend.h"
#include "generator/motion/ik.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr std::size_t kCandidates = 96;  // postures of the table that are tried
constexpr std::size_t kCandidatesOfTwoHands = 400;  // most of them put the object where the other hand cannot be

void place_chain(const RuleInput& in, const Posture& posture) {
  const std::span<const int> joints = in.aim->chain.joints;
  const int last = in.character.sockets()[static_cast<std::size_t>(in.aim->chain.socket)].joint;
  forward_kinematics(in.character, posture.coords, joints.front(), std::max(joints.back(), last) + 1, in.world);
}

// The chain's coordinates, in the order of its joints.
template <class Copy>
void for_coords(const RuleInput& in, Copy copy) {
  std::size_t at = 0;
  for (const int j : in.aim->chain.joints) {
    const Joint& joint = in.character.joints()[static_cast<std::size_t>(j)];
    for (int c = 0; c < coord_size(joint.kind); ++c) copy(static_cast<std::size_t>(joint.coord + c), at++);
  }
}

bool has_room_for_aim(const RuleInput& in, const Posture& posture) {
  const auto part = static_cast<std::size_t>(&in.part - in.character.parts().data());
  forward_kinematics(in.character, posture.coords, in.room.limb_of(part).joints, in.world);
  return in.room.has_room(part, in.world);
}

// Puts those postures first in which two hands hold the object with ease.
void prefer_for_two_hands(const RuleInput& in, Posture& posture, std::span<AimHit> hits) {
  const AimTable& table = *in.aim->table;
  for (AimHit& hit : hits) {
    const std::span<const double> coords = table.coords(hit.posture);
    for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = coords[at]; });
    place_chain(in, posture);
    hit.chord = awkwardness_of_two_hands(in);
  }
  std::ranges::sort(hits, [](const AimHit& a, const AimHit& b) {
    return a.chord != b.chord ? a.chord < b.chord : a.posture < b.posture;
  });
}

// Chooses, from the postures of the table that point there, the best one in which no bodies are too near, and on the
// way to it, if there is one; or in which the other hand can hold the object, too. False where all have such bodies or
// miss the target; then `posture` is of no use.
bool find_room(const RuleInput& in, const AimTarget& target, Posture& posture) {
  const AimTable& table = *in.aim->table;
  const auto base = static_cast<std::size_t>(in.character.joint(in.aim->chain.joints.front()).parent);
  std::array<double, kMaxAimCoords> present{};
  for_coords(in, [&](std::size_t coord, std::size_t at) { present[at] = in.from.coords[coord]; });
  std::array<AimHit, kCandidatesOfTwoHands> hits;
  const bool both = in.aim->second.arm >= 0 && !in.part.reach.empty();
  const std::span<AimHit> most = std::span(hits).first(both ? kCandidatesOfTwoHands : kCandidates);
  const int found = table.nearest_to_point(inverse(in.world[base]) * target.world, most);
  const std::span<AimHit> near = most.first(static_cast<std::size_t>(found));
  both ? prefer_for_two_hands(in, posture, near) : table.prefer_sighted(present, near);
  const auto fits = [&](const AimHit& hit) {
    const std::span<const double> coords = table.coords(hit.posture);
    for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = coords[at]; });
    place_chain(in, posture);
    return continue_aim(in.character, in.aim->chain, in.world, target, posture.coords).reached &&
           has_room_for_aim(in, posture);
  };
  constexpr double kNoFault = 1e-6;
  constexpr int kMostTries = 30;
  const AimHit* second_best = nullptr;
  double least = 1e30;
  int tries = 0;
  for (const AimHit& hit : near) {
    if (!fits(hit)) continue;
    const double fault = both ? fault_of_second_hand(in, posture) : has_way(in, posture) ? 0.0 : 1.0;
    if (fault < kNoFault) return true;
    if (fault < least) second_best = &hit, least = fault;
    if (both && ++tries == kMostTries) break;
  }
  return second_best != nullptr && fits(*second_best);
}

Vec3 turned_about(const Rigid& frame, const Vec3& point_m, double angle_rad) {
  return frame.p_m + axis_angle(frame.q * Vec3(0, 1, 0), angle_rad) * (point_m - frame.p_m);
}

// The point, brought to an azimuth about the frame's +Y that is within `most_rad` of `easy_rad`; also by how much it
// was beyond that.
Vec3 limited_azimuth(const Rigid& frame, const Vec3& point_m, double easy_rad, double most_rad, double& beyond_rad) {
  const double azimuth = wrap_angle(azimuth_rad(frame, point_m) - easy_rad);
  beyond_rad = std::max(0.0, std::fabs(azimuth) - most_rad);
  return turned_about(frame, point_m, azimuth > 0.0 ? -beyond_rad : beyond_rad);
}

// The target of a torso while legs turn: no farther to a side than backs twist; and level, if it only helps.
Vec3 target_of_chest(const RuleInput& in, const Vec3& target_m, double& beyond_rad) {
  constexpr double kTwist_rad = 38.0 * kRadPerDeg;
  const Rigid here{in.world[0].q, world_from_socket(in.character, in.world, in.aim->chain.socket).p_m};
  const Vec3 up = here.q * Vec3(0, 1, 0);
  const double above_m = in.aim->helps ? dot(target_m - here.p_m, up) : 0.0;
  const double easy_rad = in.aim->helps ? in.aim->second.easy_rad : 0.0;
  return limited_azimuth(here, turned_about(here, target_m - above_m * up, -easy_rad), 0.0, kTwist_rad, beyond_rad);
}

// While the torso turns to a target, the part goes on to the easiest direction that is nearest to it: it would have to
// be twisted backward, and then unwound.
Vec3 easy_target(const RuleInput& in, const Vec3& target_m, double& beyond_rad) {
  if (!in.aim->helps && !in.body.has_help) return target_m;
  if (in.aim->chest < 0) return target_of_chest(in, target_m, beyond_rad);
  const Rigid chest = world_from_socket(in.character, in.world, in.aim->chest);
  const double most_rad = in.aim->second.arm >= 0 ? kEasyOfTwoHands_rad : kEasyAim_rad;
  return limited_azimuth(chest, target_m, in.aim->second.easy_rad, most_rad, beyond_rad);
}

AimResult from_table(const RuleInput& in, const AimTarget& target, Posture& posture) {
  place_chain(in, posture);
  return aim(in.character, in.aim->chain, *in.aim->table, in.world, target, posture.coords);
}

bool aims_its_face(const RuleInput& in) {
  return !in.part.facing.empty() && in.part.facing.front().socket == in.aim->chain.socket;
}

// A head or torso faces the target as directly as it can, from rest: going on from the frame before it would come to
// lean. If this misses the target, another posture of the table may reach it.
AimResult face(const RuleInput& in, const AimTarget& target, Posture& posture) {
  constexpr int kPasses = 3;  // the point moves when the part turns
  const FacingChain& chain = in.part.facing.front();
  for (int pass = 0; pass < kPasses; ++pass) {
    const Rigid point = world_from_socket(in.character, in.world, chain.socket);
    face_direction(in.character, chain, in.world, unit_or(target.world - point.p_m, point.q * Vec3(0, 0, 1)),
                   posture.coords);
    place_chain(in, posture);
  }
  const AimResult direct = continue_aim(in.character, in.aim->chain, in.world, target, posture.coords);
  if (direct.reached || in.body.has_help) return direct;
  std::array<double, kMaxAimCoords> nearest{};
  for_coords(in, [&](std::size_t coord, std::size_t at) { nearest[at] = posture.coords[coord]; });
  const AimResult other = from_table(in, target, posture);
  if (other.reached) return other;
  for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = nearest[at]; });
  return direct;
}

// A limb goes on from the frame before.
AimResult point(const RuleInput& in, const AimTarget& target, Posture& posture) {
  WholeBody& body = in.body;
  if (body.begun != in.took_over || body.has_help != body.had_help) {
    if (!find_room(in, target, posture)) from_table(in, target, posture);
    for_coords(in, [&](std::size_t coord, std::size_t at) { body.aimed[at] = posture.coords[coord]; });
    body.begun = in.took_over;
  }
  body.had_help = body.has_help;
  for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = body.aimed[at]; });
  place_chain(in, posture);
  const AimResult result = continue_aim(in.character, in.aim->chain, in.world, target, posture.coords);
  return result.reached ? result : from_table(in, target, posture);
}

void solve(const RuleInput& in, Posture& posture) {
  double beyond_rad = 0.0;
  const Vec3 target_m = in.world_from_start * Vec3(in.params[1], in.params[2], in.params[3]);
  const AimTarget target{AimTarget::Kind::point, easy_target(in, target_m, beyond_rad)};
  const AimResult result = aims_its_face(in) ? face(in, target, posture) : point(in, target, posture);
  for_coords(in, [&](std::size_t coord, std::size_t at) { in.body.aimed[at] = posture.coords[coord]; });
  if (!aims_its_face(in)) go_round(in, posture);
  in.feedback.aim_reached = result.reached && beyond_rad == 0.0;
  in.feedback.shortfall = beyond_rad + (result.reached ? 0.0 : result.error_rad);
}

}  // namespace

double azimuth_rad(const Rigid& world_from_socket, const Vec3& point_world_m) {
  const Vec3 point_m = inverse(world_from_socket) * point_world_m;
  return det::atan2(point_m.x, point_m.z);
}

std::vector<ParamDef> aim_params(const Character& character, const Part& part) {
  ParamDef point;
  point.name = "point";
  point.type = ParamType::own_point;
  const std::vector<std::string> points = own_points(character, part);
  const bool armed = std::find(points.begin(), points.end(), "muzzle") != points.end();
  point.preset = armed ? std::string("muzzle") : points.empty() ? std::string("grip") : points.front();
  point.help = "Point that is directed: the grip of a hand, a face, or a point of a carried object.";
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -1000.0, target.high = 1000.0;
  target.preset = Vec3(0.0, 1.2, 5.0);
  target.domain = Domain::around;
  target.mirrored = Mirrored::point;
  target.help = "Target point, m, from the place where the character stood at first.";
  return {point, target};
}

bool aim_supports(const Character& character, const Part& part) {
  return (is_arm(character, part) || !part.facing.empty()) && !own_points(character, part).empty();
}

void aim_rule(const RuleInput& in, Posture& posture) {
  if (!in.part.reach.empty() || !in.part.facing.empty()) return solve(in, posture);
  // The hand: solved with its arm, which comes before it.
  for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = in.body.aimed[at]; });
}

}  // namespace contort
