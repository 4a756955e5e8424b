// pose: forward kinematics. One parameter for each joint of the part; joints without a value stay as they are.
#include <cmath>

#include "generator/actions/action.h"

namespace contort {

namespace {

ParamDef param_of(const Joint& joint) {
  ParamDef def;
  def.optional = true;
  def.domain = Domain::joint_range;
  if (joint.kind == JointKind::prismatic) {
    def.name = joint.local_name + "_m";
    def.low = -10.0, def.high = 10.0;
    def.help = "Travel, m.";
  } else {
    // Beyond the joint's own range on purpose: an author can ask for too much, and the check shall say so.
    def.name = joint.local_name + "_deg";
    def.low = -360.0, def.high = 360.0;
    def.help =
        joint.kind == JointKind::ball ? "Rotation vector against rest, degrees." : "Angle against rest, degrees.";
  }
  if (joint.kind == JointKind::ball) {
    def.type = ParamType::vector;
    def.preset = Vec3(0.0);
    def.mirrored = Mirrored::rotation;
  }
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
