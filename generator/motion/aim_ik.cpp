// aimIK, the seed's P14. The aim vector is moved from the aim point p to the joint's origin o, and the target T by the
// same vector o - p: the virtual target is T + (o - p). Turning the joint so that the moved vector points at the
// virtual target is turning f to the direction of (T + o - p) - o = T - p; so a joint's own place does not enter, and
// for a target direction one free joint is exact. For a target point p moves with the joint, and the turn is repeated.
#include "generator/motion/aim_ik.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "model/core/assert.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kMaxIterations = 48;    // of one start
constexpr int kCandidates = 8;        // starts from the table, after the interpolated one
constexpr double kWorthwhile = 0.98;  // a sweep that leaves more than this share of the error is a stall
constexpr int kMaxStalls = 3;         // in a row
constexpr int kHalvings = 4;          // of a turn that made the error greater
// A turn is at most this many times the error. An axis that is nearly parallel to the aim moves it hardly at all: its
// best turn may be half a circle for a thousandth of a degree, and a hand that rolls so from one frame to the next is a
// jump. The other joints do what is left.
constexpr double kTurnPerError = 2.0;

double angle_between(const Vec3& a, const Vec3& b) {
  const Vec3 across = glm::cross(a, b);
  return det::atan2(std::sqrt(glm::dot(across, across)), glm::dot(a, b));
}

class Aimer {
 public:
  Aimer(const Character& character, const AimChain& chain, std::span<Rigid> world, const AimTarget& target,
        std::span<double> row)
      : character_(character), chain_(chain), target_(target), world_(world), row_(row) {
    CONTORT_ASSERT(!chain.joints.empty() && chain.joints.size() <= kMaxAimJoints);
    const int carrier = character.sockets()[static_cast<std::size_t>(chain.socket)].joint;
    end_ = std::max(chain.joints.back(), carrier) + 1;
  }

  // Places the joints from `first` on.
  void place(int first) { forward_kinematics(character_, row_, first, end_, world_); }

  const Joint& joint(int index) const { return character_.joints()[static_cast<std::size_t>(index)]; }
  double* coords(const Joint& joint) { return row_.data() + joint.coord; }

  void clamp_all() {
    for (const int j : chain_.joints)
      if (joint(j).kind != JointKind::prismatic) clamp_to_range(joint(j), coords(joint(j)));
    place(chain_.joints.front());
  }

  double error_rad() const {
    const auto [facing, wanted] = lines();
    return angle_between(facing, wanted);
  }

  // Sweeps until the target is reached or nothing moves on.
  AimResult solve() {
    AimResult result{error_rad(), 0, false};
    for (int stalls = 0; result.iterations < kMaxIterations && stalls < kMaxStalls;) {
      result.reached = result.error_rad <= kAimReached_rad;
      if (result.reached) break;
      const double before = result.error_rad;
      result.error_rad = sweep(before);
      ++result.iterations;
      if (result.error_rad == before) break;
      stalls = result.error_rad > kWorthwhile * before ? stalls + 1 : 0;
    }
    result.reached = result.error_rad <= kAimReached_rad;
    return result;
  }

 private:
  struct Lines {
    Vec3 facing;  // unit, world
    Vec3 wanted;
  };

  Lines lines() const {
    const Rigid at = world_from_socket(character_, world_, chain_.socket);
    const Vec3 facing = at.q * Vec3(0, 0, 1);
    const bool point = target_.kind == AimTarget::Kind::point;
    return {facing, unit_or(point ? target_.world - at.p_m : target_.world, -facing)};
  }

  // Outermost joint first, as in cyclic coordinate descent: the hand turns before the arm is moved.
  double sweep(double error) {
    for (std::size_t i = chain_.joints.size(); i-- > 0 && error > kAimReached_rad;) {
      const int j = chain_.joints[i];
      if (joint(j).kind == JointKind::ball) error = attempt(j, ball_turn(j), error);
      if (joint(j).kind != JointKind::prismatic) error = attempt(j, axis_turn(j), error);
    }
    return error;
  }

  // The turn about the joint's axis that brings the aim nearest, as a rotation vector in the joint's own frame. Of a
  // ball it is the twist, which is still free where the swing is at its limit.
  Vec3 axis_turn(int j) const {
    const auto [facing, wanted] = lines();
    const double turn_rad = angle_towards(world_[static_cast<std::size_t>(j)].q * joint(j).axis, facing, wanted);
    const double most_rad = kTurnPerError * angle_between(facing, wanted);
    return std::clamp(turn_rad, -most_rad, most_rad) * joint(j).axis;
  }

  Vec3 ball_turn(int j) const {
    const auto [facing, wanted] = lines();
    return glm::conjugate(world_[static_cast<std::size_t>(j)].q) * to_rotation_vector(shortest_arc(facing, wanted));
  }

  // Turns the joint, clamped; a turn that does not lessen the error is halved, and in the end taken back. A point that
  // is nearer than the chain is long needs this: there a full turn moves the aim point past the target.
  double attempt(int j, const Vec3& turn, double error) {
    const Joint& moved = joint(j);
    const auto size = static_cast<std::size_t>(coord_size(moved.kind));
    double* q = coords(moved);
    std::array<double, 4> before{};
    std::copy(q, q + size, before.begin());
    for (int halving = 0; halving <= kHalvings; ++halving) {
      set_turned(moved, before, turn * (1.0 / (1 << halving)), q);
      if (std::equal(q, q + size, before.begin())) return error;
      place(j);
      const double now = error_rad();
      if (now < error) return now;
    }
    std::copy(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(size), q);
    place(j);
    return error;
  }

