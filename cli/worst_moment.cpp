#include "cli/worst_moment.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "cli/print.h"
#include "model/asset/sample.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "renders/highlight.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

std::string beyond_text(const Finding& finding) {
  if (finding.unit == "rad") return decimal(-finding.worst_margin * kDegPerRad, 1) + " deg beyond the limit";
  return rounded_text(-finding.worst_margin) + " " + finding.unit + " beyond the limit";
}

std::string speed_text(const ClipFinding& f) {
  return decimal(f.worst_speed_rad_s * kDegPerRad, 1) + " deg/s, allowed " +
         decimal((f.worst_speed_rad_s + f.finding.worst_margin) * kDegPerRad, 1);
}

// Calls `see` with each finding.
void each_finding(const ClipReport& clip, const std::function<void(const WorstMoment&)>& see) {
  for (const ClipFinding& f : clip.judged.speeds.findings) see({f.finding, speed_text(f), f.worst_t1_s});
  if (clip.judged.limits)
    for (const Finding& f : clip.judged.limits->findings)
      see({f, beyond_text(f), (f.worst_frame - clip.first_frame) / clip.rate_hz});
  for (const KeyFinding& f : clip.judged.clip_findings)
    see({f, f.what.empty() ? beyond_text(f) : f.what,
         f.first_frame < 0 ? std::nullopt : std::optional<double>(f.t1_s)});
  if (clip.motion)
    for (std::size_t i = 0; i < clip.judged.motion_findings.size(); ++i) {
      const Finding& f = clip.judged.motion_findings[i];
      see({f, clip.motion_texts[i], clip.motion->time_s(f.worst_frame), f.worst_frame});
    }
}

double depth_of(const Finding& finding) { return std::isnan(finding.depth) ? HUGE_VAL : finding.depth; }

void mark(std::size_t i, StickFigure& out) {
  if (i < out.marked.size()) out.marked[i] = 1;
}

// Returns true for the name of a node, also with words after it: "lwrist ry max".
bool is_about(const std::string& subject, const std::string& label) {
  return subject == label || (subject.starts_with(label) && subject[label.size()] == ' ');
}

int frame_of(const WorstMoment& worst, const Motion& motion, double first_s) {
  int frame = worst.frame;
  if (frame < 0 && worst.time_s)
    frame = static_cast<int>(
        std::lround(std::clamp((*worst.time_s - first_s) * motion.rate_hz, 0.0, motion.frame_count - 1.0)));
  return std::clamp(frame, 0, motion.frame_count - 1);
}

void mark_subject(const ClipCharacter& on, const Finding& finding, StickFigure& out) {
  const Character& character = *on.character;
  const Highlight about = highlighted(character, finding);
  for (const int joint : about.joints) mark(at(joint), out);
  for (const std::vector<int>& solid : about.solids)
    for (const int collider : solid) mark(at(character.colliders()[at(collider)].joint), out);
  const auto node = on.map.joints.find(finding.subject);
  if (node == on.map.joints.end()) return;
  if (const int joint = character.find_joint(node->second); joint >= 0) mark(at(joint), out);
}

StickFigure pose_of_character(const ClipCharacter& on, const Motion& motion, int frame, const Finding& finding) {
  const Character& character = *on.character;
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[at(frame)], motion.row(frame), world);
  StickFigure out;
  out.marked.assign(world.size(), 0);
  for (std::size_t j = 0; j < world.size(); ++j) {
    out.points.push_back(world[j].p_m);
    out.parents.push_back(character.joints()[j].parent);
  }
  mark_subject(on, finding, out);
  return out;
}

StickFigure pose_of_file(const Asset& asset, const AssetClip& clip, const WorstMoment& worst) {
  const std::vector<Trs> local = pose(asset, clip, worst.time_s.value_or(clip.first_s));
  const bool has_joints = std::ranges::any_of(asset.nodes, &AssetNode::is_joint);
  StickFigure out;
  std::vector<Rigid> world(asset.nodes.size());
  std::vector<int> point_of(asset.nodes.size(), -1);  // point of each node, or of the nearest node above with a point
  for (const int node : asset.order) {
    const AssetNode& own = asset.nodes[at(node)];
    const Rigid in_parent{local[at(node)].rotation, local[at(node)].translation};
    world[at(node)] = own.parent < 0 ? in_parent : world[at(own.parent)] * in_parent;
    const int above = own.parent < 0 ? -1 : point_of[at(own.parent)];
    point_of[at(node)] = above;
    if (has_joints && !own.is_joint) continue;
    point_of[at(node)] = static_cast<int>(out.points.size());
    out.points.push_back(world[at(node)].p_m);
    out.parents.push_back(above);
    out.marked.push_back(is_about(worst.finding.subject, own.label) ? 1 : 0);
  }
  return out;
}

}  // namespace

std::optional<WorstMoment> worst_moment(const ClipReport& clip) {
  std::optional<WorstMoment> worst;
  each_finding(clip, [&](const WorstMoment& moment) {
    if (!worst || depth_of(moment.finding) > depth_of(worst->finding)) worst = moment;
  });
  return worst;
}

std::string counts_of_checks(const ClipReport& clip) {
  std::map<std::string, int> counts;
  each_finding(clip, [&](const WorstMoment& moment) { ++counts[moment.finding.check]; });
  std::string text;
  for (const auto& [check, count] : counts) text += (text.empty() ? "" : ", ") + check + " " + std::to_string(count);
  return text;
}

StickFigure worst_pose(const ClipCharacter& on, const Animation& animation, const AssetClip& clip,
                       const ClipReport& report) {
  const std::optional<WorstMoment> worst = worst_moment(report);
  if (!worst) return {};
  if (!on.character || !report.made || !report.motion) return pose_of_file(animation.asset, clip, *worst);
  const Motion& motion = report.made->motion;
  if (motion.frame_count == 0) return {};
  return pose_of_character(on, motion, frame_of(*worst, motion, report.motion->first_s), worst->finding);
}

}  // namespace contort::cli
