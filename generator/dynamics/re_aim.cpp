#include "generator/dynamics/re_aim.h"

#include <algorithm>
#include <array>

#include "generator/dynamics/joint_ends.h"
#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kSweeps = 6;
constexpr int kAimPasses = 4;  // a frame's turn moves where the figure comes to in the frames beside it
constexpr double kMost_rad = 4.0 * kRadPerDeg;  // of a joint
constexpr double kOn_rad = 1e-5;
constexpr double kFades_s = 0.25;

bool can_turn(const Joint& joint) { return joint.kind == JointKind::hinge || joint.kind == JointKind::ball; }

void put_ball(const Quat& q, double* coords) {
  coords[0] = q.w, coords[1] = q.x, coords[2] = q.y, coords[3] = q.z;
}

// The turn from one posture of a hinge or ball to another, along the axes of what it moves; x of a hinge.
Vec3 turn_between(const Joint& joint, const double* from, const double* to) {
  if (joint.kind == JointKind::hinge) return {*to - *from, 0.0, 0.0};
  return to_rotation_vector(glm::conjugate(quat_at(from)) * quat_at(to));
}

void turn_by(const Joint& joint, const Vec3& turn, double* coords) {
  if (joint.kind == JointKind::hinge)
    *coords += turn.x;
  else
    put_ball(glm::normalize(quat_at(coords) * from_rotation_vector(turn)), coords);
}

// The joints that turn between a socket and the carrier of its part, from the socket on. Empty if one carries a leg.
std::vector<int> turning_joints(const Character& character, std::span<const Leg> legs, const Socket& socket) {
  std::vector<int> joints;
  const int part = character.joint(socket.joint).part;
  for (int j = socket.joint; j > 0 && character.joint(j).part == part; j = character.joint(j).parent) {
    if (can_turn(character.joint(j))) joints.push_back(j);
    for (const Leg& leg : legs)
      for (int k = leg.joints.front(); k > 0; k = character.joint(k).parent)
        if (k == j) return {};
  }
  return joints;
}

// One aim of a motion.
class Aim {
 public:
  Aim(const Character& character, std::span<const Leg> legs, const AimSpan& span, double missed, Motion& motion)
      : character_(character),
        missed_(missed),
        socket_(character.sockets()[at(span.socket)]),
        joints_(turning_joints(character, legs, socket_)),
        span_(span),
        motion_(motion),
        world_(character.joints().size()) {}

  void correct() {
    std::erase_if(joints_, [&](int j) { return comes_to_end(character_.joint(j)); });
    if (joints_.empty()) return;
    for (int pass = 0; pass < (missed_ > 0.0 ? kAimPasses : 1); ++pass) correct_once();
  }

 private:
  void correct_once() {
    for (int f = span_.first_frame; f <= span_.last_frame; ++f) {
      given_.assign(motion_.row(f).begin(), motion_.row(f).end());
      turn_to_target(f);
      if (f == span_.first_frame) fade(f, -1);
    }
    fade(span_.last_frame, 1);
  }

  // A ball near the end of its range stays as it is: a figure slows down before the end, and would come behind.
  bool comes_to_end(const Joint& joint) {
    if (joint.kind != JointKind::ball) return false;
    for (int f = span_.first_frame; f <= span_.last_frame; ++f)
      if (near_ends(joint, coords(f, joint), kMost_rad).count > 0) return true;
    return false;
  }

  double* coords(int frame, const Joint& joint) { return &motion_.row(frame)[at(joint.coord)]; }

  // Sets followed_ to the pose that a tracked figure reaches: it misses a part of each second difference (tracker.h).
  void follow(int frame) {
    followed_.assign(motion_.row(frame).begin(), motion_.row(frame).end());
    if (missed_ <= 0.0 || frame == 0 || frame == motion_.frame_count - 1) return;
    for (const Joint& joint : character_.joints()) {
      if (!can_turn(joint)) continue;
      const double* now = coords(frame, joint);
      const Vec3 bend =
          turn_between(joint, now, coords(frame + 1, joint)) + turn_between(joint, now, coords(frame - 1, joint));
      turn_by(joint, missed_ * bend, &followed_[at(joint.coord)]);
    }
  }

  // One joint after the other turns the point as near to the target as it can. A joint far from the point moves it
  // beside a near target, and keeps only a turn that helps.
  void turn_to_target(int frame) {
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (const int j : joints_) {
        const Pointing now = pointing(frame);
        if (now.off_rad() < kOn_rad) return;
        const Joint& joint = character_.joint(j);
        double* own = coords(frame, joint);
        std::array<double, 4> before{};
        std::copy_n(own, coord_size(joint.kind), before.begin());
        turn_by(joint, turn_towards(j, now), own);
        keep_near_given(joint, own);
        if (pointing(frame).off_rad() >= now.off_rad()) std::copy_n(before.begin(), coord_size(joint.kind), own);
      }
  }

  struct Pointing {
    Vec3 ahead, way;
    double off_rad() const { return rotation_angle(shortest_arc(ahead, way)); }
  };
  Pointing pointing(int frame) {
    follow(frame);
    forward_kinematics(character_, motion_.root[at(frame)], followed_, world_);
    const Rigid now = world_[at(socket_.joint)] * socket_.joint_from_socket;
    const Vec3 ahead = now.q * Vec3(0, 0, 1);
    return {ahead, unit_or(span_.target_m - now.p_m, ahead)};
  }

  void keep_near_given(const Joint& joint, double* own) const {
    const double* given = &given_[at(joint.coord)];
    const Vec3 turn = turn_between(joint, given, own);
    if (const double size = length(turn); size > kMost_rad) {
      std::copy_n(given, coord_size(joint.kind), own);
      turn_by(joint, (kMost_rad / size) * turn, own);
    }
    clamp_to_range(joint, own);
  }

  Vec3 turn_towards(int j, const Pointing& now) const {
    const Joint& joint = character_.joint(j);
    if (joint.kind == JointKind::ball)
      return glm::conjugate(world_[at(j)].q) * to_rotation_vector(shortest_arc(now.ahead, now.way));
    const Vec3 axis = world_[at(joint.parent)].q * (joint.parent_from_joint.q * joint.axis);
    return {angle_towards(axis, now.ahead, now.way), 0.0, 0.0};
  }

  // Carries the turns of a frame on to the frames beside it.
  void fade(int frame, int step) {
    const int reach = std::max(1, static_cast<int>(kFades_s * motion_.rate_hz));
    for (int k = 1; k <= reach; ++k) {
      const int f = frame + step * k;
      if (f < 0 || f >= motion_.frame_count) return;
      const double share = 1.0 - minimum_jerk(static_cast<double>(k) / (reach + 1));
      for (const int j : joints_) {
        const Joint& joint = character_.joint(j);
        turn_by(joint, share * turn_between(joint, &given_[at(joint.coord)], coords(frame, joint)), coords(f, joint));
        clamp_to_range(joint, coords(f, joint));
      }
    }
  }

  const Character& character_;
  const double missed_;
  const Socket& socket_;
  std::vector<int> joints_;
  const AimSpan& span_;
  Motion& motion_;
  std::vector<Rigid> world_;
  std::vector<double> followed_;
  std::vector<double> given_;  // the row of the frame that was corrected last
};

}  // namespace

void re_aim(const Character& character, std::span<const Leg> legs, double missed, Motion& motion) {
  const std::vector<AimSpan> aims = motion.aims;
  for (const AimSpan& span : aims) Aim(character, legs, span, missed, motion).correct();
}

}  // namespace contort