  static void set_turned(const Joint& joint, const std::array<double, 4>& before, const Vec3& turn, double* q) {
    if (joint.kind == JointKind::ball) {
      const Quat turned = glm::normalize(Quat(before[0], before[1], before[2], before[3]) * from_rotation_vector(turn));
      q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
    } else {
      q[0] = before[0] + glm::dot(turn, joint.axis);
    }
    clamp_to_range(joint, q);
  }

  const Character& character_;
  const AimChain& chain_;
  const AimTarget& target_;
  std::span<Rigid> world_;
  std::span<double> row_;
  int end_ = 0;
};

// Copies the chain's coordinates, without travels, between a pose row and a posture of the table.
template <class From, class To>
void copy_posture(const Character& character, const AimChain& chain, const From& from, const To& to) {
  std::size_t local = 0;
  for (const int j : chain.joints) {
    const Joint& joint = character.joints()[static_cast<std::size_t>(j)];
    const auto size = static_cast<std::size_t>(coord_size(joint.kind));
    for (std::size_t i = 0; i < size && joint.kind != JointKind::prismatic; ++i)
      to(local + i, static_cast<std::size_t>(joint.coord) + i, from);
    local += size;
  }
}

void take_posture(const Character& character, const AimChain& chain, std::span<const double> posture,
                  std::span<double> row) {
  copy_posture(character, chain, posture,
               [row](std::size_t local, std::size_t coord, std::span<const double> from) { row[coord] = from[local]; });
}

void keep_posture(const Character& character, const AimChain& chain, std::span<const double> row,
                  std::span<double> posture) {
  copy_posture(character, chain, row, [posture](std::size_t local, std::size_t coord, std::span<const double> from) {
    posture[local] = from[coord];
  });
}

// The direction at which the table is to be looked up, in the frame of the chain's base. The aim point depends on the
// posture, which depends on the direction: two rounds settle it for targets that are not within the chain's own length.
Vec3 direction_in_base(const AimTable& table, const Rigid& world_from_base, const AimTarget& target) {
  const Rigid base_from_world = inverse(world_from_base);
  const Vec3 forward(0, 0, 1);
  if (target.kind == AimTarget::Kind::direction) return unit_or(base_from_world.q * target.world, forward);
  const Vec3 target_m = base_from_world * target.world;
  Vec3 direction = unit_or(target_m - table.geometry().joints.front().parent_from_joint.p_m, forward);
  for (int round = 0; round < 2; ++round) {
    std::array<AimHit, 1> best;
    table.nearest(direction, best);
    direction = unit_or(target_m - table.point_m(best[0].posture), direction);
  }
  return direction;
}

// Starts from one posture after another until one gets to the target; keeps the best.
class Trials {
 public:
  Trials(const Character& character, const AimChain& chain, std::span<Rigid> world, const AimTarget& target,
         std::span<double> row)
      : character_(character), chain_(chain), row_(row), aimer_(character, chain, world, target, row) {}

  bool reached() const { return result_.reached; }

  void start_from(std::span<const double> posture) {
    if (result_.reached) return;
    take_posture(character_, chain_, posture, row_);
    aimer_.clamp_all();
    const AimResult now = aimer_.solve();
    result_.iterations += now.iterations;
    if (now.error_rad >= result_.error_rad) return;
    result_.error_rad = now.error_rad;
    result_.reached = now.reached;
    keep_posture(character_, chain_, row_, best_);
  }

  void start_from(const AimTable& table, std::span<const AimHit> hits) {
    for (const AimHit& hit : hits) start_from(table.coords(hit.posture));
  }

  AimResult finish() {
    take_posture(character_, chain_, best_, row_);
    aimer_.place(chain_.joints.front());
    return result_;
  }

 private:
  const Character& character_;
  const AimChain& chain_;
  std::span<double> row_;
  Aimer aimer_;
  AimResult result_{2.0 * kPi, 0, false};
  std::array<double, kMaxAimCoords> best_{};
};

}  // namespace

AimResult continue_aim(const Character& character, const AimChain& chain, std::span<Rigid> world,
                       const AimTarget& target, std::span<double> row) {
  Aimer aimer(character, chain, world, target, row);
  aimer.clamp_all();
  return aimer.solve();
}

AimResult aim(const Character& character, const AimChain& chain, const AimTable& table, std::span<Rigid> world,
              const AimTarget& target, std::span<double> row) {
  Trials trials(character, chain, world, target, row);
  const Joint& first = character.joints()[static_cast<std::size_t>(chain.joints.front())];
  const Rigid& world_from_base = world[static_cast<std::size_t>(first.parent)];
  const Vec3 direction = direction_in_base(table, world_from_base, target);
  std::array<double, kMaxAimCoords> start{};  // at first where the chain is
  keep_posture(character, chain, row, start);
  std::array<AimHit, kCandidates> hits;
  const std::span<AimHit> near = std::span(hits).first(static_cast<std::size_t>(table.nearest(direction, hits)));
  table.prefer(start, near);
  table.interpolated(direction, near, start);
  trials.start_from(start);
  trials.start_from(table, near);
  if (target.kind == AimTarget::Kind::point && !trials.reached()) {
    const int found = table.nearest_to_point(inverse(world_from_base) * target.world, hits);
    trials.start_from(table, std::span(hits).first(static_cast<std::size_t>(found)));
  }
  return trials.finish();
}

}  // namespace contort
