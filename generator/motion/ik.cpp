#include "generator/motion/ik.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"
#include "model/motion/hinge_angles.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

double& coord_of(std::span<double> row, const Joint& joint) { return row[static_cast<std::size_t>(joint.coord)]; }

// The tip seen from the middle joint's moving frame, with the joints between them as they are.
Vec3 tip_in_middle(const Character& character, const ReachChain& chain, std::span<const double> row) {
  const Socket& tip = character.sockets()[static_cast<std::size_t>(chain.tip)];
  Vec3 point = tip.joint_from_socket.p_m;
  for (int j = tip.joint; j != chain.middle && j > 0; j = character.joint(j).parent) {
    const Joint& joint = character.joint(j);
    point = joint.parent_from_joint * (joint_motion(joint, row) * point);
  }
  return point;
}

// The distance of v from [low, high]; 0 inside.
double outside(double v, double low, double high) { return std::max({low - v, v - high, 0.0}); }

// Angle of a hinge at `elbow` (axis a) that brings a point, `tip` in the hinge's frame, to the distance from the
// origin. |elbow + R tip|^2 is a constant plus 2 |elbow_t| |tip_t| cos(angle + phase), t: across the axis.
double bend_for_distance(const Vec3& elbow, const Vec3& tip, const Joint& hinge, double distance_m) {
  const Vec3& a = hinge.axis;
  const Vec3 elbow_t = elbow - glm::dot(elbow, a) * a;
  const Vec3 tip_t = tip - glm::dot(tip, a) * a;
  const double along = glm::dot(elbow, a) * glm::dot(tip, a);
  const double wanted = distance_m * distance_m - glm::dot(elbow, elbow) - glm::dot(tip, tip);
  const std::array<double, 2> angles =
      solve_turn(glm::dot(elbow_t, tip_t), glm::dot(a, glm::cross(tip_t, elbow_t)), 0.5 * wanted - along);
  const auto off = [&](double angle) { return outside(angle, hinge.low, hinge.high); };
  return off(angles[0]) <= off(angles[1]) ? angles[0] : angles[1];
}

void set_upper(const Character& character, const ReachChain& chain, const Quat& rotation, std::span<double> row) {
  const Joint& upper = character.joint(chain.upper);
  double* q = &coord_of(row, upper);
  if (upper.kind == JointKind::ball) {
    q[0] = rotation.w, q[1] = rotation.x, q[2] = rotation.y, q[3] = rotation.z;
    return;
  }
  const Joint& second = character.joint(chain.upper + 1);
  const Joint& third = character.joint(chain.upper + 2);
  const Vec3 angles = hinge_angles(upper.axis, second.axis, third.axis, rotation);
  coord_of(row, upper) = angles.x;
  coord_of(row, second) = angles.y;
  coord_of(row, third) = angles.z;
}

void set_to_rest(const Joint& joint, std::span<double> row) {
  double* q = &coord_of(row, joint);
  q[0] = joint.kind == JointKind::ball ? 1.0 : 0.0;
  if (joint.kind == JointKind::ball) q[1] = q[2] = q[3] = 0.0;
}

// Turns one joint so that `facing` (world) comes nearest to `wanted`; answers false where the joint cannot help.
bool turn_joint(const Joint& joint, const Rigid& world_from_joint, const Vec3& facing, const Vec3& wanted,
                std::span<double> row) {
  double* q = &coord_of(row, joint);
  if (joint.kind == JointKind::ball) {
    const Quat in_joint = glm::conjugate(world_from_joint.q) * shortest_arc(facing, wanted) * world_from_joint.q;
    const Quat turned = glm::normalize(Quat(q[0], q[1], q[2], q[3]) * in_joint);
    q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
    return true;
  }
  const double step = angle_towards(world_from_joint.q * joint.axis, facing, wanted);
  q[0] += step;
  return std::fabs(step) > 1e-13;
}

}  // namespace

