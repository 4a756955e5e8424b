// angular_acceleration: how fast a joint's speed changes between two neighbouring steps. Files declare no limit for it.
// The limit follows from the greatest speed: no joint should reach it from rest in less than 20 ms. Two kinds of frames
// are not judged: those after a blow, which changes speeds at once, and steps that are too fast, which have a finding
// of their own.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "checks/check.h"
#include "checks/fixed_limits.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

bool is_struck(const Motion& motion, int frame) {
  return std::ranges::any_of(motion.response.impacts,
                             [&](const ImpactMark& m) { return frame >= m.frame && frame <= m.frame + 2; });
}

// Returns 1 / (the time between the middles of the steps before and after a frame).
double rate_around_hz(const Motion& motion, int frame) {
  return motion.times_s.empty() ? motion.rate_hz : 2.0 / (motion.time_s(frame + 1) - motion.time_s(frame - 1));
}

// The acceleration between two steps, given as speeds, in rad/s^2 or m/s^2; negative if a step is too fast or NaN.
double change_of_speed(const Joint& joint, const Vec3& first, const Vec3& second, double rate_hz) {
  const double fastest = std::max(glm::dot(first, first), glm::dot(second, second));
  if (!(fastest <= joint.max_speed * joint.max_speed)) return -1.0;
  const Vec3 change = (second - first) * rate_hz;
  return std::sqrt(glm::dot(change, change));
}

}  // namespace

int angular_acceleration_subject_count(const Character& character) { return moving_joint_count(character); }

Subject angular_acceleration_subject(const Character& character, int subject) {
  return moving_joint(character, subject, "rad/s^2", "m/s^2");
}

void angular_acceleration_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  const Motion& motion = in.motion;
  std::vector<Vec3> speeds(joints.size());  // speed of each joint from the frame before
  for (int frame = 1; frame < motion.frame_count; ++frame) {
    const bool is_judged = frame > 1 && !is_struck(motion, frame) && !in.may_jump_into(frame) &&
                           !in.may_jump_into(frame - 1);
    const double* before = motion.row(frame - 1).data();
    const double* now = motion.row(frame).data();
    const double into_hz = motion.rate_into_hz(frame), around_hz = is_judged ? rate_around_hz(motion, frame - 1) : 0.0;
    for (std::size_t j = 1; j < joints.size(); ++j) {
      const Vec3 first = std::exchange(speeds[j], joint_step_vector(joints[j], before, now) * into_hz);
      if (!is_judged) continue;
      if (const double change = change_of_speed(joints[j], first, speeds[j], around_hz); change >= 0.0)
        fold.report(static_cast<int>(j) - 1, frame, joints[j].max_speed / kShortestRise_s - change);
    }
  }
}

}  // namespace contort
