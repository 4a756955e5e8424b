#include "model/asset/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/asset/spline_peak.h"
#include "model/core/assert.h"

namespace contort {

namespace {

using Row = std::array<double, 4>;  // The last one is unused in vectors.

constexpr double kLongestFrame_s = 1.0 / 60.0;    // longest time for which a display shows a frame
constexpr double kShortestFrame_s = 1.0 / 240.0;  // shortest time for which a person sees a frame
// Greatest distance between keys of a sampled motion: films are drawn at 12 a second.
constexpr double kSparsest_s = 1.0 / 11.9;
constexpr double kNearlyAll = 0.9;                // part of a frame: times of keys are rounded, up to a millisecond

// The keys around a time.
struct KeySpan {
  std::size_t left = 0;
  std::size_t right = 0;  // == left outside of the keys
  double duration_s = 0.0;
  double fraction = 0.0;  // in [0, 1)
};

KeySpan locate(const std::vector<double>& times_s, double t_s) {
  const auto after = std::upper_bound(times_s.begin(), times_s.end(), t_s);
  if (after == times_s.begin()) return {};
  const auto right = static_cast<std::size_t>(after - times_s.begin());
  if (after == times_s.end()) return {right - 1, right - 1, 0.0, 0.0};
  const double duration = times_s[right] - times_s[right - 1];  // > 0, even among equal times
  return {right - 1, right, duration, (t_s - times_s[right - 1]) / duration};
}

enum Tangent : std::size_t { in_tangent, key_value, out_tangent };

// A row of a spline's key; other channels have only one row per key.
Row row_at(const AssetChannel& channel, std::size_t key, Tangent which) {
  const bool is_spline = channel.interpolation == Interpolation::cubic_spline;
  const std::size_t size = row_size(channel.path);
  const std::size_t first = size * (is_spline ? 3 * key + which : key);
  Row out{};
  for (std::size_t i = 0; i < size; ++i) out[i] = channel.values[first + i];
  return out;
}

Row spline(const AssetChannel& channel, const KeySpan& span) {
  const double t = span.fraction;
  const double t2 = t * t;
  const double t3 = t2 * t;
  const Row v0 = row_at(channel, span.left, key_value);
  const Row b0 = row_at(channel, span.left, out_tangent);
  const Row v1 = row_at(channel, span.right, key_value);
  const Row a1 = row_at(channel, span.right, in_tangent);
  Row out{};
  for (std::size_t i = 0; i < 4; ++i)
    out[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * v0[i] + span.duration_s * (t3 - 2.0 * t2 + t) * b0[i] +
             (3.0 * t2 - 2.0 * t3) * v1[i] + span.duration_s * (t3 - t2) * a1[i];
  return out;
}

Quat to_rotation(const Row& xyzw) { return Quat(xyzw[3], xyzw[0], xyzw[1], xyzw[2]); }
Vec3 to_vector(const Row& xyz) { return Vec3(xyz[0], xyz[1], xyz[2]); }

// A spline may pass through the quaternion 0, which is no rotation. The key before then replaces it.
Quat unit_or_key(const Row& xyzw, const Quat& key) {
  const Quat q = to_rotation(xyzw);
  const double length = std::sqrt(glm::dot(q, q));
  return length > 1e-12 ? q / length : key;
}

bool holds_left_key(const AssetChannel& channel, const KeySpan& span) {
  return span.left == span.right || channel.interpolation == Interpolation::step;
}

// The rotation from a to b, the short way. conj(a) * b has the same angle for all signs of a and b.
SpeedInterval interval(double t0_s, double t1_s, const Quat& a, const Quat& b) {
  return {t0_s, t1_s, rotation_angle(glm::conjugate(a) * b) / (t1_s - t0_s)};
}

Quat key_rotation(const AssetChannel& channel, std::size_t key) {
  return to_rotation(row_at(channel, key, key_value));
}

double mean_distance_s(const std::vector<double>& times_s) {
  const double steps = static_cast<double>(std::max<std::size_t>(times_s.size(), 2) - 1);
  return (times_s.back() - times_s.front()) / steps;
}

// A display's frame, or the mean distance of the keys if that is shorter.
double shown_frame_s(const std::vector<double>& times_s) {
  return std::clamp(mean_distance_s(times_s), kShortestFrame_s, kLongestFrame_s);
}

// A motion that was sampled and written as STEP does not jump: its keys are frames.
bool jumps_between_keys(const AssetChannel& channel) {
  return channel.interpolation == Interpolation::step && mean_distance_s(channel.times_s) > kSparsest_s;
}

// The jump of a STEP channel at the end of an interval, in the frame that shows it.
SpeedInterval shown_jump(const AssetChannel& channel, std::size_t key, double frame_s) {
  const double t1 = channel.times_s[key + 1];
  return interval(t1 - frame_s, t1, sample_rotation(channel, t1 - kNearlyAll * frame_s),
                  key_rotation(channel, key + 1));
}

// The speed in an interval that is shorter than a frame: the faster of the two frames that begin and end with it.
SpeedInterval shown_interval(const AssetChannel& channel, std::size_t key, double frame_s) {
  const double t0 = channel.times_s[key], t1 = channel.times_s[key + 1];
  const SpeedInterval from =
      interval(t0, t0 + frame_s, key_rotation(channel, key), sample_rotation(channel, t0 + frame_s));
  const SpeedInterval upto =
      interval(t1 - frame_s, t1, sample_rotation(channel, t1 - frame_s), key_rotation(channel, key + 1));
  return from.speed_rad_s > upto.speed_rad_s ? from : upto;
}

// Converts a spline from Hermite's form to Bezier's.
BezierTurn bezier_of(const AssetChannel& channel, std::size_t key) {
  const double third_s = (channel.times_s[key + 1] - channel.times_s[key]) / 3.0;
  const Row v0 = row_at(channel, key, key_value), b0 = row_at(channel, key, out_tangent);
  const Row v1 = row_at(channel, key + 1, key_value), a1 = row_at(channel, key + 1, in_tangent);
  BezierTurn out{v0, v0, v1, v1};
  for (std::size_t i = 0; i < 4; ++i) out[1][i] += third_s * b0[i], out[2][i] -= third_s * a1[i];
  return out;
}

// The fastest moment of a spline, with the frame around it. At most half a turn per frame is visible.
SpeedInterval peak_of_spline(const AssetChannel& channel, std::size_t key, double frame_s) {
  const double t0 = channel.times_s[key], t1 = channel.times_s[key + 1];
  const double most_rad_s = kPi / frame_s;
  const SplinePeak peak = fastest_turn(bezier_of(channel, key), most_rad_s * (t1 - t0));
  const double at_s = t0 + peak.fraction * (t1 - t0);
  return {std::max(t0, at_s - 0.5 * frame_s), std::min(t1, at_s + 0.5 * frame_s),
          std::min(peak.turn_rad / (t1 - t0), most_rad_s)};
}

}  // namespace

Quat sample_rotation(const AssetChannel& channel, double t_s) {
  CONTORT_ASSERT(channel.path == ChannelPath::rotation && !channel.times_s.empty());
  const KeySpan span = locate(channel.times_s, t_s);
  const Quat left = to_rotation(row_at(channel, span.left, key_value));
  if (holds_left_key(channel, span)) return left;
  if (channel.interpolation == Interpolation::cubic_spline) return unit_or_key(spline(channel, span), left);
  return slerp_short(left, to_rotation(row_at(channel, span.right, key_value)), span.fraction);
}

Vec3 sample_vector(const AssetChannel& channel, double t_s) {
  CONTORT_ASSERT(channel.path != ChannelPath::rotation && !channel.times_s.empty());
  const KeySpan span = locate(channel.times_s, t_s);
  const Vec3 left = to_vector(row_at(channel, span.left, key_value));
  if (holds_left_key(channel, span)) return left;
  if (channel.interpolation == Interpolation::cubic_spline) return to_vector(spline(channel, span));
  const Vec3 right = to_vector(row_at(channel, span.right, key_value));
  return (1.0 - span.fraction) * left + span.fraction * right;
}

std::vector<Trs> pose(const Asset& asset, const AssetClip& clip, double t_s) {
  std::vector<Trs> out;
  for (const AssetNode& node : asset.nodes) out.push_back(node.rest);
  for (const AssetChannel& channel : clip.channels) {
    Trs& trs = out[static_cast<std::size_t>(channel.node)];
    switch (channel.path) {
      case ChannelPath::translation: trs.translation = sample_vector(channel, t_s); break;
      case ChannelPath::rotation: trs.rotation = sample_rotation(channel, t_s); break;
      case ChannelPath::scale: trs.scale = sample_vector(channel, t_s); break;
    }
  }
  return out;
}

ChannelSpeeds channel_speeds(const AssetClip& clip, int index) {
  const AssetChannel& channel = clip.channels[static_cast<std::size_t>(index)];
  CONTORT_ASSERT(channel.path == ChannelPath::rotation && !channel.times_s.empty());
  const double frame_s = shown_frame_s(channel.times_s);
  ChannelSpeeds out{index, channel.node, jumps_between_keys(channel), {}, {}};
  for (std::size_t key = 0; key + 1 < channel.times_s.size(); ++key) {
    const double t0 = channel.times_s[key], t1 = channel.times_s[key + 1];
    const bool is_shown_whole = t1 - t0 > kNearlyAll * frame_s;
    const SpeedInterval between =
        out.jumps ? shown_jump(channel, key, frame_s)
        : is_shown_whole ? interval(t0, t1, key_rotation(channel, key), key_rotation(channel, key + 1))
                         : shown_interval(channel, key, frame_s);
    out.between_keys.push_back(between);
    if (channel.interpolation == Interpolation::cubic_spline)
      out.within_keys.push_back(is_shown_whole ? peak_of_spline(channel, key, frame_s) : between);
  }
  return out;
}

std::vector<ChannelSpeeds> joint_speeds(const AssetClip& clip) {
  std::vector<ChannelSpeeds> out;
  for (std::size_t i = 0; i < clip.channels.size(); ++i)
    if (clip.channels[i].path == ChannelPath::rotation) out.push_back(channel_speeds(clip, static_cast<int>(i)));
  return out;
}

}  // namespace contort
