// quaternion_length: a rotation must be a quaternion of length 1. Other lengths scale and shear the model.
#include <algorithm>
#include <cmath>

#include "checks/check.h"
#include "checks/clip_faults.h"
#include "checks/clip_steps.h"

namespace contort {

namespace {

constexpr double kLengthLimit = 1e-3;
constexpr double kLengthLimitOfFiles = 0.01;  // files round quaternions to bytes and half floats

}  // namespace

ClipCheckResult quaternion_length_in_clip(const ClipInput& in) {
  ClipCheckResult result{0, "no node turns", {}};
  result.subjects = static_cast<int>(std::ranges::count(in.clip.channels, ChannelPath::rotation, &AssetChannel::path));
  for (const AssetFault* fault : faults_of(in.asset, in.clip)) {
    if (fault->key < 0) continue;
    const std::string& node = in.asset.nodes[static_cast<std::size_t>(fault->node)].label;
    const double margin = kLengthLimitOfFiles + tolerance_of(in.settings, "quaternion_length", node) -
                          std::fabs(fault->length - 1.0);
    if (!(margin < 0.0)) continue;
    Finding finding = {"quaternion_length", node, "length", fault->key, fault->key, fault->key, margin,
                       -margin / find_check("quaternion_length").scale};
    result.findings.push_back(at_key(in.clip, ChannelPath::rotation, std::move(finding), in.asset));
    result.findings.back().what = "is a quaternion of length " + fixed_text(fault->length, 3);
  }
  return result;
}

int quaternion_length_subject_count(const Character& character) { return static_cast<int>(character.joints().size()); }

Subject quaternion_length_subject(const Character& character, int subject) {
  return {character.joints()[static_cast<std::size_t>(subject)].name, "length"};
}

void quaternion_length_measure(const CheckInput& in, MarginFold& fold) {
  const std::size_t joints = in.character.joints().size();
  const std::vector<double>& lengths = in.foreign->quaternion_lengths;
  for (std::size_t i = 0; i < lengths.size(); ++i)
    fold.report(static_cast<int>(i % joints), static_cast<int>(i / joints), kLengthLimit - std::fabs(lengths[i] - 1.0));
}

}  // namespace contort
