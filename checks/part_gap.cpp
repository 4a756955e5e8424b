#include "checks/part_gap.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "checks/clip_steps.h"
#include "model/asset/sample.h"

namespace contort {

namespace {

constexpr int kParts = 8;  // samples per interval of a spline

const AssetNode* parent_of(const Asset& asset, const AssetNode& node) {
  return node.parent < 0 ? nullptr : &asset.nodes[static_cast<std::size_t>(node.parent)];
}

// Returns true if the node has at least two joints above it. In a file without a skin, which would name the joints,
// every node counts as a joint.
bool is_inner(const Asset& asset, const AssetNode& node) {
  const bool has_joints = std::ranges::any_of(asset.nodes, &AssetNode::is_joint);
  const AssetNode* parent = parent_of(asset, node);
  const AssetNode* above = parent == nullptr ? nullptr : parent_of(asset, *parent);
  return above != nullptr && (!has_joints || (node.is_joint && parent->is_joint && above->is_joint));
}

bool is_moved(const AssetClip& clip, int node) {
  return std::ranges::any_of(clip.channels, [&](const AssetChannel& channel) { return channel.node == node; });
}

bool hangs_on(const Asset& asset, int node, int above) {
  for (int n = node; n >= 0; n = asset.nodes[static_cast<std::size_t>(n)].parent)
    if (n == above) return true;
  return false;
}

// Returns true if the node carries the figure through the world, in a file without a skin: nothing above it moves, and
// something below it does.
bool carries_figure(const Asset& asset, const AssetClip& clip, int node) {
  if (std::ranges::any_of(asset.nodes, &AssetNode::is_joint)) return false;
  for (int n = asset.nodes[static_cast<std::size_t>(node)].parent; n >= 0;
       n = asset.nodes[static_cast<std::size_t>(n)].parent)
    if (is_moved(clip, n)) return false;
  return std::ranges::any_of(clip.channels, [&](const AssetChannel& channel) {
    return channel.node != node && hangs_on(asset, channel.node, node);
  });
}

double gap_m(const AssetChannel& channel, const Vec3& rest_m, double t_s) {
  const Vec3 off = sample_vector(channel, t_s) - rest_m;
  return std::sqrt(glm::dot(off, off));
}

// The widest gap from this key up to the next one.
double widest_m(const AssetChannel& channel, const Vec3& rest_m, std::size_t key) {
  double widest = gap_m(channel, rest_m, channel.times_s[key]);
  if (channel.interpolation != Interpolation::cubic_spline || key + 1 == channel.times_s.size()) return widest;
  const double t0 = channel.times_s[key], step = (channel.times_s[key + 1] - t0) / kParts;
  for (int part = 1; part < kParts; ++part) widest = std::max(widest, gap_m(channel, rest_m, t0 + part * step));
  return widest;
}

bool has_place(const Asset& asset, const AssetClip& clip, const AssetChannel& channel) {
  return channel.path == ChannelPath::translation &&
         is_inner(asset, asset.nodes[static_cast<std::size_t>(channel.node)]) &&
         !carries_figure(asset, clip, channel.node);
}

std::optional<Finding> judge(const AssetChannel& channel, const AssetNode& node, double allowed_m) {
  Finding finding{"part_gap", node.label, "m", -1, -1, -1, 0.0, 0.0};
  for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
    const double margin_m = allowed_m - widest_m(channel, node.rest.translation, key);
    if (!(margin_m < 0.0)) continue;
    finding.last_frame = static_cast<int>(key);
    if (finding.first_frame < 0) finding.first_frame = finding.last_frame;
    if (margin_m < finding.worst_margin) finding.worst_frame = finding.last_frame, finding.worst_margin = margin_m;
  }
  finding.depth = -finding.worst_margin / find_check("part_gap").scale;
  return finding.first_frame < 0 ? std::optional<Finding>() : finding;
}

}  // namespace

std::vector<Finding> check_part_gap(const Asset& asset, const AssetClip& clip, double most_m,
                                    const CheckSettings& settings) {
  std::vector<Finding> findings;
  for (const AssetChannel& channel : clip.channels) {
    if (!has_place(asset, clip, channel)) continue;
    const AssetNode& node = asset.nodes[static_cast<std::size_t>(channel.node)];
    const double allowed_m = most_m + tolerance_of(settings, "part_gap", node.label);
    if (std::optional<Finding> finding = judge(channel, node, allowed_m)) findings.push_back(std::move(*finding));
  }
  return findings;
}

ClipCheckResult part_gap_in_clip(const ClipInput& in) {
  if (!in.max_gap_m) return {0, "nothing says how far a joint may be from its place (--max-gap-m)", {}};
  // Joints without a translation channel are in place; they count as judged.
  const auto is_one = [&](const AssetNode& node) { return is_inner(in.asset, node); };
  const auto joints = static_cast<int>(std::ranges::count_if(in.asset.nodes, is_one));
  if (joints == 0) return {0, "no joint hangs below the root's own", {}};
  ClipCheckResult result{joints, "", {}};
  for (Finding& finding : check_part_gap(in.asset, in.clip, *in.max_gap_m, in.settings))
    result.findings.push_back(at_key(in.clip, ChannelPath::translation, std::move(finding), in.asset));
  return result;
}

}  // namespace contort
