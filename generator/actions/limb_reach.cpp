#include "generator/actions/limb_reach.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "generator/motion/ik.h"
#include "generator/motion/joint_clamp.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kReached_m = 1e-4;
constexpr int kTravelHalvings = 20;

std::size_t index_in(const Character& character, const Part& part) {
  return static_cast<std::size_t>(&part - character.parts().data());
}

// The part as in the posture, and what it carries as at rest: that is moved later in the frame.
void place_limb(const RuleInput& in, const Posture& posture) {
  const int end = in.part.first_joint + in.part.joint_count;
  forward_kinematics(in.character, posture.coords, in.part.first_joint, end, in.world);
  for (const int j : in.room.limb_of(index_in(in.character, in.part)).joints)
    if (j >= end) forward_kinematics(in.character, in.character.rest_coords(), j, j + 1, in.world);
}

// The excess of the part's joints over their ranges, in shares of half of the range.
double excess(const RuleInput& in, const Posture& posture) {
  double sum = 0.0;
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j) {
    const Joint& joint = in.character.joint(j);
    sum += std::max(0.0, -normalised_margin(joint, posture.coords.data() + joint.coord));
  }
  return sum;
}

// The greatest turn of one joint away from where the action found it, rad.
double way_rad(const RuleInput& in, const Posture& posture) {
  double most = 0.0;
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j) {
    const Joint& joint = in.character.joint(j);
    if (joint.kind == JointKind::prismatic) continue;
    most = std::max(most, joint_way(joint, in.from.coords.data() + joint.coord, posture.coords.data() + joint.coord));
  }
  return most;
}

// The sine of the elbow's height over the shoulder; 0 of limbs that do not reach.
double elbow_height(const RuleInput& in) {
  if (in.part.reach.empty()) return 0.0;
  const ReachChain& chain = in.part.reach.front();
  const Vec3 upper = in.world[at(chain.upper)].p_m, middle = in.world[at(chain.middle)].p_m;
  return (middle.y - upper.y) / std::max(1e-6, length(middle - upper));
}

// The cost of joints out of range and of bodies too near; 0 where there are none. The limb is placed.
double cost_of_faults(const RuleInput& in, const Posture& posture) {
  const double room_m = in.room.room_m(index_in(in.character, in.part), in.world, {.high_m = -kTooNear_m});
  const double too_near = room_m < -kTooNear_m ? 4.0 - 400.0 * room_m : 0.0;
  return 40.0 * excess(in, posture) + too_near;
}

// The cost of an elbow that is held high and of a long way from where the action found the part. The limb is placed.
double cost_of_discomfort(const RuleInput& in, const Posture& posture) {
  return 0.4 * elbow_height(in) + 0.2 * way_rad(in, posture);
}

// The swivel, rad, of the posture without faults that is nearest to the wish, or most comfortable if no wish is given.
double choose_swivel(const RuleInput& in, const ReachChain& chain, const Vec3& target, std::optional<double> wish_rad,
                     Posture& posture) {
  constexpr double kOfWish = 0.1;  // so that no wish outweighs a fault
  const double first = wish_rad.value_or(0.0);
  return first + cheapest_swivel(in.part.side, [&](double off) {
           reach_for(in.character, chain, in.world, target, first + off, posture.coords);
           place_limb(in, posture);
           const double faults = cost_of_faults(in, posture);
           return faults + (wish_rad ? kOfWish * std::fabs(off) : cost_of_discomfort(in, posture));
         });
}

double missing_m(const RuleInput& in, const ReachChain& chain, const Vec3& target, const Posture& posture) {
  const int last = in.character.sockets()[at(chain.tip)].joint + 1;
  forward_kinematics(in.character, posture.coords, in.part.first_joint, last, in.world);
  return length(target - world_from_socket(in.character, in.world, chain.tip).p_m);
}

// Returns true if the target is farther from the shoulder than the tip, which is placed: one that is too near is not
// reached by travels, which only lengthen the limb.
bool is_too_short(const RuleInput& in, const ReachChain& chain, const Vec3& target) {
  const Vec3 upper = in.world[at(chain.upper)].p_m;
  return length(target - upper) > length(world_from_socket(in.character, in.world, chain.tip).p_m - upper);
}

// Puts every travel of the part at this share of its range, and reaches.
double reach_at(const RuleInput& in, const ReachChain& chain, const Vec3& target, double share, Posture& posture) {
  for (int j = in.part.first_joint; j < in.part.first_joint + in.part.joint_count; ++j)
    if (const Joint& joint = in.character.joint(j); joint.kind == JointKind::prismatic)
      posture.coords[at(joint.coord)] = joint.low + share * (joint.high - joint.low);
  reach_for(in.character, chain, in.world, target, in.body.swivel_rad, posture.coords);
  return missing_m(in, chain, target, posture);
}

