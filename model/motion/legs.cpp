#include "model/motion/legs.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"
#include "model/core/math.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

bool is_sole_of(const Character& character, const Socket& socket, int leg_part) {
  if (!std::string_view(socket.name).ends_with("/sole") || socket.name.starts_with("object:")) return false;
  const int part = character.joints()[static_cast<std::size_t>(socket.joint)].part;
  if (part == leg_part) return true;
  const Part& own = character.parts()[static_cast<std::size_t>(part)];
  if (own.joint_count == 0 || part == 0) return false;
  const int carrier = character.joints()[static_cast<std::size_t>(own.first_joint)].parent;
  return character.joints()[static_cast<std::size_t>(carrier)].part == leg_part;
}

// The joints from below the chain's tip to the sole; only hinges.
void find_ankles(const Character& character, const ReachChain& chain, Leg& leg) {
  const int tip = character.sockets()[static_cast<std::size_t>(chain.tip)].joint;
  std::vector<int> upward;
  for (int j = character.sockets()[static_cast<std::size_t>(leg.sole)].joint; j > 0 && j != tip;
       j = character.joints()[static_cast<std::size_t>(j)].parent)
    if (character.joints()[static_cast<std::size_t>(j)].kind == JointKind::hinge) upward.push_back(j);
  leg.ankle_count = static_cast<int>(std::min<std::size_t>(upward.size(), leg.ankles.size()));
  std::copy_n(upward.rbegin(), leg.ankle_count, leg.ankles.begin());
  leg.has_ankle_pair = leg.ankle_count == 2 && character.joint(leg.ankles[1]).parent == leg.ankles[0] &&
                       character.sockets()[static_cast<std::size_t>(leg.sole)].joint == leg.ankles[1];
}

void stretch_over(const Vec3& point_m, double radius_m, Leg& leg) {
  for (const int i : {0, 2}) {
    leg.low_m[i] = std::min(leg.low_m[i], point_m[i] - radius_m);
    leg.high_m[i] = std::max(leg.high_m[i], point_m[i] + radius_m);
  }
}

// The footprint covers the parts of colliders that are less than 2 cm above the sole.
void measure_footprint(const Character& character, Leg& leg) {
  const Socket& sole = character.sockets()[static_cast<std::size_t>(leg.sole)];
  const Rigid sole_from_joint = inverse(sole.joint_from_socket);
  for (const Collider& collider : character.colliders()) {
    if (collider.joint != sole.joint) continue;
    if (const auto* hull = std::get_if<ConvexHull>(&collider.shape))
      for (const Vec3& p : hull->points_m)
        if (const Vec3 point = sole_from_joint * p; point.y < 0.02) stretch_over(point, 0.0, leg);
    const Box* box = std::get_if<Box>(&collider.shape);
    if (box == nullptr) continue;
    const Quat q = from_rotation_vector(box->rotation_deg * kRadPerDeg);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
      const Vec3 point = sole_from_joint * (box->center_m + q * (sign * box->half_m));
      if (point.y < 0.02) stretch_over(point, 0.0, leg);
    }
  }
}

// The distance from hip to ankle with the joint between them straight, or as nearly straight as its range allows.
double longest_m(const Joint& middle, const Rigid& world_from_middle, const Vec3& hip, const Vec3& ankle, double q) {
  const Vec3 knee = world_from_middle.p_m, up = hip - knee, down = ankle - knee;
  const double stretched_m = length(up) + length(down);
  if (middle.kind != JointKind::hinge) return stretched_m;
  const Vec3 axis = world_from_middle.q * middle.axis;
  const Vec3 up_flat = up - glm::dot(up, axis) * axis, down_flat = down - glm::dot(down, axis) * axis;
  const auto distance_m = [&](double turn_rad) { return length(axis_angle(axis, turn_rad) * down - up); };
  constexpr double kRounding_rad = 1e-6;
  double straight_rad = det::atan2(glm::dot(axis, glm::cross(down_flat, -up_flat)), -glm::dot(down_flat, up_flat));
  for (const double turn_rad : {straight_rad, straight_rad - 2.0 * kPi, straight_rad + 2.0 * kPi})
    if (q + turn_rad >= middle.low - kRounding_rad && q + turn_rad <= middle.high + kRounding_rad) return stretched_m;
  return std::max(distance_m(middle.low - q), distance_m(middle.high - q));
}

