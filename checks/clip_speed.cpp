#include "checks/clip_speed.h"

#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "generator/asset/sample.h"

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

const CheckDef& angular_velocity() {
  for (const CheckDef& check : all_checks())
    if (check.name == "angular_velocity") return check;
  return all_checks().front();
}

void add_channel(const AssetNode& node, const std::vector<SpeedInterval>& intervals, const SpeedLimits& limits,
                 ClipSpeeds& out) {
  MarginFold fold(1, CheckSettings{}.merge_gap_frames);
  const double limit = limit_of(node, limits);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    fold.report(0, static_cast<int>(i), limit - intervals[i].speed_rad_s);
    if (intervals[i].speed_rad_s <= out.peak_rad_s) continue;
    out.peak_node = node.label;
    out.peak_rad_s = intervals[i].speed_rad_s;
    out.peak_t0_s = intervals[i].t0_s;
    out.peak_t1_s = intervals[i].t1_s;
  }
  for (const MarginFold::Episode& e : fold.episodes()) {
    const SpeedInterval& worst = intervals[static_cast<std::size_t>(e.worst)];
    out.findings.push_back({{"angular_velocity", node.label, "rad/s", e.first, e.worst, e.last, e.worst_margin,
                             -e.worst_margin / angular_velocity().scale},
                            worst.t0_s,
                            worst.t1_s,
                            worst.speed_rad_s});
  }
}

}  // namespace

std::vector<ClipSpeeds> check_clip_speeds(const Asset& asset, const SpeedLimits& limits, const std::string& name) {
  std::vector<ClipSpeeds> all;
  for (const AssetClip& clip : asset.clips) {
    if (!name.empty() && clip.name != name && clip.label != name) continue;
    ClipSpeeds out;
    out.clip = clip.label;
    for (const ChannelSpeeds& speeds : joint_speeds(clip)) {
      ++out.channels;
      add_channel(asset.nodes[static_cast<std::size_t>(speeds.node)], worst_of_each(speeds), limits, out);
    }
    all.push_back(std::move(out));
  }
  return all;
}

}  // namespace contort
