#include "generator/dynamics/soft_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kJoltOfArm = 2.0;  // times the acceleration at ease
constexpr double kFirst_s = 0.05;   // the reach of a mean to either side,
constexpr double kGrowth = 1.5;     // which grows where it was too little,
constexpr double kCatchesUp = 4.0;  // reaches of the first mean, in which a late motion is on time again
constexpr double kHurries = 2.5;    // or at least in these
constexpr int kRounds = 6;
constexpr double kFarAway = std::numeric_limits<double>::infinity();

// Works on some joints of a motion, in the frames that it may change.
class Softener {
 public:
  Softener(const Character& character, std::vector<int> joints, double jolt, std::span<const double> easy,
           std::vector<char> may)
      : character_(character),
        jolt_(jolt),
        easy_(easy),
        joints_(std::move(joints)),
        may_(std::move(may)),
        most_(frames_to(may_)),
        reach_(may_.size(), 0.0) {}

  // Answers whether the motion has changed.
  bool soften(Motion& motion) {
    if (!widen(motion)) return false;
    const Motion given = motion;
    for (int round = 0; round < kRounds; ++round) {
      write(given, motion);
      if (!widen(motion)) break;
    }
    return true;
  }

 private:
  // By frame: the distance to the nearest frame that may not change. Means reach no farther, so that they end there
  // without a jump.
  static std::vector<double> frames_to(std::span<const char> may) {
    std::vector<double> out(may.size(), kFarAway);
    double since = kFarAway, until = kFarAway;
    for (std::size_t f = 0; f < may.size(); ++f) {
      const std::size_t back = may.size() - 1 - f;
      out[f] = std::min(out[f], since = may[f] != 0 ? since + 1.0 : 0.0);
      out[back] = std::min(out[back], until = may[back] != 0 ? until + 1.0 : 0.0);
    }
    return out;
  }

  // Widens means around jolts. Answers whether there are any.
  bool widen(const Motion& motion) {
    const std::vector<double> before = reach_;
    for (int f = 1; f + 1 < motion.frame_count; ++f)
      if (may_[at(f)] != 0 && has_jolt(motion, f)) widen_around(f, before[at(f)], motion.rate_hz);
    return reach_ != before;
  }

  void write(const Motion& given, Motion& motion) const {
    const double catches_up = frames_to_catch_up();
    for (int f = 0; f < motion.frame_count; ++f) {
      const double late = catches_up > 0.0 ? lateness(f / catches_up) : 0.0;
      if ((reach_[at(f)] > 0.0 || late > 0.0) && may_[at(f)] != 0)
        for (const int j : joints_) put_mean(character_.joint(j), f, late, given, motion);
    }
  }

  // A mean in frame 0 would take joints on their way already. The motion begins later by the reach of that mean, at
  // rest, and catches up.
  double frames_to_catch_up() const {
    const auto end = std::ranges::find(may_, 0) - may_.begin();
    const double frames = std::min(kCatchesUp * reach_[0], static_cast<double>(end));
    return frames >= kHurries * reach_[0] ? frames : 0.0;
  }
  double lateness(double share) const {
    const double left = std::max(0.0, 1.0 - share);
    return reach_[0] * left * left;
  }

  bool has_jolt(const Motion& motion, int frame) const {
    return std::ranges::any_of(joints_,
                               [&](int j) { return length(acceleration(motion, j, frame)) > jolt_ * easy_[at(j)]; });
  }

  Vec3 acceleration(const Motion& motion, int j, int frame) const {
    const Joint& joint = character_.joint(j);
    const auto step = [&](int f) {
      return joint_way_vector(joint, &motion.row(f)[at(joint.coord)], &motion.row(f + 1)[at(joint.coord)]);
    };
    return motion.rate_hz * motion.rate_hz * (step(frame) - step(frame - 1));
  }

  // The frames whose means the frame's acceleration depends on, and, fading, those beside.
  void widen_around(int frame, double before, double rate_hz) {
    const double wide = std::min(std::max(kGrowth * before, kFirst_s * rate_hz), kWidestMean_s * rate_hz);
    const int far = static_cast<int>(std::ceil(2.0 * wide)), last = static_cast<int>(reach_.size()) - 1;
    for (int g = std::max(0, frame - far); g <= std::min(last, frame + far); ++g) {
      const double fades = std::clamp(2.0 - std::abs(g - frame) / wide, 0.0, 1.0);
      reach_[at(g)] = std::max(reach_[at(g)], std::min(fades * wide, most_[at(g)]));
    }
  }

  // The mean of the joint over the reach around a time before the frame. Before the first frame and after the last the
  // joint rests.
  void put_mean(const Joint& joint, int frame, double late, const Motion& given, Motion& motion) const {
    const auto first = at(joint.coord), size = at(coord_size(joint.kind));
    std::array<double, 4> sum{};
    double weights = 0.0;
    const double reach = reach_[at(frame)], center = frame - late;
    const auto row = [&](int f) { return &given.row(std::clamp(f, 0, given.frame_count - 1))[first]; };
    const double* own = row(static_cast<int>(std::floor(center)));
    for (int f = static_cast<int>(std::floor(center - reach)); f <= static_cast<int>(std::ceil(center + reach)); ++f) {
      const double away = (f - center) / (reach + 1.0), room = std::max(0.0, 1.0 - away * away), weight = room * room;
      const double sign = joint.kind == JointKind::ball && dot(own, row(f)) < 0.0 ? -1.0 : 1.0;
      for (std::size_t i = 0; i < size; ++i) sum[i] += sign * weight * row(f)[i];
      weights += weight;
    }
    if (joint.kind == JointKind::ball) weights = std::sqrt(dot(sum.data(), sum.data()));
    for (std::size_t i = 0; i < size; ++i) motion.row(frame)[first + i] = sum[i] / weights;
  }

  // The dot product of two quaternions; below 0, one of them is on the far side. Its negative is the same rotation.
  static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

  const Character& character_;
  const double jolt_;  // times the acceleration at ease
  const std::span<const double> easy_;
  const std::vector<int> joints_;
  const std::vector<char> may_;    // by frame
  const std::vector<double> most_;  // by frame: frames_to
  std::vector<double> reach_;    // by frame: of its mean to either side, frames
};

std::vector<int> joints_of_no_leg(const Character& character, std::span<const Leg> legs) {
  std::vector<int> out;
  for (int j = 0; j < static_cast<int>(character.joints().size()); ++j) {
    const auto has_joint = [&](const Leg& leg) { return std::ranges::find(leg.joints, j) != leg.joints.end(); };
    if (character.joint(j).kind != JointKind::root && std::ranges::none_of(legs, has_joint)) out.push_back(j);
  }
  return out;
}

}  // namespace

bool soften_joints(const Character& character, std::vector<int> joints, double jolt, std::span<const double> easy,
                   std::vector<char> may, Motion& motion) {
  return Softener(character, std::move(joints), jolt, easy, std::move(may)).soften(motion);
}

bool soften_joints(const Character& character, std::span<const Leg> legs, std::span<const double> easy,
                   Motion& motion) {
  std::vector<char> always(at(motion.frame_count), 1);
  return soften_joints(character, joints_of_no_leg(character, legs), kJoltOfArm, easy, std::move(always), motion);
}

}  // namespace contort
