#include "model/asset/sample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "model/core/assert.h"

namespace contort {

namespace {

using Row = std::array<double, 4>;  // The last one is unused in vectors.

constexpr int kSplineParts = 8;
// Turns smaller than this are the rounding of 32-bit quaternions (about 3e-7 rad), not motion.
constexpr double kSameRotation_rad = 1e-6;

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

// A row of a spline's key, or the only row of another's.
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

// A spline may pass through the quaternion 0, which is no rotation; the key before stands in for it.
Quat unit_or_key(const Row& xyzw, const Quat& key) {
  const Quat q = to_rotation(xyzw);
  const double length = std::sqrt(glm::dot(q, q));
  return length > 1e-12 ? q / length : key;
}

bool holds_left_key(const AssetChannel& channel, const KeySpan& span) {
  return span.left == span.right || channel.interpolation == Interpolation::step;
}

// From a to b, the short way. conj(a) * b has the angle whatever the signs of a and b are.
SpeedInterval interval(double t0_s, double t1_s, const Quat& a, const Quat& b) {
  const double angle = rotation_angle(glm::conjugate(a) * b);
  const double duration = t1_s - t0_s;
  if (duration > 0.0) return {t0_s, t1_s, angle / duration};
  return {t0_s, t1_s, angle > kSameRotation_rad ? std::numeric_limits<double>::infinity() : 0.0};
}

void add_spline_parts(const AssetChannel& channel, std::size_t key, std::vector<SpeedInterval>& out) {
  const double t0 = channel.times_s[key];
  const double duration = channel.times_s[key + 1] - t0;
  if (!(duration > 0.0)) return;
  Quat before = to_rotation(row_at(channel, key, key_value));
  double before_s = t0;
  for (int part = 1; part <= kSplineParts; ++part) {
    const double fraction = static_cast<double>(part) / kSplineParts;
    const Quat left = to_rotation(row_at(channel, key, key_value));
    const Quat here = unit_or_key(spline(channel, {key, key + 1, duration, fraction}), left);
    const double here_s = t0 + duration * fraction;
    out.push_back(interval(before_s, here_s, before, here));
    before = here;
    before_s = here_s;
  }
}

ChannelSpeeds channel_speeds(const AssetChannel& channel, int index) {
  ChannelSpeeds out{index, channel.node, {}, {}};
  for (std::size_t key = 0; key + 1 < channel.times_s.size(); ++key) {
    out.between_keys.push_back(interval(channel.times_s[key], channel.times_s[key + 1],
                                        to_rotation(row_at(channel, key, key_value)),
                                        to_rotation(row_at(channel, key + 1, key_value))));
    if (channel.interpolation == Interpolation::cubic_spline) add_spline_parts(channel, key, out.within_keys);
  }
  return out;
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

std::vector<ChannelSpeeds> joint_speeds(const AssetClip& clip) {
  std::vector<ChannelSpeeds> out;
  for (std::size_t i = 0; i < clip.channels.size(); ++i)
    if (clip.channels[i].path == ChannelPath::rotation)
      out.push_back(channel_speeds(clip.channels[i], static_cast<int>(i)));
  return out;
}

}  // namespace contort
