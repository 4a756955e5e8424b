// pose: forward kinematics. One parameter for each joint of the part; joints without a value stay as they are.
#include <cmath>

#include "generator/actions/action.h"

namespace contort {

namespace {

// Ranges reach beyond the joint's own on purpose: an author can ask for too much, and the check shall say so.
ParamDef optional_param(const std::string& name, double most, const char* help) {
  ParamDef def;
  def.name = name;
  def.low = -most, def.high = most;
  def.optional = true;
  def.domain = Domain::joint_range;
  def.help = help;
  return def;
}

ParamDef param_of(const Joint& joint) {
  if (joint.kind == JointKind::prismatic) return optional_param(joint.local_name + "_m", 10.0, "Travel, m.");
  const std::string name = joint.local_name + "_deg";
  if (joint.kind != JointKind::ball) return optional_param(name, 360.0, "Angle relative to rest, degrees.");
  ParamDef def = optional_param(name, 360.0, "Rotation vector relative to rest, degrees.");
  def.type = ParamType::vector;
  def.preset = Vec3(0.0);
  def.mirrored = Mirrored::rotation;
  return def;
}

}  // namespace

std::vector<ParamDef> pose_params(const Character& character, const Part& part) {
  std::vector<ParamDef> defs;
  for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j)
    defs.push_back(param_of(character.joints()[static_cast<std::size_t>(j)]));
  return defs;
}

bool pose_supports(const Character&, const Part& part) { return part.joint_count > 0; }

void pose_rule(const RuleInput& in, Posture& posture) {
  const double* p = in.params.data();
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j) {
    const Joint& joint = in.character.joints()[static_cast<std::size_t>(j)];
    double* q = posture.coords.data() + joint.coord;
    const bool given = !std::isnan(p[0]);
    if (joint.kind == JointKind::ball) {
      const Quat turned =
          given ? from_rotation_vector(Vec3(p[0], p[1], p[2]) * kRadPerDeg) : Quat(q[0], q[1], q[2], q[3]);
      q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
      p += 3;
    } else {
      if (given) q[0] = joint.kind == JointKind::hinge ? p[0] * kRadPerDeg : p[0];
      p += 1;
    }
  }
}

}  // namespace contort
