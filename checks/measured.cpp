#include "checks/measured.h"

#include <algorithm>
#include <cmath>

#include "checks/fixed_limits.h"

namespace contort {

namespace {

// The limit of a subject, from which a margin gives the value.
struct LimitOfSubject {
  double limit = 0.0;
  bool is_lower = false;  // the value must stay above it
};

const Joint* joint_named(const Character& character, std::string_view name) {
  const auto joints = character.joints();
  const auto found = std::ranges::find(joints, name, &Joint::name);
  return found == joints.end() ? nullptr : &*found;
}

// "arm_left/elbow max": an end of the range of one coordinate. The swing of a ball joint has no single limit.
std::optional<LimitOfSubject> limit_of_range(const Character& character, std::string_view subject) {
  const std::size_t space = subject.find(' ');
  if (space == std::string_view::npos) return {};
  const Joint* joint = joint_named(character, subject.substr(0, space));
  if (joint == nullptr) return {};
  const std::string_view side = subject.substr(space + 1);
  if (side == "min" || side == "twist min") return LimitOfSubject{joint->low, true};
  if (side == "max" || side == "twist max") return LimitOfSubject{joint->high};
  return {};
}

// Efforts are fractions of the joint's strength; a joint without strength has none.
std::optional<LimitOfSubject> limit_of_effort(const Joint& joint) {
  if (joint.strength_low == 0.0 || joint.strength_high == 0.0) return {};
  return LimitOfSubject{1.0};
}

std::optional<LimitOfSubject> limit_of_joint(const Character& character, std::string_view check,
                                             std::string_view subject) {
  const Joint* joint = joint_named(character, subject);
  if (joint == nullptr) return {};
  if (check == "angular_velocity") return LimitOfSubject{joint->max_speed};
  if (check == "angular_acceleration") return LimitOfSubject{joint->max_speed / kShortestRise_s};
  if (check == "joint_torque") return limit_of_effort(*joint);
  return LimitOfSubject{joint->kind == JointKind::prismatic ? kBack_m : kBack_rad};  // tracking_error
}

std::optional<LimitOfSubject> limit_of(const Character& character, std::string_view check, std::string_view subject) {
  static constexpr std::pair<std::string_view, double> kFixed[] = {
      {"ground_penetration", kSink_m}, {"obstacle_penetration", kPress_m}, {"foot_slide", kSlide_m},
      {"reach_error", kReachLimit_m},  {"aim_error", kAimLimit_rad},       {"residue", kLeft_rad},
      {"self_collision", 0.0}};
  for (const auto& [name, limit] : kFixed)
    if (name == check) return LimitOfSubject{limit};
  if (check == "joint_range") return limit_of_range(character, subject);
  for (const std::string_view of_joints : {"angular_velocity", "angular_acceleration", "joint_torque", "tracking_error"})
    if (check == of_joints) return limit_of_joint(character, check, subject);
  return {};
}

}  // namespace

std::optional<Measured> measured_of(const Character& character, const CheckSettings& settings, std::string_view check,
                                    std::string_view subject, double margin) {
  const bool has_phases = std::ranges::any_of(
      settings.limits, [&](const LimitRule& rule) { return rule.check == check && !rule.phase.empty(); });
  const std::optional<LimitOfSubject> found = limit_of(character, check, subject);
  if (!found || has_phases || !std::isfinite(margin)) return {};
  const double tolerance = tolerance_of(settings, check, subject);
  if (!std::isfinite(tolerance)) return {};
  const double limit = found->is_lower ? found->limit - tolerance : found->limit + tolerance;
  return Measured{found->is_lower ? limit + margin : limit - margin, limit};
}

}  // namespace contort
