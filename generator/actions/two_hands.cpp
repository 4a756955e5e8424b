#include "generator/actions/two_hands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/actions/hand.h"
#include "generator/actions/limb_reach.h"
#include "generator/motion/ik.h"
#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kGreatestShare = 0.97;  // of its reach, to which an arm is stretched

const Part& second_arm(const RuleInput& in) { return in.character.parts()[at(in.aim->second.arm)]; }

// The other arm may not have been placed in this frame; what carries it has.
Vec3 second_shoulder_m(const RuleInput& in) {
  const Joint& upper = in.character.joint(second_arm(in).reach.front().upper);
  return (in.world[at(upper.parent)] * upper.parent_from_joint).p_m;
}

double share_of_reach(const RuleInput& in) {
  const Vec3 point_m = world_from_socket(in.character, in.world, in.aim->second.point).p_m;
  return length(point_m - second_shoulder_m(in)) / in.aim->second.reach_m;
}

// Puts the joints of a limb in the world back when it goes.
class KeptWorld {
 public:
  KeptWorld(std::span<Rigid> world, const std::vector<int>& joints) : world_(world), joints_(joints) {
    for (std::size_t i = 0; i < count(); ++i) kept_[i] = world_[at(joints_[i])];
  }
  ~KeptWorld() {
    for (std::size_t i = 0; i < count(); ++i) world_[at(joints_[i])] = kept_[i];
  }
  KeptWorld(const KeptWorld&) = delete;
  KeptWorld& operator=(const KeptWorld&) = delete;

 private:
  std::size_t count() const { return std::min(joints_.size(), kept_.size()); }

  std::span<Rigid> world_;
  const std::vector<int>& joints_;
  std::array<Rigid, 2 * kMaxAimJoints> kept_;
};

double excess_of(const RuleInput& in, const Limb& limb, const Posture& posture) {
  double sum = 0.0;
  for (const int j : limb.joints)
    sum += std::max(0.0, -normalised_margin(in.character.joint(j), posture.coords.data() + in.character.joint(j).coord));
  return sum;
}

}  // namespace

double awkwardness_of_two_hands(const RuleInput& in) {
  const Rigid point = world_from_socket(in.character, in.world, in.aim->chain.socket);
  const Vec3 shoulder = in.world[at(in.aim->chain.joints.front())].p_m;
  const double beside_m = length(cross(point.q * Vec3(0, 0, 1), shoulder - point.p_m));
  const double lean = 1.0 - (point.q * Vec3(0, 1, 0)).y;
  const ReachChain& chain = in.part.reach.front();
  const double elbow_m = in.world[at(chain.middle)].p_m.y;
  const double grip_m = world_from_socket(in.character, in.world, chain.tip).p_m.y;
  const double raised_m = std::max(0.0, std::max(elbow_m, grip_m) - shoulder.y);
  return 4.0 * beside_m + lean + 4.0 * raised_m + 3.0 * std::fabs(share_of_reach(in) - 0.75);
}

double fault_of_second_hand(const RuleInput& in, Posture& posture) {
  const double share = share_of_reach(in);
  if (share > kGreatestShare) return 10.0 + share;
  const Part& arm = second_arm(in);
  const Limb& limb = in.room.limb_of(at(in.aim->second.arm));
  if (limb.joints.size() > 2 * kMaxAimJoints) return 10.0;
  const KeptWorld kept(in.world, limb.joints);
  for (const int part : limb.parts) rest_part(in.character, in.character.parts()[at(part)], posture);
  ReachChain chain = arm.reach.front();
  chain.tip = grip_of(in.character, arm);
  const Vec3 point_m = world_from_socket(in.character, in.world, in.aim->second.point).p_m;
  const HeldObject held = held_object(in.character, in.aim->second.arm, in.aim->second.point);
  double least = 1e30;
  cheapest_swivel(arm.side, [&](double swivel_rad) {
    reach_for(in.character, chain, in.world, point_m, swivel_rad, posture.coords);
    forward_kinematics(in.character, posture.coords, limb.joints, in.world);
    const double lacks_m = std::max(0.0, -kTooNear_m - in.room.room_beside_m(at(in.aim->second.arm), held, in.world));
    const double fault = 10.0 * excess_of(in, limb, posture) + 100.0 * lacks_m;
    least = std::min(least, fault);
    return fault;
  });
  return least;
}

}  // namespace contort
