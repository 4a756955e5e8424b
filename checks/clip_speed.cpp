#include "checks/clip_speed.h"

#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "checks/lone_steps.h"
#include "checks/pop.h"
#include "model/asset/sample.h"

namespace contort {

namespace {

double limit_of(const AssetNode& node, const SpeedLimits& limits) {
  for (const std::string& name : {node.label, node.name})
    if (const auto found = limits.of_node.find(name); found != limits.of_node.end()) return found->second;
  return limits.max_rad_s;
}

// The speed of each key interval: the speed between its keys or, for a spline, the greatest speed inside if it is
// higher.
std::vector<SpeedInterval> worst_of_each(const ChannelSpeeds& speeds) {
  std::vector<SpeedInterval> worst = speeds.between_keys;
  for (std::size_t key = 0; key < speeds.within_keys.size(); ++key)
    if (speeds.within_keys[key].speed_rad_s > worst[key].speed_rad_s) worst[key] = speeds.within_keys[key];
  return worst;
}

// Collects the two kinds of findings of one channel.
struct ChannelFolds {
  MarginFold fast;
  MarginFold pops;
  double stricter_rad_s = 0.0;  // <= 0: a rule of the settings lowers the limit of pops by this
  int apart;  // distance of two intervals in the fold: each jump of a STEP channel is a finding of its own
  ChannelFolds(const CheckSettings& settings, const std::string& node, bool jumps)
      : fast(1, jumps ? 0 : settings.merge_gap_frames),
        pops(1, jumps ? 0 : settings.merge_gap_frames),
        stricter_rad_s(std::min(0.0, tolerance_of(settings, "pop", node))),
        apart(jumps ? 2 : 1) {
    if (settings.limits.empty()) return;
    fast.tolerate({tolerance_of(settings, "angular_velocity", node)}, {}, 1);
    pops.tolerate({tolerance_of(settings, "pop", node)}, {}, 1);
  }
};

// The largest step of each interval that is no lone step (lone_steps.h), rad.
std::vector<double> allowed_turns(const AssetChannel& channel, const ChannelSpeeds& speeds) {
  std::vector<Quat> keys;
  for (const double t_s : channel.times_s) keys.push_back(sample_rotation(channel, t_s));
  return allowed_lone_steps(
      speeds.between_keys,
      [&](std::size_t a, std::size_t b) { return rotation_angle(glm::conjugate(keys[a]) * keys[b]); },
      lone_limits(speeds.jumps ? Interpolation::step : Interpolation::linear, {kBlip_rad, kJump_rad}));
}

// The greatest speed of interval i that is no pop. At first it is the limit, or the speed that the surrounding motion
// explains if that is higher (pop.h); nothing explains the jumps of a STEP channel. Slower intervals are pops too if
// they are lone steps or unexplained leaps of kLeap_rad.
double greatest_without_pop(const ChannelSpeeds& speeds, const std::vector<double>& allowed_rad, std::size_t i,
                            double limit, bool may_leap) {
  const SpeedInterval& step = speeds.between_keys[i];
  const double duration_s = step.t1_s - step.t0_s;
  const double explained = speeds.jumps ? 0.0 : explained_rad_s(speeds.between_keys, i);
  const double general = std::max(limit, explained);
  if (step.speed_rad_s > general || !(duration_s > 0.0)) return general;
  const double leap = may_leap ? std::max(kLeap_rad / duration_s, explained) : general;
  return std::min({general, leap, allowed_rad[i] / duration_s});
}

// Pops are found in the speeds between keys, because a spline is smooth inside. The fold adds the tolerance of a rule
// again, so a tolerance that was used to find the pop is subtracted here.
void judge(const AssetChannel& channel, const ChannelSpeeds& speeds, const std::vector<SpeedInterval>& worst,
           double limit, ChannelFolds& folds) {
  const std::vector<double> allowed = allowed_turns(channel, speeds);
  const bool may_leap = !speeds.jumps;
  for (std::size_t i = 0; i < worst.size(); ++i) {
    const double most = greatest_without_pop(speeds, allowed, i, limit + folds.stricter_rad_s, may_leap);
    const bool is_pop = speeds.between_keys[i].speed_rad_s > most;
    MarginFold& fold = is_pop ? folds.pops : folds.fast;
    const double limit_of_fold = is_pop ? most - folds.stricter_rad_s : limit;
    fold.report(0, folds.apart * static_cast<int>(i), limit_of_fold - worst[i].speed_rad_s);
  }
}

void add_findings(const MarginFold& fold, int apart, const char* check, const AssetNode& node,
                  const std::vector<SpeedInterval>& intervals, std::vector<ClipFinding>& out) {
  const double scale = find_check(check).scale;
  for (const MarginFold::Episode& e : fold.episodes()) {
    const SpeedInterval& worst = intervals[static_cast<std::size_t>(e.worst / apart)];
    out.push_back({{check, node.label, "rad/s", e.first / apart, e.worst / apart, e.last / apart, e.worst_margin,
                    -e.worst_margin / scale},
                   worst.t0_s,
                   worst.t1_s,
                   worst.speed_rad_s});
  }
}

void add_channel(const AssetNode& node, const AssetChannel& channel, const ChannelSpeeds& speeds,
                 const SpeedLimits& limits, ClipSpeeds& out) {
  const bool is_spline = !speeds.within_keys.empty();
  const std::vector<SpeedInterval> worst = is_spline ? worst_of_each(speeds) : std::vector<SpeedInterval>();
  const std::vector<SpeedInterval>& intervals = is_spline ? worst : speeds.between_keys;  // avoids copying long takes
  const double limit = limit_of(node, limits);
  for (const SpeedInterval& interval : intervals) {
    out.least_margin_rad_s = std::min(out.least_margin_rad_s, limit - interval.speed_rad_s);
    if (interval.speed_rad_s <= out.peak_rad_s) continue;
    out.peak_node = node.label;
    out.peak_rad_s = interval.speed_rad_s;
    out.peak_t0_s = interval.t0_s;
    out.peak_t1_s = interval.t1_s;
  }
  ChannelFolds folds(limits.settings, node.label, speeds.jumps);
  judge(channel, speeds, intervals, limit, folds);
  const auto first = static_cast<std::ptrdiff_t>(out.findings.size());
  add_findings(folds.fast, folds.apart, "angular_velocity", node, intervals, out.findings);
  add_findings(folds.pops, folds.apart, "pop", node, intervals, out.findings);
  std::stable_sort(out.findings.begin() + first, out.findings.end(), [](const ClipFinding& l, const ClipFinding& r) {
    return l.finding.first_frame < r.finding.first_frame;
  });
}

}  // namespace

ClipSpeeds check_clip_speeds(const Asset& asset, const AssetClip& clip, const SpeedLimits& limits) {
  ClipSpeeds out;
  out.clip = clip.label;
  for (std::size_t i = 0; i < clip.channels.size(); ++i) {
    const AssetChannel& channel = clip.channels[i];
    if (channel.path != ChannelPath::rotation) continue;
    const ChannelSpeeds speeds = channel_speeds(clip, static_cast<int>(i));
    if (!speeds.between_keys.empty()) ++out.channels;
    const AssetNode& node = asset.nodes[static_cast<std::size_t>(channel.node)];
    add_channel(node, channel, speeds, limits, out);
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
