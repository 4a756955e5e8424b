#include "generator/dynamics/soft_joints.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/standing_feet.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kJolt = 2.0;       // times the easy acceleration
constexpr double kFirst_s = 0.05;   // the reach of a mean to either side,
constexpr double kGrowth = 1.5;     // which grows where it was too little,
constexpr double kWidest_s = 0.35;  // but not beyond this
constexpr int kRounds = 6;

// Works on some joints of a motion, in the frames that it may change.
class Softener {
 public:
  Softener(const Character& character, std::vector<int> joints, std::span<const double> easy, std::vector<char> may)
      : character_(character),
        easy_(easy),
        joints_(std::move(joints)),
        may_(std::move(may)),
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
  // Widens means around jolts. Answers whether there are any.
  bool widen(const Motion& motion) {
    const std::vector<double> before = reach_;
    for (int f = 1; f + 1 < motion.frame_count; ++f)
      if (may_[at(f)] != 0 && has_jolt(motion, f)) widen_around(f, before[at(f)], motion.rate_hz);
    return reach_ != before;
  }

  void write(const Motion& given, Motion& motion) const {
    for (int f = 0; f < motion.frame_count; ++f)
      if (reach_[at(f)] > 0.0 && may_[at(f)] != 0)
        for (const int j : joints_) put_mean(character_.joint(j), f, given, motion);
  }

  bool has_jolt(const Motion& motion, int frame) const {
    return std::ranges::any_of(joints_,
                               [&](int j) { return length(acceleration(motion, j, frame)) > kJolt * easy_[at(j)]; });
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
    const double wide = std::min(std::max(kGrowth * before, kFirst_s * rate_hz), kWidest_s * rate_hz);
    const int far = static_cast<int>(std::ceil(2.0 * wide)), last = static_cast<int>(reach_.size()) - 1;
    for (int g = std::max(0, frame - far); g <= std::min(last, frame + far); ++g) {
      const double fades = std::clamp(2.0 - std::abs(g - frame) / wide, 0.0, 1.0);
      reach_[at(g)] = std::max(reach_[at(g)], fades * wide);
    }
  }

  // The mean of the joint over the reach of a frame. Before the first frame and after the last the joint rests.
  void put_mean(const Joint& joint, int frame, const Motion& given, Motion& motion) const {
    const auto first = at(joint.coord), size = at(coord_size(joint.kind));
    std::array<double, 4> sum{};
    double weights = 0.0;
    const double* own = &given.row(frame)[first];
    const int reach = static_cast<int>(reach_[at(frame)]);
    for (int k = -reach; k <= reach; ++k) {
      const double away = k / (reach_[at(frame)] + 1.0), weight = (1.0 - away * away) * (1.0 - away * away);
      const double* row = &given.row(std::clamp(frame + k, 0, given.frame_count - 1))[first];
      const double sign = joint.kind == JointKind::ball && dot(own, row) < 0.0 ? -1.0 : 1.0;
      for (std::size_t i = 0; i < size; ++i) sum[i] += sign * weight * row[i];
      weights += weight;
    }
    if (joint.kind == JointKind::ball) weights = std::sqrt(dot(sum.data(), sum.data()));
    for (std::size_t i = 0; i < size; ++i) motion.row(frame)[first + i] = sum[i] / weights;
  }

  // The dot product of two quaternions; below 0, one of them is on the far side. Its negative is the same rotation.
  static double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

  const Character& character_;
  const std::span<const double> easy_;
  const std::vector<int> joints_;
  const std::vector<char> may_;  // by frame
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

// By frame: all that carries the leg rests, as long as means reach.
std::vector<char> carrier_rests(const Character& character, const Leg& leg, const Motion& motion) {
  std::vector<char> rests(at(motion.frame_count), 1);
  const int wide = static_cast<int>(std::ceil(kWidest_s * motion.rate_hz)) + 1;
  const auto moves = [&](int f) {
    if (!(motion.root[at(f)] == motion.root[at(f - 1)])) return true;
    for (int j = character.joint(leg.joints.front()).parent; j > 0; j = character.joint(j).parent) {
      const Joint& joint = character.joint(j);
      if (length(joint_way_vector(joint, &motion.row(f - 1)[at(joint.coord)], &motion.row(f)[at(joint.coord)])) > 0.0)
        return true;
    }
    return false;
  };
  for (int f = 1; f < motion.frame_count; ++f)
    if (moves(f))
      std::fill(rests.begin() + std::max(0, f - wide), rests.begin() + std::min(motion.frame_count, f + wide), 0);
  return rests;
}

// A foot that an action moves along the ground, or into it, is lifted: ground under a figure with mass holds it. It
// stands where `first`, the given pose of frame 0, has it: a leg that is softened may be on its way in that frame.
void lift_foot(const Character& character, std::span<const Leg> legs, std::size_t leg, const Environment& environment,
               std::span<const char> may, std::span<const double> first, Motion& motion) {
  StandingFeet feet;
  feet.begin(character, legs, environment);
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, motion.root[0], first, world);
  feet.note(leg, LegUse::placed, world);
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    if (may[at(f)] != 0) feet.lift(leg, world, motion.row(f));
    feet.note(leg, may[at(f)] != 0 ? LegUse::acts : LegUse::placed, world);
  }
}

}  // namespace

bool soften_joints(const Character& character, std::span<const Leg> legs, std::span<const double> easy,
                   Motion& motion) {
  std::vector<char> always(at(motion.frame_count), 1);
  return Softener(character, joints_of_no_leg(character, legs), easy, std::move(always)).soften(motion);
}

void soften_legs(const Character& character, std::span<const Leg> legs, const Environment& environment,
                 std::span<const double> easy, Motion& motion) {
  const std::vector<double> first(motion.row(0).begin(), motion.row(0).end());
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const std::vector<char> rests = carrier_rests(character, legs[i], motion);
    Softener(character, legs[i].joints, easy, rests).soften(motion);
    lift_foot(character, legs, i, environment, rests, first, motion);
  }
}

}  // namespace contort
