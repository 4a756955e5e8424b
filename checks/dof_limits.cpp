#include "checks/dof_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/check.h"

namespace contort {

namespace {

struct LimitedDof {
  std::size_t column = 0;  // in a row of the motion
  const AsfBone* bone = nullptr;
  AsfDof dof;
};

std::vector<LimitedDof> limited_dofs(const AsfSkeleton& skeleton) {
  std::vector<LimitedDof> out;
  std::size_t column = 0;
  for (const AsfBone& bone : skeleton.bones)
    for (const AsfDof& dof : bone.dofs) {
      const bool is_limited = std::isfinite(dof.low) || std::isfinite(dof.high);
      if (is_limited && bone.parent >= 0) out.push_back({column, &bone, dof});
      ++column;
    }
  return out;
}

// Two to each: its low and its high end.
std::string subject_name(const std::vector<LimitedDof>& dofs, int subject) {
  const LimitedDof& limited = dofs[static_cast<std::size_t>(subject) / 2];
  return limited.bone->name + " " + std::string(dof_name(limited.dof.kind)) + (subject % 2 == 0 ? " min" : " max");
}

void tolerate(const CheckSettings& settings, const std::vector<LimitedDof>& dofs, MarginFold& fold) {
  if (settings.limits.empty()) return;
  std::vector<double> tolerances;
  for (int s = 0; s < 2 * static_cast<int>(dofs.size()); ++s)
    tolerances.push_back(tolerance_of(settings, "joint_range", subject_name(dofs, s)));
  fold.tolerate(std::move(tolerances), {}, 1);
}

Finding to_finding(const MarginFold::Episode& e, const std::vector<LimitedDof>& dofs, double scale) {
  const LimitedDof& limited = dofs[static_cast<std::size_t>(e.subject) / 2];
  return {"joint_range",
          subject_name(dofs, e.subject),
          is_rotation(limited.dof.kind) ? "rad" : "file units",
          e.first,
          e.worst,
          e.last,
          e.worst_margin,
          -e.worst_margin / scale};
}

}  // namespace

std::vector<std::string> dof_subjects(const AsfSkeleton& skeleton) {
  const std::vector<LimitedDof> dofs = limited_dofs(skeleton);
  std::vector<std::string> names;
  for (int s = 0; s < 2 * static_cast<int>(dofs.size()); ++s) names.push_back(subject_name(dofs, s));
  return names;
}

DofLimits check_dof_limits(const AsfSkeleton& skeleton, const AmcMotion& motion, const CheckSettings& settings) {
  const std::vector<LimitedDof> dofs = limited_dofs(skeleton);
  MarginFold fold(2 * static_cast<int>(dofs.size()), settings.merge_gap_frames, kDofResolution_rad);
  tolerate(settings, dofs, fold);
  DofLimits out;
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      const double value = motion.row(frame)[dofs[i].column];
      const double above_low = value - dofs[i].dof.low;
      const double below_high = dofs[i].dof.high - value;
      fold.report(2 * static_cast<int>(i), motion.first_frame + frame, above_low);
      fold.report(2 * static_cast<int>(i) + 1, motion.first_frame + frame, below_high);
      ++out.samples;
      if (std::min(above_low, below_high) < -kDofResolution_rad) ++out.out_of_range;
    }
  }
  const double scale = find_check("joint_range").scale;
  for (const MarginFold::Episode& e : fold.episodes()) out.findings.push_back(to_finding(e, dofs, scale));
  out.least_margin = std::numeric_limits<double>::infinity();
  for (const double margin : fold.smallest()) out.least_margin = std::min(out.least_margin, margin);
  out.worst_depth = -out.least_margin / scale;
  out.subjects = fold.judged_subjects();
  return out;
}

}  // namespace contort
