#include "generator/dynamics/soft_legs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "generator/dynamics/leg_fit.h"
#include "generator/dynamics/soft_joints.h"
#include "generator/motion/standing_feet.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kLeastGap_m = 0.0005;
constexpr double kSmaller = 0.8;  // of its size: a lift that leads through a body
constexpr int kTimesSmaller = 12;
constexpr double kJolt = 1.0;  // times the acceleration at ease; the other leg bears the figure meanwhile
constexpr int kLifts = 3;      // softened and lifted again: a lift has jolts of its own

// By frame: all that carries the leg rests, and has rested for as long as means reach, because a foot may still land at
// the end of a course.
std::vector<char> carrier_rests(const Character& character, const Leg& leg, const Motion& motion) {
  std::vector<char> rests(at(motion.frame_count), 1);
  const int wide = static_cast<int>(std::ceil(kWidestMean_s * motion.rate_hz)) + 1;
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
      std::fill(rests.begin() + f - 1, rests.begin() + std::min(motion.frame_count, f + wide), 0);
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

// Frames [first, end) in which a leg moves.
struct LegMove {
  int first = 0;
  int end = 0;
};

// Works on one leg whose motion was softened.
class SoftLeg {
 public:
  SoftLeg(const Character& character, const DynamicFigure& figure, std::span<const Leg> legs, std::size_t leg,
          std::span<const char> may, const Motion& given)
      : character_(character),
        fit_(character, figure, legs),
        leg_(legs[leg]),
        bit_(static_cast<std::uint8_t>(1U << leg)),
        may_(may),
        given_(given) {}

  // Makes the moves smaller that lead through a body although the given motion does not. Returns true if there is any.
  bool make_smaller(Motion& motion) {
    bool any = false;
    for (const LegMove& move : moves(motion)) {
      if (!leads_through(move, motion)) continue;
      shrink(move, motion);
      any = true;
    }
    return any;
  }

 private:
  // A move begins and ends in a frame in which the leg rests, or at an end of the motion.
  std::vector<LegMove> moves(const Motion& motion) const {
    std::vector<LegMove> out;
    for (int f = 1; f < motion.frame_count; ++f) {
      if (may_[at(f)] == 0 || rests(motion, f)) continue;
      if (out.empty() || out.back().end < f) out.push_back({f - 1, f});
      out.back().end = f + 1;
    }
    return out;
  }

  bool rests(const Motion& motion, int frame) const {
    return std::ranges::all_of(leg_.joints, [&](int j) {
      const Joint& joint = character_.joint(j);
      const auto now = motion.row(frame).subspan(at(joint.coord), at(coord_size(joint.kind)));
      return std::ranges::equal(now, motion.row(frame - 1).subspan(at(joint.coord), now.size()));
    });
  }

  bool leads_through(const LegMove& move, const Motion& motion) {
    for (int f = move.first; f < move.end; ++f)
      if (is_near(motion, f, kLeastGap_m) && !is_near(given_, f, 0.0)) return true;
    return false;
  }

  bool is_near(const Motion& motion, int frame, double gap_m) {
    return fit_.is_near(bit_, gap_m, motion.root[at(frame)], motion.row(frame), dynamics_);
  }

  // Brings all frames nearer to the way from the pose before the move to the one after it. In frame 0 the leg may be
  // on its way already, so the given pose counts there.
  void shrink(const LegMove& move, Motion& motion) const {
    const int last = move.end - 1;
    const std::span<const double> before = move.first == 0 ? given_.row(0) : motion.row(move.first);
    const std::vector<double> from(before.begin(), before.end()), to(motion.row(last).begin(), motion.row(last).end());
    std::vector<double> base(from.size());
    for (int f = move.first; f <= last; ++f) {
      const double way = minimum_jerk(static_cast<double>(f - move.first) / std::max(1, last - move.first));
      for (const int j : leg_.joints) {
        const Joint& joint = character_.joint(j);
        const auto k = at(joint.coord);
        blend(joint, &from[k], &to[k], way, &base[k]);
        blend(joint, &base[k], &motion.row(f)[k], kSmaller, &motion.row(f)[k]);
      }
    }
  }

  static void blend(const Joint& joint, const double* a, const double* b, double share, double* out) {
    if (joint.kind != JointKind::ball) {
      out[0] = a[0] + share * (b[0] - a[0]);
      return;
    }
    const Quat q = slerp_short(quat_at(a), quat_at(b), share);
    out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
  }

  const Character& character_;
  LegFit fit_;
  const Leg& leg_;
  const std::uint8_t bit_;
  const std::span<const char> may_;  // by frame
  const Motion& given_;
  DynamicsScratch dynamics_;
};

}  // namespace

void soften_legs(const Character& character, const DynamicFigure& figure, std::span<const Leg> legs,
                 const Environment& environment, std::span<const double> easy, Motion& motion) {
  const Motion given = motion;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const std::vector<char> rests = carrier_rests(character, legs[i], motion);
    for (int round = 0; round < kLifts; ++round) {
      soften_joints(character, legs[i].joints, kJolt, easy, rests, motion);
      lift_foot(character, legs, i, environment, rests, given.row(0), motion);
    }
    SoftLeg soft(character, figure, legs, i, rests, given);
    for (int round = 0; round < kTimesSmaller && soft.make_smaller(motion); ++round)
      lift_foot(character, legs, i, environment, rests, given.row(0), motion);
  }
}

}  // namespace contort
