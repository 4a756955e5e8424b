#include "generator/dynamics/foot_lifts.h"

#include <algorithm>

#include "generator/motion/place_foot.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kStep_m = 0.1;  // a foot that lands as far away, or is turned as far, has made a step
constexpr double kStep_rad = 0.1;
constexpr double kBetween_s = 0.35;  // a foot that a blow turns touches the ground between two lifts
constexpr double kStill_m = 0.0005;  // within a frame
constexpr double kStill_rad = 0.003;
constexpr double kInPlace_m = 0.015;  // a foot that comes down as near to where it was may as well have stayed there
constexpr double kInPlace_rad = 0.03;

bool is_step(const Rigid& from, const Rigid& to) {
  return length(to.p_m - from.p_m) > kStep_m || rotation_angle(glm::conjugate(from.q) * to.q) > kStep_rad;
}

void add_lifts(const ContactPlan& plan, int sole, std::vector<FootLift>& lifts) {
  const int frames = plan.frame_count();
  for (int f = 0, last = 0; f < frames; f = last + 1) {
    last = f;
    if (plan.airborne(f, sole) == 0) continue;
    while (last + 1 < frames && plan.airborne(last + 1, sole) != 0) ++last;
    const bool leaves = f > 0, lands = last + 1 < frames;
    const Rigid& from = plan.sole(leaves ? f - 1 : f, sole);
    const Rigid& to = lands ? plan.sole(last + 1, sole) : from;
    if (!is_step(from, to)) lifts.push_back({sole, f, last, from, to});
  }
}

// The time in which a foot is not flat and still on the ground: it is lifted, or a blow turns it where it stands.
struct Unrest {
  FootLift of;
  int airborne = 0;             // frames
  bool stands_before = false;   // in the frame before
};

bool is_still(const ContactPlan& plan, int frame, int sole) {
  const int next = std::min(frame + 1, plan.frame_count() - 1);
  const Rigid &now = plan.sole(frame, sole), &then = plan.sole(next, sole);
  return plan.bearing(frame, sole).corners == kAllCorners && length(then.p_m - now.p_m) < kStill_m &&
         rotation_angle(glm::conjugate(now.q) * then.q) < kStill_rad;
}

// The place where a foot lands after a frame. A foot that is still in the air at the end of the motion counts as coming
// back, unless the figure has walked away meanwhile.
Rigid landing_place(const ContactPlan& plan, const Motion& motion, const FootLift& lift, int frame) {
  if (frame + 1 < plan.frame_count()) return plan.sole(frame + 1, lift.sole);
  const bool leaves = is_step(motion.root[at(std::max(0, lift.first - 1))], motion.root[at(frame)]);
  return leaves ? plan.sole(frame, lift.sole) : lift.from;
}

// Adds the unrest of one sole. Two times of it that follow each other soon count as one.
void add_unrest(const ContactPlan& plan, const Motion& motion, int sole, std::vector<Unrest>& all) {
  const double between = kBetween_s * motion.rate_hz;
  const std::size_t first = all.size();
  for (int f = 0; f < plan.frame_count(); ++f) {
    if (is_still(plan, f, sole)) continue;
    if (all.size() == first || f - all.back().of.last > between) {
      const int before = std::max(0, f - 1);
      all.push_back({{sole, f, f, plan.sole(before, sole), {}}, 0, plan.airborne(before, sole) == 0});
    }
    Unrest& now = all.back();
    now.of.last = f, now.of.to = landing_place(plan, motion, now.of, f);
    now.airborne += plan.airborne(f, sole) != 0 ? 1 : 0;
  }
}

bool overlap(const FootLift& a, const FootLift& b) { return a.first <= b.last && b.first <= a.last; }

bool comes_back(const FootLift& lift) {
  return length(lift.to.p_m - lift.from.p_m) < kInPlace_m &&
         rotation_angle(glm::conjugate(lift.from.q) * lift.to.q) < kInPlace_rad;
}

// A foot that stays goes over to where it will stand, which is nearly the same place.
Rigid place_in(const FootLift& lift, int frame) {
  const double way = minimum_jerk(static_cast<double>(frame - lift.first) / std::max(1, lift.last - lift.first));
  return part_way(lift.from, lift.to, way);
}

// Those that leave too few feet on the ground while another foot is lifted for longer.
std::vector<FootLift> too_many(std::vector<Unrest> all) {
  std::ranges::stable_sort(all, std::ranges::greater(), &Unrest::airborne);
  std::vector<FootLift> kept, left_out;
  for (const Unrest& one : all) {
    const bool stands_alone = std::ranges::any_of(
        kept, [&](const FootLift& other) { return other.sole != one.of.sole && overlap(one.of, other); });
    if (stands_alone && one.stands_before && comes_back(one.of))
      left_out.push_back(one.of);
    else if (one.airborne > 0)
      kept.push_back(one.of);
  }
  return left_out;
}

}  // namespace

std::vector<FootLift> foot_lifts(const ContactPlan& plan, int soles) {
  std::vector<FootLift> lifts;
  for (int sole = 0; sole < soles; ++sole) add_lifts(plan, sole, lifts);
  return lifts;
}

void keep_enough_feet(const Character& character, std::span<const Leg> legs, const DynamicFigure& figure,
                      const Environment& environment, Motion& motion) {
  if (legs.size() != 2 && legs.size() != 4) return;
  const ContactPlan plan(character, figure, environment, motion);
  std::vector<Rigid> world(character.joints().size());
  std::vector<Unrest> all;
  for (int sole = 0; sole < static_cast<int>(legs.size()); ++sole)
    add_unrest(plan, motion, sole, all);
  for (const FootLift& lift : too_many(std::move(all)))
    for (int f = lift.first; f <= lift.last; ++f) {
      forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
      place_foot(character, legs[at(lift.sole)], world, place_in(lift, f), motion.row(f));
    }
}

}  // namespace contort
