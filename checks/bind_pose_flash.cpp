// bind_pose_flash: one or two frames of the rest pose in the middle of a motion, which comes from elsewhere and goes
// back there: a layer that wrote nothing, a pose that was not set. Only a motion that is away from rest before and
// after, and about as it was before, is judged, so that a limb may swing through its rest pose.
#include <algorithm>
#include <array>

#include "checks/check.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

constexpr double kAtRest_rad = 1.0 * kRadPerDeg;
constexpr double kAway_rad = 10.0 * kRadPerDeg;
constexpr int kLongest = 2;  // frames

// The difference of two poses by the joint that differs most; stops where that is more than `enough`.
double difference_rad(const Character& character, const double* a, const double* b, double enough) {
  double most = 0.0;
  for (const Joint& joint : character.joints().subspan(1)) {
    most = std::max(most, likeness_rad(joint, a, b));
    if (most > enough) break;
  }
  return most;
}

struct Flash {
  const CheckInput& in;
  const double* rest = in.character.rest_coords().data();

  double from_rest_rad(int frame, double enough) const {
    return difference_rad(in.character, in.motion.row(frame).data(), rest, enough);
  }
  bool is_at_rest(int frame) const { return from_rest_rad(frame, kAtRest_rad) <= kAtRest_rad; }

  // Frames [first, last] are at rest; both neighbours exist.
  double margin_rad(int first, int last) const {
    const double* before = in.motion.row(first - 1).data();
    const double* after = in.motion.row(last + 1).data();
    const double away = std::min(from_rest_rad(first - 1, 1e9), from_rest_rad(last + 1, 1e9));
    if (difference_rad(in.character, before, after, away) > 0.5 * away) return kAway_rad;  // swings through
    return kAway_rad - away;
  }
};

}  // namespace

int bind_pose_flash_subject_count(const Character&) { return 1; }

Subject bind_pose_flash_subject(const Character&, int) { return {"figure", "rad"}; }

void bind_pose_flash_measure(const CheckInput& in, MarginFold& fold) {
  const Flash flash{in};
  if (in.motion.frame_count >= 3) fold.judged_all();
  for (int first = 1; first + 1 < in.motion.frame_count; ++first) {
    if (!flash.is_at_rest(first)) continue;
    int last = first;
    while (last + 1 < in.motion.frame_count && flash.is_at_rest(last + 1)) ++last;
    const bool is_meant = in.may_jump_into(first) || in.may_jump_into(last + 1);
    const bool is_short = !is_meant && last - first < kLongest && last + 1 < in.motion.frame_count &&
                          !flash.is_at_rest(first - 1);
    if (is_short)
      for (int frame = first; frame <= last; ++frame) fold.report(0, frame, flash.margin_rad(first, last));
    first = last;
  }
}

}  // namespace contort
