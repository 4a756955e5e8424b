// unreadable_channel: the reader had to leave out a channel of a clip. The rest may look right, but is not the motion
// that the file describes.
#include <algorithm>

#include "checks/clip_faults.h"

namespace contort {

namespace {

KeyFinding finding_of(const Asset& asset, const AssetFault& fault, double margin) {
  KeyFinding finding;
  const std::string subject = fault.node < 0 ? "figure" : asset.nodes[static_cast<std::size_t>(fault.node)].label;
  static_cast<Finding&>(finding) = {"unreadable_channel", subject, "faults", -1, -1, -1, margin,
                                    -margin / find_check("unreadable_channel").scale};
  finding.what = fault.code + " at " + fault.where + ": " + fault.text;
  return finding;
}

}  // namespace

std::vector<const AssetFault*> faults_of(const Asset& asset, const AssetClip& clip) {
  std::vector<const AssetFault*> out;
  const bool is_first = !asset.clips.empty() && asset.clips.front().label == clip.label;
  for (const AssetFault& fault : asset.faults)
    if (fault.clip == clip.label || (fault.clip.empty() && is_first)) out.push_back(&fault);
  return out;
}

ClipCheckResult unreadable_channel_in_clip(const ClipInput& in) {
  ClipCheckResult result{static_cast<int>(in.clip.channels.size()), "the clip has no channel", {}};
  for (const AssetFault* fault : faults_of(in.asset, in.clip)) {
    if (fault->key >= 0) continue;  // the channel was read anyway, and quaternion_length judges it
    ++result.subjects;
    KeyFinding finding = finding_of(in.asset, *fault, -1.0);
    const double tolerance = tolerance_of(in.settings, "unreadable_channel", finding.subject);
    if (tolerance < 1.0) result.findings.push_back(std::move(finding));
  }
  return result;
}

}  // namespace contort