std::array<double, 2> solve_turn(double x, double y, double wanted) {
  const double size = std::sqrt(x * x + y * y);
  if (size < 1e-12) return {0.0, 0.0};
  const double phase = det::atan2(y, x);
  // Near its ends acos makes 1e-8 rad out of rounding: a leg that stands straight would shiver. There it is straight.
  const double share = wanted / size;
  const double open = std::fabs(share) > 1.0 - 1e-12 ? (share > 0.0 ? 0.0 : kPi) : det::acos(share);
  return {wrap_angle(phase + open), wrap_angle(phase - open)};
}

// The first hinge leaves what lies along its axis as it is, so that the second must bring that part of the direction:
// along + in_plane cos(angle - phase) = wanted.
std::array<double, 2> hinge_pair_angles(const HingePair& pair, const Vec3& axis, const Vec3& direction) {
  const Vec3 first = glm::conjugate(pair.between) * pair.first_axis;
  const Vec3& second = pair.second_axis;
  const double along = glm::dot(first, second) * glm::dot(second, axis);
  const double x = glm::dot(first, axis) - along;
  const double y = glm::dot(first, glm::cross(second, axis));
  const std::array<double, 2> turns = solve_turn(x, y, glm::dot(pair.first_axis, direction) - along);
  const double turn = std::fabs(turns[0]) < std::fabs(turns[1]) ? turns[0] : turns[1];
  const Vec3 turned = pair.between * (axis_angle(second, turn) * axis);
  return {angle_towards(pair.first_axis, turned, direction), turn};
}

void reach_for(const Character& character, const ReachChain& chain, std::span<const Rigid> world,
               const Vec3& target_world_m, double swivel_rad, std::span<double> row) {
  const Joint& upper = character.joint(chain.upper);
  const Joint& middle = character.joint(chain.middle);
  const Rigid upper_from_world = inverse(world[static_cast<std::size_t>(upper.parent)] * upper.parent_from_joint);
  const Vec3 target = upper_from_world * target_world_m;
  const double distance_m = std::sqrt(glm::dot(target, target));

  // The elbow in the hinge's own axes, because that is where its axis is given.
  const Vec3 tip = tip_in_middle(character, chain, row);
  const Rigid& upper_from_middle = middle.parent_from_joint;
  const Vec3 elbow = glm::conjugate(upper_from_middle.q) * upper_from_middle.p_m;
  coord_of(row, middle) = bend_for_distance(elbow, tip, middle, distance_m);

  const Vec3 tip_at_rest = upper_from_middle * (joint_motion(middle, row) * tip);
  const Vec3 to_target = unit_or(target, Vec3(0, -1, 0));
  const Quat swing = shortest_arc(unit_or(tip_at_rest, to_target), to_target);
  set_upper(character, chain, axis_angle(to_target, swivel_rad) * swing, row);
}

namespace {

// Joints, and all that moves between the first of them and the socket.
struct TurnedChain {
  const Character& character;
  std::span<const int> joints;
  int socket;
  Vec3 socket_axis;