bool has_travels(const RuleInput& in) {
  const std::span<const Joint> own = in.character.joints().subspan(at(in.part.first_joint), at(in.part.joint_count));
  return std::ranges::any_of(own, [](const Joint& joint) { return joint.kind == JointKind::prismatic; });
}

// With travels out as far as they must, whatever the swivel.
double reach_as_far(const RuleInput& in, const ReachChain& chain, const Vec3& target, Posture& posture) {
  reach_for(in.character, chain, in.world, target, in.body.swivel_rad, posture.coords);
  const double missing = missing_m(in, chain, target, posture);
  if (missing < kReached_m || !has_travels(in) || !is_too_short(in, chain, target)) return missing;
  double low = 0.0, high = 1.0;  // the smallest share that reaches without an elbow that bends backwards
  const Joint& elbow = in.character.joint(chain.middle);
  const auto reaches = [&](double share) {
    return reach_at(in, chain, target, share, posture) < kReached_m &&
           normalised_margin(elbow, posture.coords.data() + elbow.coord) >= 0.0;
  };
  if (!reaches(high)) return missing_m(in, chain, target, posture);
  for (int i = 0; i < kTravelHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (reaches(middle) ? high : low) = middle;
  }
  return reach_at(in, chain, target, high, posture);
}

}  // namespace

double cheapest_swivel(Side side, FunctionRef<double(double swivel_rad)> cost) {
  constexpr int kSwivels = 24;  // 15 degrees apart
  constexpr double kBetter = 0.01;
  const double outward = side == Side::right ? -1.0 : 1.0;
  double best = 0.0, least = 1e30;
  for (int i = 0; i < kSwivels; ++i) {
    const double swivel = outward * 2.0 * kPi * (i % 2 == 1 ? (i + 1) / 2 : -i / 2) / kSwivels;
    if (const double now = cost(swivel); now < least - kBetter) least = now, best = swivel;
  }
  for (double step = kPi / kSwivels; step > 0.4 * kPi / kSwivels; step *= 0.5) {
    const double middle = best;
    for (const double swivel : {middle + outward * step, middle - outward * step})
      if (const double now = cost(swivel); now < least - kBetter) least = now, best = swivel;
  }
  return best;
}

double cost_of_placed(const RuleInput& in, const Posture& posture) {
  return cost_of_faults(in, posture) + cost_of_discomfort(in, posture);
}

double reach_with_travels(const RuleInput& in, const ReachChain& chain, const Vec3& target_world_m,
                          std::optional<double> swivel_rad, Posture& posture) {
  const bool begins = in.body.begun != in.took_over;
  if (begins) in.body.swivel_rad = swivel_rad.value_or(0.0), in.body.begun = in.took_over;
  const double missing = reach_as_far(in, chain, target_world_m, posture);
  if (!begins) return missing;
  in.body.swivel_rad = choose_swivel(in, chain, target_world_m, swivel_rad, posture);
  reach_for(in.character, chain, in.world, target_world_m, in.body.swivel_rad, posture.coords);
  return missing_m(in, chain, target_world_m, posture);
}

double follow_with_travels(const RuleInput& in, const ReachChain& chain, const Vec3& target_world_m, Posture& posture) {
  constexpr double kMoved_m = 0.03;
  constexpr double kTurns_rad_s = 150.0 * kRadPerDeg;
  WholeBody& body = in.body;
  const bool begins = body.begun != in.took_over;
  const Vec3 local_m = inverse(in.world[at(in.character.joint(chain.upper).parent)]) * target_world_m;
  reach_with_travels(in, chain, target_world_m, std::nullopt, posture);
  if (begins) {
    body.wanted_swivel_rad = body.swivel_rad, body.swivel_chosen_for_m = local_m;
  } else if (std::exchange(body.chooses_swivel, false) || length(local_m - body.swivel_chosen_for_m) > kMoved_m) {
    body.wanted_swivel_rad = choose_swivel(in, chain, target_world_m, std::nullopt, posture);
    body.swivel_chosen_for_m = local_m;
  }
  const double most_rad = kTurns_rad_s * in.time.frame_s;
  body.swivel_rad += std::clamp(wrap_angle(body.wanted_swivel_rad - body.swivel_rad), -most_rad, most_rad);
  return reach_as_far(in, chain, target_world_m, posture);
}

}  // namespace contort
