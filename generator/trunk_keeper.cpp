// The part of LimbKeeper that holds a trunk over the feet of the legs that it carries.
#include <algorithm>
#include <array>

#include "generator/actions/course_ahead.h"
#include "generator/limb_keeper.h"
#include "generator/motion/blend.h"
#include "generator/motion/stand_on.h"
#include "generator/motion/way.h"
#include "model/motion/kinematics.h"

namespace contort {

// A trunk goes only as far as the legs that it carries reach to where their feet stand, or go in a course of legs. It
// looks ahead by as much as it needs to stop, losing a fifth of its speed a frame.
void LimbKeeper::hold_over_feet(const Playback& playback, const Limb& limb) {
  constexpr std::array kShares = {1.0, 0.8, 0.6, 0.4, 0.2, 0.1};
  constexpr double kAhead = 5.0;  // steps
  const auto carries_foot = [&](int i) {
    return is_carried_and_stands(playback, limb, i) || is_carried_on_course(playback, limb, i);
  };
  if (std::ranges::none_of(limb.legs, carries_foot) || !has_moved(limb)) return;
  for (const int p : limb.parts) copy_part(*stage_.character, at(p), s_.postures.shown, s_.wanted);
  const std::optional<FramesAhead> course = course_of_legs(playback);
  const auto reach = [&](double steps) { return feet_reach(playback, limb, steps, course); };
  const auto fits = std::ranges::find_if(kShares, [&](double share) { return reach(kAhead * share); });
  if (fits == kShares.begin()) return;
  if (fits == kShares.end() && !reach(0.0) && !takes_feet_away(playback, limb, course)) return;
  const double share = fits != kShares.end() ? *fits : 0.0;
  shift(limb, Shift::over_feet);
  for (const int p : limb.parts) {
    blend_part(*stage_.character, at(p), s_.past.before, s_.wanted, share, s_.postures.shown);
    s_.path.correct(at(p), s_.past.before.coords, s_.postures.shown.coords);
  }
  forward_kinematics(*stage_.character, s_.postures.shown.coords, limb.joints, s_.rules.world());
}

// A foot that an additive has lifted comes back to where it stood, too.
bool LimbKeeper::is_carried_and_stands(const Playback& playback, const Limb& limb, int leg) const {
  const std::size_t part = at(stage_.legs[at(leg)].part);
  if (limb.is_its_own(stage_.legs[at(leg)])) return false;
  const LayerHold& hold = s_.stacks[part].ik();
  const bool comes_back = s_.rests[part] != 0 && hold.action < 0;
  // The hold of a leg is still that of the frame before when its trunk is placed; that of the root is not.
  const bool has_left_course = s_.stacks[0].ik().action < 0 && hold.action >= 0 && moves_legs(playback, hold);
  return s_.rules.feet().is_planted(at(leg)) || comes_back || (has_left_course && stays_after_course(leg));
}

bool LimbKeeper::is_carried_on_course(const Playback& playback, const Limb& limb, int leg) const {
  const LayerHold& hold = s_.stacks[at(stage_.legs[at(leg)].part)].ik();
  return !limb.is_its_own(stage_.legs[at(leg)]) && hold.action >= 0 && moves_legs(playback, hold);
}

std::optional<FramesAhead> LimbKeeper::course_of_legs(const Playback& playback) const {
  const LayerHold& hold = s_.stacks[0].ik();
  if (hold.action < 0 || !moves_legs(playback, hold)) return std::nullopt;
  return frames_ahead(s_.rules.body(planned(playback, hold)));
}

bool LimbKeeper::has_moved(const Limb& limb) const {
  return std::ranges::any_of(limb.joints, [&](int j) {
    const Joint& joint = stage_.character->joint(j);
    return joint_way(joint, &s_.past.before.coords[at(joint.coord)], &s_.postures.shown.coords[at(joint.coord)]) > 0.0;
  });
}

// Visits the soles on legs that the limb carries, if the limb went so many of this frame's steps: where they stand, or
// all of their places on a course. Transforms and coordinates for that are in rest_world and between. Stops and returns
// false where a visit does.
template <class Visit>
bool LimbKeeper::visit_soles(const Playback& playback, const Limb& limb, double steps,
                             const std::optional<FramesAhead>& course, Visit visit) {
  const Character& character = *stage_.character;
  std::ranges::copy(s_.rules.world(), s_.rest_world.begin());
  s_.between.coords = s_.past.before.coords;
  for (const int p : limb.parts) coast_part(character, at(p), s_.past.before, s_.wanted, steps - 1.0, s_.between);
  forward_kinematics(character, s_.between.coords, limb.joints, s_.rest_world);
  return std::ranges::all_of(limb.legs, [&](int i) {
    const std::size_t leg = at(i);
    forward_kinematics(character, s_.between.coords, stage_.legs[leg].joints, s_.rest_world);
    if (is_carried_and_stands(playback, limb, i)) return visit(leg, *s_.rules.feet().rests_at(leg), SoleUse::stays);
    if (!course || !is_carried_on_course(playback, limb, i)) return true;
    return std::ranges::all_of(course->frames, [&](const GaitFrame& frame) {
      const Rigid sole = s_.rest_world[0] * inverse(frame.root) * frame.feet[leg].world_from_sole;
      return visit(leg, sole, course->is_bend ? SoleUse::bends : SoleUse::goes);
    });
  });
}

// Returns true if all feet on legs that the limb carries could stay where they stand, or go where a course has them, if
// it went so many of this frame's steps. In a bend, heels may rise; on a course, legs must not touch other bodies.
bool LimbKeeper::feet_reach(const Playback& playback, const Limb& limb, double steps,
                            const std::optional<FramesAhead>& course) {
  constexpr double kReaches_m = 0.002;
  constexpr RoomRange kApart{.low_m = -kTooNear_m, .high_m = -kTooNear_m, .gap_m = 0.001};
  return visit_soles(playback, limb, steps, course, [&](std::size_t leg, const Rigid& sole, SoleUse use) {
    const bool reaches =
        use == SoleUse::bends
            ? stand_on(*stage_.character, stage_.legs[leg], s_.rest_world, sole, s_.between.coords).fits
            : s_.rules.feet().missed_m(leg, sole, s_.rest_world, s_.between.coords) < kReaches_m;
    if (!reaches || use == SoleUse::stays) return reaches;
    return s_.rules.room().apart_m(at(stage_.legs[leg].part), s_.rest_world, kApart) >= -kTooNear_m;
  });
}

double LimbKeeper::feet_missed_m(const Playback& playback, const Limb& limb, double steps,
                                 const std::optional<FramesAhead>& course) {
  double most_m = 0.0;
  visit_soles(playback, limb, steps, course, [&](std::size_t leg, const Rigid& sole, SoleUse) {
    most_m = std::max(most_m, s_.rules.feet().missed_m(leg, sole, s_.rest_world, s_.between.coords));
    return true;
  });
  return most_m;
}

// Returns true for a limb whose feet do not reach their places, and would be still farther from them after this step.
bool LimbKeeper::takes_feet_away(const Playback& playback, const Limb& limb, const std::optional<FramesAhead>& course) {
  return feet_missed_m(playback, limb, 1.0, course) > feet_missed_m(playback, limb, 0.0, course);
}

}  // namespace contort
