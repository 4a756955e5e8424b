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

bool fits(const Character& character, const Leg& leg, std::span<Rigid> world, const Rigid& sole,
          std::span<double> row) {
  place_foot(character, leg, world, sole, row);
  for (const int j : leg.joints) forward_kinematics(character, row, j, j + 1, world);
  const double missed_m = length(world_from_socket(character, world, leg.sole).p_m - sole.p_m);
  return missed_m <= kStands_m &&
         std::ranges::all_of(leg.joints, [&](int j) { return is_in_range(character.joint(j), row); });
}

// Tries angles in steps of 0.1 rad, and answers the smallest one up to the first for which `is_good` is true; negative if
// it is true for none.
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

// Whether all legs fit below the frame's root.
bool stand_bent(const Character& character, std::span<const Leg> legs, const GaitFrame& frame,
                std::span<const Rigid> world, std::span<Rigid> scratch, std::span<double> row) {
  const Rigid moved = frame.root * inverse(world[0]);
  std::ranges::transform(world, scratch.begin(), [&](const Rigid& joint) { return moved * joint; });
  bool all_fit = true;
  for (std::size_t i = 0; i < legs.size(); ++i)
    all_fit = stand_on(character, legs[i], scratch, frame.feet[i].world_from_sole, row).fits && all_fit;
  return all_fit;
}

bool has_room(LimbRoom& room, std::span<const Rigid> world) {
  room.begin_frame(world);
  return std::ranges::all_of(room.limbs(), [&](const Limb& limb) {
    return room.room_m(at(limb.parts.back()), world) >= -kTooNear_m;
  });
}

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

double deepest_bend(const Character& character, LimbRoom& room, const Bend& bend, std::span<const Rigid> world,
                    const TrialSpace& scratch, std::span<double> row) {
  constexpr int kStops = 24, kFineStops = 8;  // on the whole way, and between two where joints begin to hurry
  constexpr double kShareOfSpeed = 0.8, kHurry = 2.0;
  const std::span<const Leg> legs = room.feet().legs();
  const std::span<double> before = scratch.row;
  const auto bent_at = [&](double share) {
    return stand_bent(character, legs, bend.frame_at(share), world, scratch.world, row);
  };
  // The longest time that a joint needs for the way from `before` on, in steps to a share: for the whole way at that rate.
  const auto slowest_to = [&](double from, double to, int steps) {
    double longest_s = 0.0;
    for (int n = 1; n <= steps; ++n) {
      bent_at(from + (to - from) * n / steps);
      longest_s = std::max(longest_s, slowest_s(character, legs, before, row) * steps / (to - from));
      std::ranges::copy(row, before.begin());
    }
    return longest_s;
  };
  bent_at(0.0);
  const bool needs_room = has_room(room, scratch.world);
  double slowest_s_per_way = 0.0;
  std::ranges::copy(row, before.begin());
  for (int n = 1; n <= kStops; ++n) {
    const double last = static_cast<double>(n - 1) / kStops, share = static_cast<double>(n) / kStops;
    const bool fits = bent_at(share);
    double way_s = kStops * slowest_s(character, legs, before, row);
    // Heels that begin to rise can do so at once, which a long step does not show.
    if (n > 1 && way_s > kHurry * slowest_s_per_way) way_s = slowest_to(last, share, kFineStops);
    std::ranges::copy(row, before.begin());
    slowest_s_per_way = std::max(slowest_s_per_way, way_s);
    const bool is_fast = share * bend.peak * slowest_s_per_way > kShareOfSpeed * bend.takes_s;
    if (!fits || is_fast || (needs_room && !has_room(room, scratch.world))) return last;
  }
  return 1.0;
}

}  // namespace contort
