#include "checks/loop_seam.h"

#include <algorithm>
#include <cmath>

#include "checks/clip_figure.h"
#include "checks/clip_steps.h"
#include "model/core/index.h"
#include "model/asset/sample.h"

namespace contort {

namespace {

double angle_between(const AssetChannel& channel, std::size_t key_a, std::size_t key_b) {
  const Quat a = sample_rotation(channel, channel.times_s[key_a]);
  const Quat b = sample_rotation(channel, channel.times_s[key_b]);
  return rotation_angle(glm::conjugate(a) * b);
}

double margin_rad(const AssetChannel& channel) {
  const std::size_t last = channel.times_s.size() - 1;
  const double widest = std::max(angle_between(channel, 0, 1), angle_between(channel, last - 1, last));
  return std::max(kSeam_rad, kSeamFactor * widest) - angle_between(channel, last, 0);
}

bool has_seam(const AssetChannel& channel) {
  return channel.path == ChannelPath::rotation && channel.times_s.size() >= 3;
}

// ---- places

constexpr double kSeamOfFigure = 0.01;  // 2 cm of a figure of 2 m
constexpr double kLatestStart_s = 0.1;  // exporters begin with frame 0 or 1, at 24 Hz or more

bool has_place_seam(const AssetChannel& channel) {
  return channel.path == ChannelPath::translation && channel.times_s.size() >= 3;
}

// Returns true if the node moves and no node above it does. Such a node carries the figure, and may end elsewhere than
// it began.
bool may_travel(const ClipInput& in, int node) {
  for (int n = in.asset.nodes[at(node)].parent; n >= 0; n = in.asset.nodes[at(n)].parent)
    for (const AssetChannel& channel : in.clip.channels)
      if (channel.node == n && channel.path == ChannelPath::translation) return false;
  return true;
}

// The distance between two keys; for a node that travels, the difference in height alone.
double apart_m(const ClipInput& in, const ClipFigure& figure, const AssetChannel& channel, std::size_t a,
               std::size_t b) {
  const Vec3 change = sample_vector(channel, channel.times_s[b]) - sample_vector(channel, channel.times_s[a]);
  const Vec3 moved = in_world(in.asset, figure, channel.node, change);
  return may_travel(in, channel.node) ? std::fabs(moved.y) : length(moved);
}

void add_place_seam(const ClipInput& in, const ClipFigure& figure, const AssetChannel& channel,
                    std::vector<KeyFinding>& out) {
  const std::size_t last = channel.times_s.size() - 1;
  const double widest =
      std::max(apart_m(in, figure, channel, 0, 1), apart_m(in, figure, channel, last - 1, last));
  const double gap_m = apart_m(in, figure, channel, last, 0);
  const std::string& node = in.asset.nodes[at(channel.node)].label;
  const double allowed_m = std::max(kSeamOfFigure * figure.size_m, kSeamFactor * widest);
  const double margin = allowed_m + tolerance_of(in.settings, "loop_seam", node) - gap_m;
  if (!(margin < 0.0)) return;
  const int key = static_cast<int>(last);
  KeyFinding finding = at_key(in.clip, ChannelPath::translation,
                              {"loop_seam", node, "m", key, key, key, margin, -margin / 0.02}, in.asset);
  finding.what = "ends " + fixed_text(gap_m, 3) + " m from where it began" +
                 (may_travel(in, channel.node) ? ", in height" : "") + ", where " + fixed_text(allowed_m, 3) +
                 " m are allowed";
  out.push_back(std::move(finding));
}

// Players begin at 0 s. If the first key of a clip is later, the figure stands still until then in each loop.
void add_late_start(const ClipInput& in, std::vector<KeyFinding>& out) {
  const double margin = kLatestStart_s + tolerance_of(in.settings, "loop_seam", "figure") - in.clip.first_s;
  if (!(margin < 0.0)) return;
  KeyFinding finding;
  static_cast<Finding&>(finding) = {"loop_seam", "figure", "s", 0, 0, 0, margin,
                                    -margin / find_check("loop_seam").scale};
  finding.t1_s = in.clip.first_s;
  finding.what = "stands still for " + fixed_text(in.clip.first_s, 3) + " s each time around: its first key is so late";
  out.push_back(std::move(finding));
}

}  // namespace

std::vector<Finding> check_loop_seam(const Asset& asset, const AssetClip& clip, const CheckSettings& settings) {
  const double scale = find_check("loop_seam").scale;
  std::vector<Finding> findings;
  for (const AssetChannel& channel : clip.channels) {
    if (!has_seam(channel)) continue;
    const std::string& node = asset.nodes[static_cast<std::size_t>(channel.node)].label;
    const double margin = margin_rad(channel) + tolerance_of(settings, "loop_seam", node);
    const int last = static_cast<int>(channel.times_s.size()) - 1;
    if (margin < 0.0) findings.push_back({"loop_seam", node, "rad", last, last, last, margin, -margin / scale});
  }
  return findings;
}

ClipCheckResult loop_seam_in_clip(const ClipInput& in) {
  if (!in.is_loop) return {0, "nothing says that the clip is a loop (--loops)", {}};
  ClipCheckResult result{0, "no joint has three keys", {}};
  for (Finding& finding : check_loop_seam(in.asset, in.clip, in.settings))
    result.findings.push_back(at_key(in.clip, ChannelPath::rotation, std::move(finding), in.asset));
  const ClipFigure figure = clip_figure(in.asset);
  for (const AssetChannel& channel : in.clip.channels) {
    if (has_seam(channel) || has_place_seam(channel)) ++result.subjects;
    if (has_place_seam(channel)) add_place_seam(in, figure, channel, result.findings);
  }
  if (result.subjects > 0) add_late_start(in, result.findings);
  return result;
}

}  // namespace contort
