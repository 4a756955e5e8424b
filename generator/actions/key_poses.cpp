#include "generator/actions/key_poses.h"

#include <algorithm>
#include <array>

#include "generator/actions/action.h"
#include "model/core/detmath.h"

namespace contort {

std::vector<ParamDef> pose_params(const Character&, const Part&);  // a row of action_list.inc

namespace {

double eased(KeyEase ease, double u) {
  switch (ease) {
    case KeyEase::smooth: return u * u * u * (10.0 + u * (6.0 * u - 15.0));
    case KeyEase::linear: return u;
    case KeyEase::step: return u < 1.0 ? 0.0 : 1.0;
    case KeyEase::sine: return 0.5 - 0.5 * det::cos(kPi * u);
  }
  return u;
}

KeyPlan::Node node_of(const KeyPoseDesc& key, const Joint& joint, const ParamValue& value) {
  KeyPlan::Node node{key.at, key.ease, 0.0, kNoRotation};
  if (joint.kind == JointKind::ball) {
    node.turn = from_rotation_vector(std::get<Vec3>(value) * kRadPerDeg);
  } else {
    const double number = std::get<double>(value);
    node.value = joint.kind == JointKind::hinge ? number * kRadPerDeg : number;
  }
  return node;
}

// Writes to `q` a joint's coordinates at `share` of its way from the node with coordinates `before` to the next one.
void between(const Joint& joint, const double* before, const KeyPlan::Node& next, double share, double* q) {
  if (joint.kind != JointKind::ball) {
    q[0] = before[0] + share * (next.value - before[0]);
    return;
  }
  const Quat turn = slerp_short(Quat(before[0], before[1], before[2], before[3]), next.turn, share);
  q[0] = turn.w, q[1] = turn.x, q[2] = turn.y, q[3] = turn.z;
}

// Keys that were over when the action took the part, because it was cut and goes on, are not gone back to; only the
// last one always is where it ends.
void follow(const KeyPlan::Path& path, const RuleInput& in, double took_at, double now, Posture& posture) {
  const Joint& joint = in.character.joints()[static_cast<std::size_t>(path.joint)];
  std::array<double, 4> before{};
  std::copy_n(in.from.coords.begin() + joint.coord, coord_size(joint.kind), before.begin());
  double* q = posture.coords.data() + joint.coord;
  double before_at = took_at;
  for (const KeyPlan::Node& node : path.nodes) {
    const bool over = node.at <= took_at;
    if (over && &node != &path.nodes.back()) continue;
    const double at = over ? 1.0 : node.at;
    if (now < at) return between(joint, before.data(), node, eased(node.ease, (now - before_at) / (at - before_at)), q);
    between(joint, before.data(), node, 1.0, before.data());
    before_at = at;
  }
  std::copy_n(before.begin(), coord_size(joint.kind), q);
}

void keys_rule(const RuleInput& in, Posture& posture) {
  const ActionTime& time = in.time;
  const double took_at = time.duration_s > 0.0 ? (time.time_s - time.since_s) / time.duration_s : 0.0;
  for (const KeyPlan::Path& path : in.keys->paths) follow(path, in, took_at, time.progress, posture);
}

std::vector<ParamDef> no_params(const Character&, const Part&) { return {}; }
bool has_joints(const Character&, const Part& part) { return part.joint_count > 0; }

}  // namespace

const ActionDef& key_pose_def() {
  static const ActionDef def{"keys",      Layer::overwrite, Timing::course,
                             Spread::own, Promise::none, Tells::nothing,   "Key poses, one after another.",
                             no_params,   has_joints,       keys_rule};
  return def;
}

KeyPlan plan_keys(const ActionDesc& action, const Character& character, const Part& part) {
  const std::vector<ParamDef> defs = pose_params(character, part);
  const bool right = part.side == Side::right;
  KeyPlan plan;
  for (int i = 0; i < part.joint_count; ++i) {
    KeyPlan::Path path{part.first_joint + i, {}};
    const ParamDef& def = defs[static_cast<std::size_t>(i)];
    const Joint& joint = character.joints()[static_cast<std::size_t>(path.joint)];
    for (const KeyPoseDesc& key : action.keys)
      if (const auto given = key.pose.find(def.name); given != key.pose.end())
        path.nodes.push_back(node_of(key, joint, right ? mirrored(def.mirrored, given->second) : given->second));
    if (!path.nodes.empty()) plan.paths.push_back(std::move(path));
  }
  return plan;
}

}  // namespace contort
