// angular_acceleration: how fast a joint's speed changes between two neighbouring steps. Files declare no limit for it,
// so it follows from the greatest speed: no joint should take less than 20 ms from rest to there. A blow changes speeds
// at once, and a step that is too fast has a finding of its own; both are passed over.
#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "checks/fixed_limits.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

bool is_struck(const Motion& motion, int frame) {
  return std::ranges::any_of(motion.response.impacts,
                             [&](const ImpactMark& m) { return frame >= m.frame && frame <= m.frame + 2; });
}

// rad/s^2 or m/s^2 about the frame before; negative where a step is too fast, or no number.
double change_of_speed(const Motion& motion, const Joint& joint, int frame) {
  const double* now = motion.row(frame).data();
  const double* middle = motion.row(frame - 1).data();
  const Vec3 first = joint_step_vector(joint, motion.row(frame - 2).data(), middle) * motion.rate_hz;
  const Vec3 second = joint_step_vector(joint, middle, now) * motion.rate_hz;
  const double fastest = std::max(glm::dot(first, first), glm::dot(second, second));
  if (!(fastest <= joint.max_speed * joint.max_speed)) return -1.0;
  const Vec3 change = (second - first) * motion.rate_hz;
  return std::sqrt(glm::dot(change, change));
}

}  // namespace

int angular_acceleration_subject_count(const Character& character) { return moving_joint_count(character); }

Subject angular_acceleration_subject(const Character& character, int subject) {
  return moving_joint(character, subject, "rad/s^2", "m/s^2");
}

void angular_acceleration_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (int frame = 2; frame < in.motion.frame_count; ++frame) {
    if (is_struck(in.motion, frame) || in.may_jump_into(frame) || in.may_jump_into(frame - 1)) continue;
    for (std::size_t j = 1; j < joints.size(); ++j)
      if (const double change = change_of_speed(in.motion, joints[j], frame); change >= 0.0)
        fold.report(static_cast<int>(j) - 1, frame, joints[j].max_speed / kShortestRise_s - change);
  }
}

}  // namespace contort
