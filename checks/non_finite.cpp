// non_finite: all values of a pose must be finite, and within 1,000 m and 1,000 rad of zero.
#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/check.h"

namespace contort {

namespace {

constexpr double kGreatest = 1000.0;

double margin_of(std::span<const double> values) {
  double least = kGreatest;
  for (const double value : values) {
    const double margin = kGreatest - std::fabs(value);
    if (!(margin >= least)) least = margin;  // also true for NaN
    if (std::isnan(least)) return least;     // NaN stays
  }
  return least;
}

}  // namespace

int non_finite_subject_count(const Character& character) { return static_cast<int>(character.joints().size()); }

Subject non_finite_subject(const Character& character, int subject) {
  const Joint& joint = character.joints()[static_cast<std::size_t>(subject)];
  return {joint.name, joint.kind == JointKind::hinge || joint.kind == JointKind::ball ? "rad" : "m"};
}

void non_finite_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (int frame = 0; frame < in.motion.frame_count; ++frame) {
    const Rigid& root = in.motion.root[static_cast<std::size_t>(frame)];
    const double placed[] = {root.p_m.x, root.p_m.y, root.p_m.z, root.q.w, root.q.x, root.q.y, root.q.z};
    fold.report(0, frame, margin_of(placed));
    const std::span<const double> row = in.motion.row(frame);
    for (std::size_t j = 1; j < joints.size(); ++j)
      fold.report(static_cast<int>(j), frame,
                  margin_of(row.subspan(static_cast<std::size_t>(joints[j].coord),
                                        static_cast<std::size_t>(coord_size(joints[j].kind)))));
  }
}

}  // namespace contort
