#include "generator/motion/stand_on.h"

#include <algorithm>

#include "generator/motion/foot_roll.h"
#include "generator/motion/joint_clamp.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kStands_m = 1e-3;  // a sole that is missed by less is reached

// Returns true if an ankle keeps its reserve, as far as its range has room for it.
bool keeps_reserve(const Joint& ankle, double reserve_rad, std::span<const double> row) {
  if (ankle.kind != JointKind::hinge || 2.0 * reserve_rad >= ankle.high - ankle.low) return true;
  const double angle = row[at(ankle.coord)];
  return angle >= ankle.low + reserve_rad && angle <= ankle.high - reserve_rad;
}

bool fits(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& sole,
          std::span<double> row) {
  place_foot(character, leg, world, sole, row);
  forward_kinematics(character, row, leg.joints, world);
  const double missed_m = length(world_from_socket(character, world, leg.sole).p_m - sole.p_m);
  const auto ankles = std::span(leg.ankles).first(at(leg.ankle_count));
  return missed_m <= kStands_m &&
         std::ranges::all_of(leg.joints, [&](int j) { return is_in_range(character.joint(j), row); }) &&
         std::ranges::all_of(ankles, [&](int j) {
           return keeps_reserve(character.joint(j), leg.ankle_reserve_rad, row);
         });
}

// Tries angles in steps of 0.1 rad, and answers the smallest one up to the first for which `is_good` is true; negative
// if it is true for none.
template <class Good>
double least_angle(Good is_good) {
  constexpr double kStep_rad = 0.1, kMost_rad = 1.2;
  constexpr int kAngleHalvings = 28;
  double high = kStep_rad;
  while (high <= kMost_rad && !is_good(high)) high += kStep_rad;
  if (high > kMost_rad) return -1.0;
  double low = high - kStep_rad;
  for (int i = 0; i < kAngleHalvings; ++i) (is_good(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return high;
}

// The longest time that a joint takes from one row to another at its greatest speed.
double slowest_s(const Character& character, std::span<const Leg> legs, std::span<const double> from,
                 std::span<const double> to) {
  double longest = 0.0;
  for (const Leg& leg : legs)
    for (const int j : leg.joints) {
      const Joint& joint = character.joint(j);
      const double way = joint_way(joint, from.data() + joint.coord, to.data() + joint.coord);
      longest = std::max(longest, way / joint.max_speed);
    }
  return longest;
}

bool has_room(LimbRoom& room, std::span<const Rigid> world) {
  room.begin_frame(world);
  return std::ranges::all_of(room.limbs(), [&](const Limb& limb) {
    return room.has_room(at(limb.parts.back()), world);
  });
}

// Legs that bend from stop to stop, and the joint that needs the most time for it.
class BendTrial {
 public:
  BendTrial(const Character& character, LimbRoom& room, const Bend& bend, std::span<const Rigid> world,
            const TrialSpace& scratch, std::span<double> row)
      : character_(character), room_(room), bend_(bend), world_(world), scratch_(scratch), row_(row) {}

  void begin() {
    bend_to(0.0);
    needs_room_ = has_room(room_, scratch_.world);
    keep_row();
  }

  // From one share of the way to the next; false where legs do not fit, or a limb loses its room.
  bool go_on(double from, double to) {
    const bool fits = bend_to(to);
    double way_s = slowest_to_here_s() / (to - from);
    // Heels that begin to rise can do so at once, which a long step does not show.
    if (from > 0.0 && way_s > kHurry * slowest_s_per_way_) way_s = slowest_of_short_steps_s(from, to);
    keep_row();
    slowest_s_per_way_ = std::max(slowest_s_per_way_, way_s);
    return fits && (!needs_room_ || has_room(room_, scratch_.world));
  }

  // The time that the slowest joint would need for the whole way, at the rate of the steepest part so far.
  double slowest_s_per_way() const { return slowest_s_per_way_; }

 private:
  static constexpr double kHurry = 2.0;  // times the rate before

  bool bend_to(double share) {
    return stand_bent(character_, room_.feet().legs(), bend_.frame_at(share), world_, scratch_.world, row_);
  }
  double slowest_to_here_s() const { return slowest_s(character_, room_.feet().legs(), scratch_.row, row_); }
  void keep_row() { std::ranges::copy(row_, scratch_.row.begin()); }

  // As slowest_s_per_way(), for short steps between two shares.
  double slowest_of_short_steps_s(double from, double to) {
    constexpr int kSteps = 8;
    const double step = (to - from) / kSteps;
    double slowest_s_per_way = 0.0;
    for (int n = 1; n <= kSteps; ++n) {
      bend_to(from + n * step);
      slowest_s_per_way = std::max(slowest_s_per_way, slowest_to_here_s() / step);
      keep_row();
    }
    return slowest_s_per_way;
  }

  const Character& character_;
  LimbRoom& room_;
  const Bend& bend_;
  std::span<const Rigid> world_;
  const TrialSpace& scratch_;
  std::span<double> row_;
  bool needs_room_ = true;
  double slowest_s_per_way_ = 0.0;
};

}  // namespace

Stood stand_on(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& world_from_sole,
               std::span<double> row) {
  const auto risen = [&](double angle_rad) { return world_from_sole * rolled_sole(leg, angle_rad, 0.0); };
  const auto is_good = [&](double angle_rad) { return fits(character, leg, world, risen(angle_rad), row); };
  if (is_good(0.0)) return {world_from_sole, true};
  const double angle_rad = least_angle(is_good);
  const Rigid sole = angle_rad > 0.0 ? risen(angle_rad) : world_from_sole;
  return {sole, fits(character, leg, world, sole, row)};
}

bool stand_bent(const Character& character, std::span<const Leg> legs, const GaitFrame& frame,
                std::span<const Rigid> world, std::span<Rigid> scratch, std::span<double> row) {
  const Rigid moved = frame.root * inverse(world[0]);
  std::ranges::transform(world, scratch.begin(), [&](const Rigid& joint) { return moved * joint; });
  bool all_fit = true;
  for (std::size_t i = 0; i < legs.size(); ++i)
    all_fit = stand_on(character, legs[i], scratch, frame.feet[i].world_from_sole, row).fits && all_fit;
  return all_fit;
}

double deepest_bend(const Character& character, LimbRoom& room, const Bend& bend, std::span<const Rigid> world,
                    const TrialSpace& scratch, std::span<double> row) {
  constexpr int kStops = 24;
  constexpr double kShareOfSpeed = 0.8;
  BendTrial trial(character, room, bend, world, scratch, row);
  trial.begin();
  for (int n = 1; n <= kStops; ++n) {
    const double last = static_cast<double>(n - 1) / kStops, share = static_cast<double>(n) / kStops;
    const bool fits = trial.go_on(last, share);
    const bool is_fast = share * bend.peak * trial.slowest_s_per_way() > kShareOfSpeed * bend.takes_s;
    if (!fits || is_fast) return last;
  }
  return 1.0;
}

}  // namespace contort
