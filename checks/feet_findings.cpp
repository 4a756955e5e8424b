#include "checks/feet_findings.h"

#include <algorithm>
#include <cmath>

#include "checks/settings.h"
#include "model/core/index.h"

namespace contort {

namespace {

// The last key at or before the time, in the channel with most keys.
int key_at(const AssetClip& clip, double t_s) {
  const auto has_fewer = [](const AssetChannel& a, const AssetChannel& b) { return a.times_s.size() < b.times_s.size(); };
  const auto most = std::max_element(clip.channels.begin(), clip.channels.end(), has_fewer);
  if (most == clip.channels.end()) return 0;
  const auto after = std::ranges::upper_bound(most->times_s, t_s + 1e-6);
  return std::max(0, static_cast<int>(after - most->times_s.begin()) - 1);
}

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

std::string what_of(FootCheck which, const FootFault& fault) {
  if (which == FootCheck::slide)
    return "slides on the ground by " + percent(fault.amount) + " of the leg's length, allowed are " +
           percent(kClipSlide);
  return "is " + percent(fault.amount) + " of the leg's length below the ground on which another foot stands, allowed are " +
         percent(kClipSink);
}

KeyFinding finding_of(const ClipInput& in, FootCheck which, const FootFault& fault) {
  const std::string_view check = which == FootCheck::slide ? "foot_slide" : "ground_penetration";
  const std::string& name = (*in.feet)[at(fault.foot)].name;
  const double allowed = which == FootCheck::slide ? kClipSlide : kClipSink;
  const double margin = (allowed - fault.amount) * fault.leg + tolerance_of(in.settings, check, name);
  KeyFinding out;
  static_cast<Finding&>(out) = {std::string(check), name, "m", key_at(in.clip, fault.first_s),
                                key_at(in.clip, fault.worst_s), key_at(in.clip, fault.last_s), margin,
                                -margin / find_check(check).scale};
  out.t0_s = fault.first_s, out.t1_s = fault.worst_s;
  out.what = what_of(which, fault);
  return out;
}

}  // namespace

ClipCheckResult judge_feet_in_clip(const ClipInput& in, FootCheck which) {
  ClipCheckResult result;
  if (in.feet == nullptr) return result;
  const ClipFeetFaults faults = faults_of_feet(in.asset, in.clip, *in.feet);
  const bool slides = which == FootCheck::slide;
  result.why_not = slides && faults.why_not.empty() ? faults.no_slide : faults.why_not;
  if (!slides && !faults.drifts.empty()) result.why_not = {};
  if (!result.why_not.empty()) return result;
  result.subjects = faults.judged;
  if (!slides)
    for (const FootFault& drift : faults.drifts)
      if (KeyFinding finding = finding_of(in, which, drift); finding.worst_margin < 0.0) {
        finding.what = "goes up or down with the whole figure by " + percent(drift.amount) +
                       " of the leg's length while all feet keep their places, allowed are " + percent(kClipSink);
        result.findings.push_back(std::move(finding));
      }
  for (const FootFault& fault : slides ? faults.slides : faults.sinks)
    if (KeyFinding finding = finding_of(in, which, fault); finding.worst_margin < 0.0)
      result.findings.push_back(std::move(finding));
  return result;
}

}  // namespace contort
