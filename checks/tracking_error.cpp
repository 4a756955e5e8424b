// tracking_error: after an impact each joint must return to its target in time. It is judged while the figure stands
// and dynamic control does nothing, because a reaction to loads or lost balance is no error. Nothing is judged after a
// blow that is harder than the figure withstands.
#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "checks/fixed_limits.h"
#include "checks/withstands.h"

namespace contort {

namespace {

constexpr double kReturn_s = 0.7;  // people recover from a push within a step

double error_of(const Joint& joint, const double* now, const double* goal) {
  if (joint.kind != JointKind::ball) return std::fabs(now[0] - goal[0]);
  return rotation_angle(glm::conjugate(Quat(goal[0], goal[1], goal[2], goal[3])) *
                        Quat(now[0], now[1], now[2], now[3]));
}

bool is_left_alone(const Response& response, int frame) {
  const auto n = static_cast<std::size_t>(response.dof_count), f = static_cast<std::size_t>(frame);
  const auto row = response.control.begin() + static_cast<std::ptrdiff_t>(f * n);
  return response.stances[f].footing == Footing::standing &&
         std::all_of(row, row + static_cast<std::ptrdiff_t>(n), [](double added) { return added == 0.0; });
}

// Judges the frames from which on all joints must be back, until the next impact.
void judge(const CheckInput& in, int first, int last, MarginFold& fold) {
  for (int frame = first; frame <= last; ++frame) {
    if (!is_left_alone(in.motion.response, frame)) continue;
    const std::size_t row = static_cast<std::size_t>(frame) * static_cast<std::size_t>(in.motion.coord_count);
    for (std::size_t j = 1; j < in.character.joints().size(); ++j) {
      const Joint& joint = in.character.joints()[j];
      const std::size_t at = row + static_cast<std::size_t>(joint.coord);
      const double limit = joint.kind == JointKind::prismatic ? kBack_m : kBack_rad;
      fold.report(static_cast<int>(j) - 1, frame,
                  limit - error_of(joint, &in.motion.coords[at], &in.motion.response.target_coords[at]));
    }
  }
}

}  // namespace

int tracking_error_subject_count(const Character& character) { return static_cast<int>(character.joints().size()) - 1; }

Subject tracking_error_subject(const Character& character, int subject) {
  const Joint& joint = character.joints()[static_cast<std::size_t>(subject) + 1];
  return {joint.name, joint.kind == JointKind::prismatic ? "m" : "rad"};
}

void tracking_error_measure(const CheckInput& in, MarginFold& fold) {
  const std::vector<ImpactMark>& impacts = in.motion.response.impacts;
  const int in_time = static_cast<int>(std::ceil(kReturn_s * in.motion.rate_hz));
  const int overpowered = first_overpowered_frame(in.character, in.motion);
  for (std::size_t i = 0; i < impacts.size() && impacts[i].frame < overpowered; ++i) {
    const int end = i + 1 < impacts.size() ? impacts[i + 1].frame : in.motion.frame_count;
    judge(in, impacts[i].frame + in_time, end - 1, fold);
  }
}

}  // namespace contort
