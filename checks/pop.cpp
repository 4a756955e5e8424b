#include "checks/pop.h"

#include <algorithm>
#include <array>
#include <limits>

#include "checks/check.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

// The faster neighbour of the window [first, last]; infinite if the window cannot be a pop.
double neighbours_rad_s(std::span<const SpeedInterval> v, std::size_t first, std::size_t last) {
  const bool has_before = first > 0;
  const bool has_after = last + 1 < v.size();
  if (last >= v.size() || (!has_before && !has_after)) return kNothing;
  if (v[last].t1_s - v[first].t0_s > kPopLongest_s) return kNothing;
  return std::max(has_before ? v[first - 1].speed_rad_s : 0.0, has_after ? v[last + 1].speed_rad_s : 0.0);
}

}  // namespace

double explained_rad_s(std::span<const SpeedInterval> between_keys, std::size_t i) {
  double calmest = std::min(neighbours_rad_s(between_keys, i, i), neighbours_rad_s(between_keys, i, i + 1));
  if (i > 0) calmest = std::min(calmest, neighbours_rad_s(between_keys, i - 1, i));
  return kPopFactor * calmest;
}

double speed_into(const Motion& motion, const Joint& joint, int frame) {
  return joint_step(joint, motion.row(frame - 1).data(), motion.row(frame).data()) * motion.rate_into_hz(frame);
}

// Only two steps on either side matter.
double explained_speed(const Motion& motion, const Joint& joint, int frame) {
  const int first = std::max(1, frame - 2), last = std::min(motion.frame_count - 1, frame + 2);
  std::array<SpeedInterval, 5> around;
  for (int f = first; f <= last; ++f)
    around[static_cast<std::size_t>(f - first)] = {motion.time_s(f - 1), motion.time_s(f),
                                                   speed_into(motion, joint, f)};
  return explained_rad_s(std::span(around).first(static_cast<std::size_t>(last - first + 1)),
                         static_cast<std::size_t>(frame - first));
}

int pop_subject_count(const Character& character) { return moving_joint_count(character); }

Subject pop_subject(const Character& character, int subject) {
  return moving_joint(character, subject, "rad/s", "m/s");
}

void pop_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (int frame = 1; frame < in.motion.frame_count; ++frame)
    for (std::size_t j = 1; j < joints.size() && !in.may_jump_into(frame); ++j) {
      const double speed = speed_into(in.motion, joints[j], frame);
      double limit = joints[j].max_speed;
      if (speed > limit) limit = std::max(limit, explained_speed(in.motion, joints[j], frame));
      if (speed == speed) fold.report(static_cast<int>(j) - 1, frame, limit - speed);  // angular_velocity reports NaN
    }
}

}  // namespace contort
