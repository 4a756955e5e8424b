#include "generator/dynamics/re_aim.h"

#include <algorithm>

#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kSweeps = 6;
constexpr double kMost_rad = 4.0 * kRadPerDeg;  // of a hinge
constexpr double kOn_rad = 1e-5;
constexpr double kFades_s = 0.25;

// The hinges between a socket and the carrier of its part, from the socket on. Empty if one of them carries a leg.
std::vector<int> hinges_of(const Character& character, std::span<const Leg> legs, const Socket& socket) {
  std::vector<int> hinges;
  const int part = character.joint(socket.joint).part;
  for (int j = socket.joint; j > 0 && character.joint(j).part == part; j = character.joint(j).parent) {
    if (character.joint(j).kind == JointKind::hinge) hinges.push_back(j);
    for (const Leg& leg : legs)
      for (int k = leg.joints.front(); k > 0; k = character.joint(k).parent)
        if (k == j) return {};
  }
  return hinges;
}

// One aim of a motion.
class Aim {
 public:
  Aim(const Character& character, std::span<const Leg> legs, const AimSpan& span, Motion& motion)
      : character_(character),
        socket_(character.sockets()[at(span.socket)]),
        hinges_(hinges_of(character, legs, socket_)),
        span_(span),
        motion_(motion),
        world_(character.joints().size()) {}

  void correct() {
    if (hinges_.empty()) return;
    for (int f = span_.first_frame; f <= span_.last_frame; ++f) {
      given_.assign(motion_.row(f).begin(), motion_.row(f).end());
      turn_to_target(f);
      if (f == span_.first_frame) fade(f, -1);
    }
    fade(span_.last_frame, 1);
  }

 private:
  // One hinge after the other turns the point as near to the target as it can.
  void turn_to_target(int frame) {
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (const int j : hinges_) {
        forward_kinematics(character_, motion_.root[at(frame)], motion_.row(frame), world_);
        const Rigid now = world_[at(socket_.joint)] * socket_.joint_from_socket;
        const Vec3 ahead = now.q * Vec3(0, 0, 1), way = unit_or(span_.target_m - now.p_m, ahead);
        if (rotation_angle(shortest_arc(ahead, way)) < kOn_rad) return;
        const Joint& joint = character_.joint(j);
        const Vec3 axis = world_[at(joint.parent)].q * (joint.parent_from_joint.q * joint.axis);
        double& angle = motion_.row(frame)[at(joint.coord)];
        const double given = given_[at(joint.coord)];
        angle = std::clamp(angle + angle_towards(axis, ahead, way), given - kMost_rad, given + kMost_rad);
        clamp_to_range(joint, &angle);
      }
  }

  // Carries the turns of a frame on to the frames beside it.
  void fade(int frame, int step) {
    const int reach = std::max(1, static_cast<int>(kFades_s * motion_.rate_hz));
    for (int k = 1; k <= reach; ++k) {
      const int f = frame + step * k;
      if (f < 0 || f >= motion_.frame_count) return;
      const double share = 1.0 - minimum_jerk(static_cast<double>(k) / (reach + 1));
      for (const int j : hinges_) {
        const std::size_t c = at(character_.joint(j).coord);
        motion_.row(f)[c] += share * (motion_.row(frame)[c] - given_[c]);
        clamp_to_range(character_.joint(j), &motion_.row(f)[c]);
      }
    }
  }

  const Character& character_;
  const Socket& socket_;
  const std::vector<int> hinges_;
  const AimSpan& span_;
  Motion& motion_;
  std::vector<Rigid> world_;
  std::vector<double> given_;  // the row of the frame that was corrected last
};

}  // namespace

void re_aim(const Character& character, std::span<const Leg> legs, Motion& motion) {
  const std::vector<AimSpan> aims = motion.aims;
  for (const AimSpan& span : aims) Aim(character, legs, span, motion).correct();
}

}  // namespace contort
