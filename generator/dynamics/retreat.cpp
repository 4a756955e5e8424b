#include "generator/dynamics/retreat.h"

#include <algorithm>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kShare = 0.25;       // of the way to standing, at once
constexpr double kNear_s = 0.3;
constexpr double kStays_m = 0.3;     // a root that travels farther within kNear_s to either side is that of a gait
constexpr double kLowest_m = 0.03;    // height that a foot keeps over the ground
constexpr double kLeastSize = 0.02;   // of a lift that can still become smaller

bool any_of(std::span<const char> frames, int first, int end) {
  first = std::max(first, 0), end = std::min(end, static_cast<int>(frames.size()));
  return std::ranges::any_of(frames.subspan(at(first), at(end - first)), [](char one) { return one != 0; });
}

std::vector<char> staying_frames(const Motion& motion, int reach) {
  std::vector<char> stays;
  for (int f = 0, last = motion.frame_count - 1; f <= last; ++f) {
    Vec3 way = motion.root[at(std::min(last, f + reach))].p_m - motion.root[at(std::max(0, f - reach))].p_m;
    way.y = 0.0;
    stays.push_back(length(way) < kStays_m ? 1 : 0);
  }
  return stays;
}

std::vector<int> joints_to_legs(const Character& character, std::span<const Leg> legs) {
  std::vector<int> joints;
  for (const Leg& leg : legs)
    for (int j = character.joint(leg.joints.front()).parent; j > 0; j = character.joint(j).parent)
      if (std::ranges::find(joints, j) == joints.end()) joints.push_back(j);
  return joints;
}

// Brings a joint nearer to its posture at rest, in which all coordinates are 0 and quaternions 1.
void straighten(const Joint& joint, double share, std::span<double> row) {
  double* coords = &row[at(joint.coord)];
  if (joint.kind != JointKind::ball) {
    coords[0] *= 1.0 - share;
    return;
  }
  const Quat nearer = slerp_short(quat_at(coords), Quat(1.0, 0.0, 0.0, 0.0), share);
  coords[0] = nearer.w, coords[1] = nearer.x, coords[2] = nearer.y, coords[3] = nearer.z;
}

}  // namespace

Retreat::Retreat(const Character& character, const ContactPlan& plan, std::span<const Leg> legs, const Motion& motion)
    : character_(character),
      plan_(plan),
      legs_(legs),
      reach_(std::max(1, static_cast<int>(kNear_s * motion.rate_hz))),
      carriers_(joints_to_legs(character, legs)),
      stays_(staying_frames(motion, reach_)) {
  for (const FootLift& one : foot_lifts(plan, static_cast<int>(legs.size())))
    if (!is_begun_step(one)) lifts_.push_back({one});
}

// Returns true for a foot that is in the air at the end of a motion that travels: it would land elsewhere.
bool Retreat::is_begun_step(const FootLift& lift) const {
  const auto last = static_cast<int>(stays_.size()) - 1;
  const std::span<const char> stays = std::span(stays_).subspan(at(lift.first), at(last + 1 - lift.first));
  return lift.last == last && std::ranges::find(stays, 0) != stays.end();
}

bool Retreat::go(std::span<const char> impossible, Motion& motion) {
  const bool lowers = lower(impossible), stands_up = stand_up(impossible, motion);
  return lowers || stands_up;
}

bool Retreat::lower(std::span<const char> impossible) {
  bool any = false;
  for (Lift& lift : lifts_) {
    if (lift.size <= kLeastSize || !any_of(impossible, lift.of.first - reach_, lift.of.last + 1 + reach_)) continue;
    lift.size *= 1.0 - kShare;
    any = true;
  }
  return any;
}

// Changes each stretch as a whole, so that it is as smooth as before; a shorter one is between two steps.
bool Retreat::stand_up(std::span<const char> impossible, Motion& motion) const {
  const int frames = motion.frame_count;
  bool any = false;
  for (int f = 0, end = 0; f < frames; f = end + 1) {
    for (end = f; end < frames && all_bear(end) && stays_[at(end)] != 0;) ++end;
    if (end - f < 2 * reach_ || !any_of(impossible, f, end)) continue;
    any = true;
    for (int g = f; g < end; ++g) {
      const int from_start = f == 0 ? reach_ : g - f, to_end = end == frames ? reach_ : end - 1 - g;
      const double near = std::min(1.0, static_cast<double>(std::min(from_start, to_end)) / reach_);
      stand_up(g, kShare * minimum_jerk(near), motion);
    }
  }
  return any;
}

void Retreat::stand_up(int frame, double share, Motion& motion) const {
  Rigid& root = motion.root[at(frame)];
  const Rigid& rest = character_.rest_root();
  const Vec3 up(0, 1, 0);
  const Quat upright = shortest_arc(root.q * (glm::conjugate(rest.q) * up), up) * root.q;
  root.q = slerp_short(root.q, upright, share);
  root.p_m.y += share * std::max(0.0, ground_m(frame) + rest.p_m.y - root.p_m.y);
  for (const int j : carriers_) straighten(character_.joint(j), share, motion.row(frame));
}

bool Retreat::all_bear(int frame) const {
  for (int sole = 0; sole < static_cast<int>(legs_.size()); ++sole)
    if (plan_.airborne(frame, sole) != 0) return false;
  return true;
}

// The mean height of all soles.
double Retreat::ground_m(int frame) const {
  double sum_m = 0.0;
  for (int sole = 0; sole < static_cast<int>(legs_.size()); ++sole) sum_m += plan_.sole(frame, sole).p_m.y;
  return sum_m / static_cast<double>(std::max<std::size_t>(1, legs_.size()));
}

std::uint8_t Retreat::lifted(int frame) const {
  std::uint8_t soles = 0;
  for (const Lift& lift : lifts_)
    if (lift.of.first <= frame && frame <= lift.of.last) soles |= static_cast<std::uint8_t>(1U << lift.of.sole);
  return soles;
}

namespace {

// Along the ground from place to place, as high as planned but not higher than a foot must be to pass over it: it rises
// and comes down gently, over all of the way.
Rigid lowest(const Rigid& from, const Rigid& to, double share, const Rigid& planned) {
  const double way = minimum_jerk(share), up = 4.0 * share * (1.0 - share);
  Rigid low = part_way(from, to, way);
  low.p_m.y += std::clamp(planned.p_m.y - low.p_m.y, 0.0, kLowest_m * up * up);
  return low;
}

}  // namespace

Rigid Retreat::sole(int frame, int sole) const {
  const Rigid& planned = plan_.sole(frame, sole);
  for (const Lift& lift : lifts_) {
    if (lift.of.sole != sole || lift.size == 1.0 || frame < lift.of.first || frame > lift.of.last) continue;
    const double share = static_cast<double>(frame - lift.of.first + 1) / (lift.of.last - lift.of.first + 2);
    const Rigid low = lowest(lift.of.from, lift.of.to, share, planned);
    return part_way(low, planned, lift.size);
  }
  return planned;
}

}  // namespace contort
