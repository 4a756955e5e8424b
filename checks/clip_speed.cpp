#include "checks/clip_speed.h"

#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "checks/pop.h"
#include "model/asset/sample.h"

namespace contort {

namespace {

double limit_of(const AssetNode& node, const SpeedLimits& limits) {
  for (const std::string& name : {node.label, node.name})
    if (const auto found = limits.of_node.find(name); found != limits.of_node.end()) return found->second;
  return limits.max_rad_s;
}

// Speed of each key interval: that between its keys, or, for a spline, the greatest inside where that is more.
std::vector<SpeedInterval> worst_of_each(const ChannelSpeeds& speeds) {
  std::vector<SpeedInterval> worst = speeds.between_keys;
  std::size_t key = 0;
  for (const SpeedInterval& part : speeds.within_keys) {  // in rising time; keys at one time have no parts
    while (key + 1 < worst.size() && part.t0_s >= speeds.between_keys[key].t1_s) ++key;
    if (part.speed_rad_s > worst[key].speed_rad_s) worst[key] = part;
  }
  return worst;
}

// The two kinds of findings of one channel, while its intervals are judged.
struct ChannelFolds {
  MarginFold fast;
  MarginFold pops;
  ChannelFolds(const CheckSettings& settings, const std::string& node)
      : fast(1, settings.merge_gap_frames), pops(1, settings.merge_gap_frames) {
    if (settings.limits.empty()) return;
    fast.tolerate({tolerance_of(settings, "angular_velocity", node)}, {}, 1);
    pops.tolerate({tolerance_of(settings, "pop", node)}, {}, 1);
  }
};

// Whether it is a pop is told by the keys alone: what a spline does between them is smooth.
void judge(const ChannelSpeeds& speeds, const std::vector<SpeedInterval>& worst, double limit, ChannelFolds& folds) {
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const double explained = std::max(limit, explained_rad_s(speeds.between_keys, i));
    const bool is_pop = speeds.between_keys[i].speed_rad_s > explained;
    MarginFold& fold = is_pop ? folds.pops : folds.fast;
    fold.report(0, static_cast<int>(i), (is_pop ? explained : limit) - worst[i].speed_rad_s);
  }
}

void add_findings(const MarginFold& fold, const char* check, double scale, const AssetNode& node,
                  const std::vector<SpeedInterval>& intervals, std::vector<ClipFinding>& out) {
  for (const MarginFold::Episode& e : fold.episodes()) {
    const SpeedInterval& worst = intervals[static_cast<std::size_t>(e.worst)];
    out.push_back({{check, node.label, "rad/s", e.first, e.worst, e.last, e.worst_margin, -e.worst_margin / scale},
                   worst.t0_s,
                   worst.t1_s,
                   worst.speed_rad_s});
  }
}

void add_channel(const AssetNode& node, const ChannelSpeeds& speeds, const SpeedLimits& limits, ClipSpeeds& out) {
  const std::vector<SpeedInterval> intervals = worst_of_each(speeds);
  const double limit = limit_of(node, limits);
  for (const SpeedInterval& interval : intervals) {
    out.least_margin_rad_s = std::min(out.least_margin_rad_s, limit - interval.speed_rad_s);
    if (interval.speed_rad_s <= out.peak_rad_s) continue;
    out.peak_node = node.label;
    out.peak_rad_s = interval.speed_rad_s;
    out.peak_t0_s = interval.t0_s;
    out.peak_t1_s = interval.t1_s;
  }
  ChannelFolds folds(limits.settings, node.label);
  judge(speeds, intervals, limit, folds);
  const auto first = static_cast<std::ptrdiff_t>(out.findings.size());
  add_findings(folds.fast, "angular_velocity", find_check("angular_velocity").scale, node, intervals, out.findings);
  add_findings(folds.pops, "pop", find_check("pop").scale, node, intervals, out.findings);
  std::stable_sort(out.findings.begin() + first, out.findings.end(), [](const ClipFinding& l, const ClipFinding& r) {
    return l.finding.first_frame < r.finding.first_frame;
  });
}

}  // namespace

ClipSpeeds check_clip_speeds(const Asset& asset, const AssetClip& clip, const SpeedLimits& limits) {
  ClipSpeeds out;
  out.clip = clip.label;
  for (const ChannelSpeeds& speeds : joint_speeds(clip)) {
    ++out.channels;
    add_channel(asset.nodes[static_cast<std::size_t>(speeds.node)], speeds, limits, out);
  }
  return out;
}

std::vector<ClipSpeeds> check_clip_speeds(const Asset& asset, const SpeedLimits& limits, const std::string& name) {
  std::vector<ClipSpeeds> all;
  for (const AssetClip& clip : asset.clips)
    if (name.empty() || clip.name == name || clip.label == name) all.push_back(check_clip_speeds(asset, clip, limits));
  return all;
}

}  // namespace contort
