#include "checks/dof_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/check.h"

namespace contort {

namespace {

struct LimitedDof {
  std::size_t column = 0;  // column of a row of the motion
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

// Each degree of freedom has two subjects: its low and its high end.
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

// Returns true if an end is the declared one as an import writes it: clamped to +-360 degrees, and relative to the rest
// pose.
bool is_declared_end(double end_rad, double declared_rad, double at_rest_rad) {
  constexpr double kRounding_rad = 1e-6;
  const double written_rad = std::clamp(declared_rad, -2.0 * kPi, 2.0 * kPi);
  return std::fabs(end_rad + at_rest_rad - written_rad) < kRounding_rad;
}

bool has_declared_travel(const Joint& joint, const AsfDof& dof, double at_rest_m) {
  constexpr double kRounding = 1e-6;  // as a fraction of the range
  const double metres = (joint.high - joint.low) / (dof.high - dof.low);
  const double off = (joint.low + at_rest_m - dof.low * metres) / (joint.high - joint.low);
  return joint.kind == JointKind::prismatic && metres > 0.0 && std::fabs(off) < kRounding;
}

}  // namespace

std::set<std::string> subjects_with_declared_range(const AsfSkeleton& skeleton, const Character& character,
                                                   const FileJoints& joints) {
  std::set<std::string> out;
  for (const LimitedDof& limited : limited_dofs(skeleton)) {
    const AsfDof& dof = limited.dof;
    const auto found = joints.find(limited.bone->name + "_" + std::string(dof_name(dof.kind)));
    const int index = found == joints.end() ? -1 : character.find_joint(found->second.joint);
    if (index < 0) continue;
    const Joint& joint = character.joint(index);
    const double at_rest = found->second.at_rest;
    const bool turns = is_rotation(dof.kind) && joint.kind == JointKind::hinge;
    const bool travels = !is_rotation(dof.kind) && has_declared_travel(joint, dof, at_rest);
    if (travels || (turns && is_declared_end(joint.low, dof.low, at_rest))) out.insert(joint.name + " min");
    if (travels || (turns && is_declared_end(joint.high, dof.high, at_rest))) out.insert(joint.name + " max");
  }
  return out;
}

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