// The greatest tilt by the ankle's hinge about the sole's Z.
double tilt_of_ankle_rad(const Character& character, std::span<const Rigid> world, const Leg& leg) {
  const Vec3 along = world_from_socket(character, world, leg.sole).q * Vec3(0, 0, 1);
  for (int i = 0; i < leg.ankle_count; ++i) {
    const int j = leg.ankles[static_cast<std::size_t>(i)];
    const Joint& joint = character.joint(j);
    if (std::fabs(glm::dot(world[static_cast<std::size_t>(j)].q * joint.axis, along)) > 0.9)
      return std::max(0.0, std::min(-joint.low, joint.high));
  }
  return kPi / 2;
}

void measure(const Character& character, const ReachChain& chain, std::span<const Rigid> world, Leg& leg) {
  const Rigid character_from_world = inverse(world[0] * inverse(character.rest_root()));
  const Rigid world_from_sole = world_from_socket(character, world, leg.sole);
  const Vec3 hip = world[static_cast<std::size_t>(chain.upper)].p_m;
  const Vec3 ankle = world_from_socket(character, world, chain.tip).p_m;
  leg.home_m = character_from_world * world_from_sole.p_m;
  leg.hip_m = character_from_world * hip;
  leg.sole_from_ankle = inverse(world_from_sole) * ankle;
  const Joint& middle = character.joint(chain.middle);
  const double q = character.rest_coords()[static_cast<std::size_t>(middle.coord)];
  leg.length_m = longest_m(middle, world[static_cast<std::size_t>(chain.middle)], hip, ankle, q);
  leg.tilts_rad = tilt_of_ankle_rad(character, world, leg);
  leg.side = leg.home_m.x >= 0.0 ? 0 : 1;
  measure_footprint(character, leg);
}

void number_rows(std::vector<Leg>& legs) {
  for (Leg& leg : legs) {
    std::vector<double> behind;  // distinct rows farther back
    for (const Leg& other : legs) {
      const auto same = [&](double z) { return std::fabs(z - other.home_m.z) < 0.1; };
      if (other.home_m.z < leg.home_m.z - 0.1 && std::none_of(behind.begin(), behind.end(), same))
        behind.push_back(other.home_m.z);
    }
    leg.row = static_cast<int>(behind.size());
  }
}

void append_joints(const Part& part, Leg& leg) {
  for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j) leg.joints.push_back(j);
}

}  // namespace

int find_sole(const Character& character, int leg_part) {
  for (std::size_t s = 0; s < character.sockets().size(); ++s)
    if (is_sole_of(character, character.sockets()[s], leg_part)) return static_cast<int>(s);
  return -1;
}

std::vector<Leg> find_legs(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  std::vector<Leg> legs;
  for (std::size_t p = 0; p < character.parts().size() && legs.size() < kMaxLegs; ++p) {
    const Part& part = character.parts()[p];
    if (part.reach.empty()) continue;
    Leg leg;
    leg.part = static_cast<int>(p);
    leg.sole = find_sole(character, leg.part);
    if (leg.sole < 0) continue;
    leg.foot_part =
        character.joints()[static_cast<std::size_t>(character.sockets()[static_cast<std::size_t>(leg.sole)].joint)]
            .part;
    append_joints(part, leg);
    if (leg.foot_part != leg.part) append_joints(character.parts()[static_cast<std::size_t>(leg.foot_part)], leg);
    find_ankles(character, part.reach.front(), leg);
    measure(character, part.reach.front(), world, leg);
    legs.push_back(leg);
  }
  number_rows(legs);
  return legs;
}

}  // namespace contort
