#include "checks/clip_steps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "model/core/number_text.h"

namespace contort {

std::string fixed_text(double value, int digits) {
  if (!(std::fabs(value) < 1e9)) return number_text(value);
  char text[40];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

KeyFinding at_key(const AssetClip& clip, ChannelPath path, Finding finding, const Asset& asset) {
  KeyFinding out;
  for (const AssetChannel& channel : clip.channels)
    if (channel.path == path && asset.nodes[static_cast<std::size_t>(channel.node)].label == finding.subject)
      out.t0_s = out.t1_s = channel.times_s[static_cast<std::size_t>(finding.worst_frame)];
  static_cast<Finding&>(out) = std::move(finding);
  return out;
}

std::vector<SpeedInterval> step_intervals(const AssetChannel& channel,
                                          FunctionRef<double(std::size_t, std::size_t)> apart) {
  std::vector<SpeedInterval> out;
  for (std::size_t key = 0; key + 1 < channel.times_s.size(); ++key) {
    const double t0 = channel.times_s[key], t1 = channel.times_s[key + 1], step = apart(key, key + 1);
    const double sudden = step > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
    out.push_back({t0, t1, t1 > t0 ? step / (t1 - t0) : sudden});
  }
  return out;
}

void add_step_findings(std::string_view check, const AssetNode& node, std::string_view unit,
                       std::span<const SpeedInterval> steps, std::span<const double> allowed,
                       const CheckSettings& settings, FunctionRef<std::string(std::size_t)> what,
                       std::vector<KeyFinding>& out) {
  MarginFold fold(1, settings.merge_gap_frames);
  fold.tolerate({tolerance_of(settings, check, node.label)}, {}, 1);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (std::isfinite(allowed[i]) && std::isfinite(steps[i].speed_rad_s))
      fold.report(0, static_cast<int>(i), allowed[i] - steps[i].speed_rad_s * (steps[i].t1_s - steps[i].t0_s));
  const double scale = find_check(check).scale;
  for (const MarginFold::Episode& e : fold.episodes()) {
    const auto worst = static_cast<std::size_t>(e.worst);
    KeyFinding finding;
    static_cast<Finding&>(finding) = {std::string(check), node.label, std::string(unit),   e.first + 1,
                                      e.worst + 1,        std::max(e.first + 1, e.last), e.worst_margin,
                                      -e.worst_margin / scale};
    finding.worst_frame = std::min(finding.worst_frame, finding.last_frame);
    finding.t0_s = steps[worst].t0_s, finding.t1_s = steps[worst].t1_s;
    finding.what = what(worst);
    out.push_back(std::move(finding));
  }
}

}  // namespace contort