  int end() const { return std::max(joints.back(), character.sockets()[static_cast<std::size_t>(socket)].joint) + 1; }
  Vec3 facing(std::span<const Rigid> world) const {
    return world_from_socket(character, world, socket).q * socket_axis;
  }
};

// The change of `facing` with a joint's angle, as an axis to turn about; what lies along `facing` does nothing.
Vec3 turning_part(const Vec3& axis, const Vec3& facing) { return axis - glm::dot(axis, facing) * facing; }

// The turn y, across `facing`, of which each joint takes its share, so that together they make `wanted`: the solution
// with the smallest angles, y = (sum of p p^T)^-1 wanted, by the pseudo-inverse with damping (Buss, "Introduction to
// Inverse Kinematics with Jacobian Transpose, Pseudoinverse and Damped Least Squares methods", 2004).
Vec3 shared_turn(const TurnedChain& chain, std::span<const Rigid> world, const Vec3& facing, const Vec3& wanted) {
  constexpr double kDamping = 1e-4;
  const Vec3 u =
      unit_or(turning_part(std::fabs(facing.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), facing), Vec3(1, 0, 0));
  const Vec3 v = glm::cross(facing, u);
  double uu = kDamping, uv = 0.0, vv = kDamping;
  for (const int j : chain.joints) {
    const Joint& joint = chain.character.joint(j);
    const Vec3 p = turning_part(world[static_cast<std::size_t>(j)].q * joint.axis, facing);
    const bool is_ball = joint.kind == JointKind::ball;
    const double pu = glm::dot(p, u), pv = glm::dot(p, v);
    uu += is_ball ? 1.0 : pu * pu, uv += is_ball ? 0.0 : pu * pv, vv += is_ball ? 1.0 : pv * pv;
  }
  const double wu = glm::dot(wanted, u), wv = glm::dot(wanted, v), det = uu * vv - uv * uv;
  return ((vv * wu - uv * wv) / det) * u + ((uu * wv - uv * wu) / det) * v;
}

// A few such steps. What they leave, where the way is far or the joints cannot get there, sweeps do.
void turn_together(const TurnedChain& chain, std::span<Rigid> world, const Vec3& direction_world,
                   std::span<double> row) {
  constexpr int kPasses = 8;
  for (int pass = 0; pass < kPasses; ++pass) {
    const Vec3 facing = chain.facing(world);
    const Vec3 wanted = to_rotation_vector(shortest_arc(facing, direction_world));
    if (glm::dot(wanted, wanted) < 1e-24) return;
    const Vec3 turn = shared_turn(chain, world, facing, wanted);
    for (const int j : chain.joints) {
      const Joint& joint = chain.character.joint(j);
      const Quat& world_from_joint = world[static_cast<std::size_t>(j)].q;
      double* q = &coord_of(row, joint);
      if (joint.kind == JointKind::ball) {
        const Quat turned = glm::normalize(Quat(q[0], q[1], q[2], q[3]) *
                                           from_rotation_vector(glm::conjugate(world_from_joint) * turn));
        q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
      } else {
        q[0] += glm::dot(world_from_joint * joint.axis, turn);
      }
    }
    forward_kinematics(chain.character, row, chain.joints.front(), chain.end(), world);
  }
}

void sweep(const TurnedChain& chain, std::span<Rigid> world, const Vec3& direction_world, std::span<double> row) {
  constexpr int kMaxSweeps = 12;
  const Character& character = chain.character;
  const std::span<const int> joints = chain.joints;
  const int last = chain.end();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool moved = false;
    for (std::size_t i = joints.size(); i-- > 0;) {
      const int j = joints[i];
      const Vec3 facing = chain.facing(world);
      const Vec3 apart = glm::cross(facing, direction_world);
      if (glm::dot(apart, apart) < 1e-24 && glm::dot(facing, direction_world) > 0.0) return;
      moved |= turn_joint(character.joint(j), world[static_cast<std::size_t>(j)], facing, direction_world, row);
      forward_kinematics(character, row, j, last, world);
    }
    if (!moved) return;
  }
}

void go_to_rest(const TurnedChain& chain, std::span<Rigid> world, std::span<double> row) {
  for (const int j : chain.joints) set_to_rest(chain.character.joint(j), row);
  forward_kinematics(chain.character, row, chain.joints.front(), chain.end(), world);
}

}  // namespace

void face_direction(const Character& character, const FacingChain& facing, std::span<Rigid> world,
                    const Vec3& direction_world, std::span<double> row) {
  const TurnedChain chain{character, facing.joints, facing.socket, Vec3(0, 0, 1)};
  go_to_rest(chain, world, row);
  turn_together(chain, world, direction_world, row);
  sweep(chain, world, direction_world, row);
}

void turn_axis_to(const Character& character, std::span<const int> joints, int socket, const Vec3& socket_axis,
                  std::span<Rigid> world, const Vec3& direction_world, std::span<double> row) {
  const TurnedChain chain{character, joints, socket, socket_axis};
  go_to_rest(chain, world, row);
  sweep(chain, world, direction_world, row);
}

}  // namespace contort
