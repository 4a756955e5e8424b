// bind_pose_flash: one or two frames of the rest pose in the middle of a motion. Causes are a layer that wrote nothing,
// or a pose that was not set. The poses before and after must be away from rest and like each other, so that a limb may
// swing through its rest pose.
#include <algorithm>
#include <array>

#include "checks/check.h"
#include "checks/clip_steps.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

constexpr double kAtRest_rad = 1.0 * kRadPerDeg;
constexpr double kAway_rad = 10.0 * kRadPerDeg;
constexpr int kLongest = 2;  // frames

// The difference of two poses, in the joint that differs most. It stops at the first joint above `enough`.
double difference_rad(const Character& character, const double* a, const double* b, double enough) {
  double most = 0.0;
  for (const Joint& joint : character.joints().subspan(1)) {
    most = std::max(most, likeness_rad(joint, a, b));
    if (most > enough) break;
  }
  return most;
}

struct Flash {
  const CheckInput& in;
  const double* rest = in.character.rest_coords().data();

  double from_rest_rad(int frame, double enough) const {
    return difference_rad(in.character, in.motion.row(frame).data(), rest, enough);
  }
  bool is_at_rest(int frame) const { return from_rest_rad(frame, kAtRest_rad) <= kAtRest_rad; }

  // Expects that the frames [first, last] are at rest, and that both neighbours exist.
  double margin_rad(int first, int last) const {
    const double* before = in.motion.row(first - 1).data();
    const double* after = in.motion.row(last + 1).data();
    const double away = std::min(from_rest_rad(first - 1, 1e9), from_rest_rad(last + 1, 1e9));
    if (difference_rad(in.character, before, after, away) > 0.5 * away) return kAway_rad;  // swings through
    return kAway_rad - away;
  }
};

// The rotations of a clip's joints, sampled at the keys of the channel with most keys.
struct ClipPoses {
  std::vector<double> times_s;
  std::vector<Quat> rest;   // by channel
  std::vector<Quat> turns;  // frame * channels + channel

  int frames() const { return static_cast<int>(times_s.size()); }
  std::span<const Quat> pose(int frame) const {
    return std::span(turns).subspan(static_cast<std::size_t>(frame) * rest.size(), rest.size());
  }
};

const AssetChannel* densest_turn(const AssetClip& clip) {
  const AssetChannel* densest = nullptr;
  for (const AssetChannel& channel : clip.channels)
    if (channel.path == ChannelPath::rotation &&
        (densest == nullptr || channel.times_s.size() > densest->times_s.size()))
      densest = &channel;
  return densest;
}

ClipPoses poses_of(const ClipInput& in) {
  ClipPoses out;
  const AssetChannel* densest = densest_turn(in.clip);
  if (densest == nullptr) return out;
  out.times_s = densest->times_s;
  for (const AssetChannel& channel : in.clip.channels)
    if (channel.path == ChannelPath::rotation)
      out.rest.push_back(in.asset.nodes[static_cast<std::size_t>(channel.node)].rest.rotation);
  for (const double t_s : out.times_s)
    for (const AssetChannel& channel : in.clip.channels)
      if (channel.path == ChannelPath::rotation) out.turns.push_back(sample_rotation(channel, t_s));
  return out;
}

double most_apart_rad(std::span<const Quat> a, std::span<const Quat> b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    most = std::max(most, rotation_angle(glm::conjugate(a[i]) * b[i]));
  return most;
}

// The distance from rest of the poses before and after the frames [first, last], which are at rest. Returns 0 if the
// figure moves there or back, or swings through the rest pose.
double flash_rad(const ClipPoses& poses, int first, int last) {
  const auto apart = [&](int a, int b) { return most_apart_rad(poses.pose(a), poses.pose(b)); };
  const double away = std::min(most_apart_rad(poses.pose(first - 1), poses.rest),
                               most_apart_rad(poses.pose(last + 1), poses.rest));
  const double before = first >= 2 ? apart(first - 2, first - 1) : 0.0;
  const double after = last + 2 < poses.frames() ? apart(last + 1, last + 2) : 0.0;
  const bool passes = std::max({2.0 * before, 2.0 * after, 2.0 * apart(first - 1, last + 1)}) > away;
  return passes ? 0.0 : away;
}

void judge_flash(const ClipInput& in, const ClipPoses& poses, int first, int last, std::vector<KeyFinding>& out) {
  const double away = flash_rad(poses, first, last);
  const double margin = kAway_rad + tolerance_of(in.settings, "bind_pose_flash", "figure") - away;
  if (!(margin < 0.0)) return;
  KeyFinding finding;
  static_cast<Finding&>(finding) = {"bind_pose_flash", "figure", "rad", first, first, last, margin,
                                    -margin / find_check("bind_pose_flash").scale};
  finding.t0_s = poses.times_s[static_cast<std::size_t>(first)];
  finding.t1_s = poses.times_s[static_cast<std::size_t>(last)];
  finding.what =
      "is in its rest pose, between poses that are " + fixed_text(away * kDegPerRad, 1) + " deg away from it";
  out.push_back(std::move(finding));
}

}  // namespace

ClipCheckResult bind_pose_flash_in_clip(const ClipInput& in) {
  const ClipPoses poses = poses_of(in);
  if (poses.frames() < 3) return {0, "no joint turns at three keys", {}};
  ClipCheckResult result{1, "", {}};
  const auto is_at_rest = [&](int frame) { return most_apart_rad(poses.pose(frame), poses.rest) <= kAtRest_rad; };
  for (int first = 1; first + 1 < poses.frames(); ++first) {
    if (!is_at_rest(first)) continue;
    int last = first;
    while (last + 1 < poses.frames() && is_at_rest(last + 1)) ++last;
    if (last - first < kLongest && last + 1 < poses.frames() && !is_at_rest(first - 1))
      judge_flash(in, poses, first, last, result.findings);
    first = last;
  }
  return result;
}

int bind_pose_flash_subject_count(const Character&) { return 1; }

Subject bind_pose_flash_subject(const Character&, int) { return {"figure", "rad"}; }

void bind_pose_flash_measure(const CheckInput& in, MarginFold& fold) {
  const Flash flash{in};
  if (in.motion.frame_count >= 3) fold.judged_all();
  for (int first = 1; first + 1 < in.motion.frame_count; ++first) {
    if (!flash.is_at_rest(first)) continue;
    int last = first;
    while (last + 1 < in.motion.frame_count && flash.is_at_rest(last + 1)) ++last;
    const bool is_meant = in.may_jump_into(first) || in.may_jump_into(last + 1);
    const bool is_short = !is_meant && last - first < kLongest && last + 1 < in.motion.frame_count &&
                          !flash.is_at_rest(first - 1);
    if (is_short)
      for (int frame = first; frame <= last; ++frame) fold.report(0, frame, flash.margin_rad(first, last));
    first = last;
  }
}

}  // namespace contort
