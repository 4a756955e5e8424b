// off_axis: a hinge must turn about its axis only. The coordinate of a hinge cannot hold other rotations, so the host
// of the generator stores their angle separately.
#include "checks/check.h"

namespace contort {

namespace {

constexpr double kOffAxisLimit_rad = 1.0 * kRadPerDeg;

}  // namespace

int off_axis_subject_count(const Character& character) { return static_cast<int>(character.joints().size()); }

Subject off_axis_subject(const Character& character, int subject) {
  return {character.joints()[static_cast<std::size_t>(subject)].name, "rad"};
}

void off_axis_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  const std::vector<double>& off = in.foreign->off_axis_rad;
  for (std::size_t i = 0; i < off.size(); ++i)
    if (const std::size_t j = i % joints.size(); joints[j].kind == JointKind::hinge)
      fold.report(static_cast<int>(j), static_cast<int>(i / joints.size()), kOffAxisLimit_rad - off[i]);
}

}  // namespace contort
