#include "generator/limb_keeper.h"

#include <algorithm>
#include <array>

#include "generator/actions/hand.h"
#include "generator/motion/blend.h"
#include "generator/motion/way.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kComfortable_m = 1.0;  // between bodies: the gap that they have elsewhere (LimbRoom)
constexpr double kNarrow_m = 0.001;

bool carries(const Character& character, int joint, int other) {
  while (other > joint) other = character.joint(other).parent;
  return other == joint;
}

}  // namespace

// Poses are taken as their authors give them (but see loses_room_of_pose), and walking legs as their gait has them.
bool LimbKeeper::makes_way(const Playback& playback, std::size_t p) const {
  const LayerHold& ik = s_.stacks[p].ik();
  if (ik.action >= 0) return !moves_legs(playback, ik) && !is_cut(playback, ik);
  return s_.added[p] != 0 || swings_at_obstacles(playback, p);
}

// An arm that swings with a gait keeps clear of walls that the figure goes along; its own body is no danger to it.
bool LimbKeeper::swings_at_obstacles(const Playback& playback, std::size_t p) const {
  const LayerHold& gait = s_.stacks[0].ik();
  return s_.free_arm[p] != 0 && s_.stacks[p].overwrite().action < 0 && gait.action >= 0 &&
         moves_legs(playback, gait) && !stage_.environment.obstacles().empty();
}

// The limb's last action is over, and the limb is still on its way to its base.
bool LimbKeeper::comes_back(std::size_t p) const {
  return s_.behind[p] != 0 && s_.stacks[p].overwrite().action < 0 && s_.stacks[p].ik().action < 0;
}

HeldObject LimbKeeper::held_by(const Playback& playback, std::size_t p) const {
  const LayerHold& ik = s_.stacks[p].ik();
  if (ik.action < 0 || planned(playback, ik).def->promise != Promise::holds) return {};
  const PlannedAction& action = planned(playback, ik);
  return held_object(*stage_.character, action.named, static_cast<int>(action.params[0]));
}

// A hand that no action keeps at its object any longer may still be round it.
void LimbKeeper::note_grasp(const Playback& playback, const Limb& limb, const HeldObject& held) {
  const std::size_t part = at(limb.parts.front());
  const HeldObject before = s_.grasps.held_before(playback.frame(), part);
  if (held.body >= 0)
    s_.grasps.note(playback.frame(), part, held);
  else if (before.body >= 0 && s_.rules.room().is_at(before, part, s_.rules.world()))
    s_.grasps.note(playback.frame(), part, before);
}

bool LimbKeeper::acts(const Playback& playback, const Limb& limb) const {
  return std::ranges::any_of(limb.parts, [&](int p) { return makes_way(playback, at(p)); }) ||
         is_posed_anew(playback, limb);
}

// Returns true for an arm, head or tail in a pose, once a reach, an aim or the like has moved it: the joints that the
// pose does not give may be where that action left them, and the author of the pose has not seen such a posture.
bool LimbKeeper::is_posed_anew(const Playback& playback, const Limb& limb) const {
  const auto is_posed = [&](int p) {
    const LayerHold& pose = s_.stacks[at(p)].overwrite();
    return pose.action >= 0 && !is_cut(playback, pose);
  };
  return limb.legs.empty() && std::ranges::any_of(limb.parts, is_posed) &&
         std::ranges::any_of(limb.parts, [&](int p) { return s_.settled[at(p)] != 0; });
}

// As of now for limbs that are finished, else with the shift of the frame before.
LegUse LimbKeeper::use_of(const Playback& playback, const Limb& limb) const {
  if (acts(playback, limb)) return LegUse::acts;
  if (returns(limb)) return LegUse::lands;
  if (std::ranges::any_of(limb.parts, [&](int p) { return comes_back(at(p)); })) return LegUse::lands;
  const bool is_placed = std::ranges::any_of(limb.parts, [&](int p) {
    return s_.stacks[at(p)].overwrite().action >= 0 || s_.stacks[at(p)].ik().action >= 0;
  });
  if (is_placed) return LegUse::placed;
  const Shift shift = s_.shift[at(limb.parts.back())];
  return shift == Shift::lifted || shift == Shift::held_off ? LegUse::lands : LegUse::idle;
}

// All parts of the limb are placed.
void LimbKeeper::finish(const Playback& playback, const Limb& limb) {
  const LegUse use = use_of(playback, limb);
  const bool was_lifted = s_.shift[at(limb.parts.back())] == Shift::lifted;
  shift(limb, Shift::none);
  int& held_off = s_.held_off[at(limb.parts.back())];
  const HeldObject held = held_by(playback, at(limb.parts.front()));
  s_.rules.room().hold(at(limb.parts.back()), held);
  if (use == LegUse::acts) stop_returning(limb);
  const bool lands = use == LegUse::lands && land(playback, limb);
  if (use == LegUse::acts || (use == LegUse::lands && !lands)) keep_clear(limb, was_lifted, kComfortable_m);
  if (use == LegUse::idle) plant(limb);
  if (loses_room(playback, limb)) keep_clear(limb, was_lifted, kComfortable_m);
  if (use == LegUse::placed && loses_room_of_pose(limb)) keep_clear(limb, was_lifted, kNarrow_m);
  held_off = s_.shift[at(limb.parts.back())] == Shift::held_off ? held_off + 1 : 0;
  note_stuck(limb);
  if (held_off > 0) try_again(playback, limb);
  hold_over_feet(playback, limb);
  note_grasp(playback, limb, held);
}

// A limb that would have room where it is wanted, and does not get there, comes in once more from where it is: its rule
// chooses again, and finds a way round.
void LimbKeeper::try_again(const Playback& playback, const Limb& limb) {
  constexpr double kWaits_s = 0.15;
  constexpr int kMostTries = 3;
  const LayerHold& hold = s_.stacks[at(limb.parts.front())].ik();
  if (hold.action < 0 || s_.held_off[at(limb.parts.back())] < kWaits_s * stage_.rate_hz) return;
  const PlannedAction& action = planned(playback, hold);
  if (action.cuts || action.def->timing != Timing::course || hold.restarts == kMostTries) return;
  if (come_in(playback, hold) < 1.0 || left_of(playback, hold) < 1.0) return;
  s_.held_off[at(limb.parts.back())] = 0;
  if (s_.clearance.wanted_room_m() < -kTooNear_m) {
    s_.rules.body(action).chooses_swivel = true;
    return;
  }
  for (const int p : limb.parts)
    if (const LayerHold& other = s_.stacks[at(p)].ik(); other.action >= 0 && planned(playback, other).use == action.use)
      s_.stacks[at(p)].restart_ik();
}

void LimbKeeper::shift(const Limb& limb, Shift shift) {
  for (const int p : limb.parts) s_.shift[at(p)] = shift;
  s_.shift_count += shift != Shift::none;
}

void LimbKeeper::place(const Leg& leg, const Posture& posture) {
  forward_kinematics(*stage_.character, posture.coords, leg.joints, s_.rules.world());
}

// A course that comes in moves the soles from where it has found them.
bool LimbKeeper::is_coming_in(const Playback& playback, const Limb& limb) const {
  const LayerHold& course = s_.stacks[0].ik();
  return returns(limb) && course.action >= 0 && come_in(playback, course) < 1.0;
}

void LimbKeeper::stop_returning(const Limb& limb) {
  for (const int p : limb.parts) s_.returns[at(p)] = 0;
}

bool LimbKeeper::returns(const Limb& limb) const {
  return std::ranges::any_of(limb.parts, [&](int p) { return s_.returns[at(p)] != 0; });
}

// For a limb that no action of its own moves any more: its feet go to where its base posture has them, or the course of
// legs that goes on, by the greatest share of that way in which joints move smoothly and bodies have room. False for a
// limb without feet of its own, and where no share does.
bool LimbKeeper::land(const Playback& playback, const Limb& limb) {
  const bool has_feet = std::ranges::any_of(limb.legs, [&](int i) { return limb.is_its_own(stage_.legs[at(i)]); });
  if (!has_feet) return false;
  for (const int p : limb.parts) copy_part(*stage_.character, at(p), s_.postures.shown, s_.wanted);
  for (const int i : limb.legs) {
    home_[at(i)] = home_sole(limb, stage_.legs[at(i)]);
    const bool rested_there = is_as_rested(stage_.legs[at(i)]);
    is_raised_[at(i)] = !returns(limb) && !rested_there && s_.rules.feet().put_on_ground(at(i), home_[at(i)]);
  }
  // A hand that waits beside the thigh, and for which the thigh waits, would keep the leg in the air for good.
  if (land(playback, limb, kComfortable_m) || land(playback, limb, kNarrow_m) || rise(limb)) return true;
  for (const int p : limb.parts) copy_part(*stage_.character, at(p), s_.wanted, s_.postures.shown);
  if (returns(limb)) follow_in_joints(limb);
  return false;
}

// No step of the soles is smooth: the joints go after the course as fast as they can gather and lose speed.
void LimbKeeper::follow_in_joints(const Limb& limb) {
  for (const int p : limb.parts) {
    s_.path.correct(at(p), s_.past.earlier.coords, s_.past.before.coords);
    s_.path.follow(at(p), s_.postures.shown.coords);
  }
  forward_kinematics(*stage_.character, s_.postures.shown.coords, limb.joints, s_.rules.world());
}

bool LimbKeeper::land(const Playback& playback, const Limb& limb, double gap_m) {
  constexpr std::array kShares = {0.25, 0.18, 0.12, 0.08, 0.05, 0.03, 0.02};
  for (const double share : kShares) {
    const bool is_there = step_home(limb, {.share = share});
    if (!is_smooth(limb) || !has_room_on_the_way(limb, gap_m)) continue;
    if (is_there && !is_coming_in(playback, limb)) return arrive(limb), true;
    return go_on_landing(limb), true;
  }
  return false;
}

void LimbKeeper::go_on_landing(const Limb& limb) {
  shift(limb, Shift::lifted);
  for (const int p : limb.parts) s_.path.correct(at(p), s_.past.before.coords, s_.postures.shown.coords);
}

// A straight leg that has come in low bends its knee fast when its foot is to be lifted: it is lifted little by little
// before it goes anywhere. While a course moves the hips, that would not keep it out of the ground.
bool LimbKeeper::rise(const Limb& limb) {
  constexpr std::array kLifts = {0.6, 0.4, 0.25, 0.15, 0.08, 0.04};
  step_home(limb, {.share = 0.0, .lift = 0.0});
  const bool is_too_low = std::ranges::any_of(limb.legs, [&](int i) {
    return limb.is_its_own(stage_.legs[at(i)]) && s_.rules.feet().room_m(at(i), s_.rules.world()) < -kTooNear_m;
  });
  if (!is_too_low || returns(limb)) return false;
  const auto is_good = [&](double lift) {
    step_home(limb, {.share = 0.0, .lift = lift});
    return is_smooth(limb) && has_room_on_the_way(limb, kNarrow_m, true);
  };
  const bool rises = std::ranges::any_of(kLifts, is_good);
  if (rises) go_on_landing(limb);
  return rises;
}

// From the frame before; true where all feet of the limb have arrived.
bool LimbKeeper::step_home(const Limb& limb, LandingStep step) {
  bool is_there = true;
  for (const int i : limb.legs) {
    const Leg& leg = stage_.legs[at(i)];
    if (!limb.is_its_own(leg)) continue;
    place(leg, s_.past.before);
    for (const int p : {leg.part, leg.foot_part})
      copy_part(*stage_.character, at(p), s_.past.before, s_.postures.shown);
    is_there = s_.rules.feet().land(at(i), home_[at(i)], step, s_.rules.world(), s_.postures.shown.coords) && is_there;
  }
  return is_there;
}

// Additives and ik of a trunk that carries the leg do not count: the foot would land on the move, and slide.
Rigid LimbKeeper::home_sole(const Limb& limb, const Leg& leg) {
  const Character& character = *stage_.character;
  const Posture& home = home_of(limb, leg.part);
  std::ranges::copy(s_.rules.world(), s_.rest_world.begin());
  const int hip = leg.joints.front();
  const bool goes_along = returns(limb) || s_.rests[at(leg.part)] != 0;
  for (int j = 1; j < hip && !goes_along; ++j)  // carriers first
    if (carries(character, j, hip)) forward_kinematics(character, home.coords, j, j + 1, s_.rest_world);
  forward_kinematics(character, home.coords, leg.joints, s_.rest_world);
  return world_from_socket(character, s_.rest_world, leg.sole);
}

// The posture that a limb which lands goes to.
const Posture& LimbKeeper::home_of(const Limb& limb, int part) const {
  if (returns(limb)) return s_.postures.plain;
  return s_.rests[at(part)] != 0 ? s_.postures.stand : s_.postures.base;
}

bool LimbKeeper::is_smooth(const Limb& limb) const {
  return std::ranges::all_of(limb.joints, [&](int j) {
    return moves_smoothly(*stage_.character, j, s_.past, s_.postures.shown);
  });
}

// From where the limb was in the frame before to where it is shown now. A foot that rises comes from the ground.
bool LimbKeeper::has_room_on_the_way(const Limb& limb, double gap_m, bool is_rising) {
  const Character& character = *stage_.character;
  const std::span<Rigid> world = s_.rules.world();
  return std::ranges::all_of(std::array{0.25, 0.5, 0.75, 1.0}, [&](double share) {
    for (const int p : limb.parts)
      blend_part(character, at(p), s_.past.before, s_.postures.shown, share, s_.between);
    forward_kinematics(character, s_.between.coords, limb.joints, world);
    LimbRoom& room = s_.rules.room();
    const std::size_t part = at(limb.parts.back());
    if (share == 1.0 && !is_rising) return room.has_room(part, world, -kTooNear_m, gap_m);
    return room.apart_m(part, world, {-kTooNear_m, -kTooNear_m, gap_m}) >= -kTooNear_m;
  });
}

// A leg whose action ended with the foot in the ground, as the action wanted it, is held on the ground instead.
void LimbKeeper::arrive(const Limb& limb) {
  for (const int i : limb.legs)
    for (const int p : {stage_.legs[at(i)].part, stage_.legs[at(i)].foot_part})
      if (is_raised_[at(i)]) copy_part(*stage_.character, at(p), s_.postures.shown, s_.postures.base);
  for (const int p : limb.parts) {
    copy_part(*stage_.character, at(p), home_of(limb, p), s_.postures.shown);
    s_.path.pass(at(p), s_.postures.shown.coords);
  }
  for (const int i : limb.legs) place(stage_.legs[at(i)], s_.postures.shown);
  stop_returning(limb);
}

void LimbKeeper::note_feet(const Playback& playback) {
  for (std::size_t leg = 0; leg < stage_.legs.size(); ++leg) {
    const LegUse use = use_of(playback, limb_at(at(stage_.legs[leg].part)));
    s_.rules.feet().note(leg, use, s_.rules.world());
    if (use == LegUse::acts || use == LegUse::lands) continue;
    for (const int p : {stage_.legs[leg].part, stage_.legs[leg].foot_part})
      copy_part(*stage_.character, at(p), s_.postures.base, s_.rested);
  }
}

bool LimbKeeper::is_struck(std::size_t p) const {
  return std::ranges::any_of(stage_.legs, [&](const Leg& leg) {
    const bool is_own = static_cast<int>(p) == leg.part || static_cast<int>(p) == leg.foot_part;
    return is_own && (s_.rules.feedback()[at(leg.part)].impact || s_.rules.feedback()[at(leg.foot_part)].impact);
  });
}

// Returns true for an arm, head or tail that no action moves, and that had room until something else moved: a body of
// the figure that comes towards it, or a trunk that carries it to a wall. A limb that an author's pose has put too near
// to a body stays there, and arms that swing with a gait have their own rule.
bool LimbKeeper::loses_room(const Playback& playback, const Limb& limb) {
  const std::size_t part = at(limb.parts.back());
  const LayerHold& gait = s_.stacks[0].ik();
  const bool swings = s_.free_arm[at(limb.parts.front())] != 0 && gait.action >= 0 && moves_legs(playback, gait);
  const bool is_idle = limb.legs.empty() && !swings && use_of(playback, limb) == LegUse::idle;
  const bool has_room = is_idle && s_.rules.room().has_room(part, s_.rules.world());
  const bool loses = is_idle && !has_room && s_.had_room[part] != 0;
  s_.had_room[part] = has_room || loses;
  return loses;
}

// Returns true for an arm, head or tail in a pose that has no room here, but keeps bodies apart on a figure at rest, as
// its author has seen it: the trunk, the legs, the ground or an obstacle take the room away.
bool LimbKeeper::loses_room_of_pose(const Limb& limb) {
  constexpr RoomRange kBodiesApart{.low_m = -kTooNear_m, .high_m = -kTooNear_m, .gap_m = 0.0, .twins = 1.0};
  const auto acts_by_ik = [&](int p) { return s_.stacks[at(p)].ik().action >= 0; };
  if (!limb.legs.empty() || std::ranges::any_of(limb.parts, acts_by_ik)) return false;
  const std::size_t part = at(limb.parts.back());
  if (s_.rules.room().has_room(part, s_.rules.world(), -kTooNear_m, kNarrow_m)) return false;
  std::ranges::copy(stage_.character->rest_coords(), s_.between.coords.begin());
  for (const int p : limb.parts) copy_part(*stage_.character, at(p), s_.postures.shown, s_.between);
  forward_kinematics(*stage_.character, stage_.character->rest_root(), s_.between.coords, s_.rest_world);
  return s_.rules.room().apart_m(part, s_.rest_world, kBodiesApart) >= -kTooNear_m;
}

void LimbKeeper::note_stuck(const Limb& limb) {
  constexpr double kStill_rad = 1e-4;  // or m; in a frame
  const bool is_still = std::ranges::all_of(limb.joints, [&](int j) {
    const std::size_t coord = at(stage_.character->joint(j).coord);
    return joint_way(stage_.character->joint(j), &s_.past.before.coords[coord], &s_.postures.shown.coords[coord]) <
           kStill_rad;
  });
  s_.stuck[at(limb.parts.back())] = s_.shift[at(limb.parts.back())] == Shift::held_off && is_still;
}

// Returns true if bodies have stopped a limb without feet on its way back, or while only a blow moves it, until it has
// room again. Its way may lead past a body with less than the comfortable gap, as when an arm hangs beside a thigh.
bool LimbKeeper::squeezes_past(const Limb& limb) const {
  const std::size_t part = at(limb.parts.back());
  const bool is_stopped = s_.stuck[part] != 0 || s_.squeezes[part] != 0;
  return limb.legs.empty() && is_stopped && std::ranges::none_of(limb.parts, [&](int p) {
    return s_.stacks[at(p)].overwrite().action >= 0 || s_.stacks[at(p)].ik().action >= 0;
  });
}

void LimbKeeper::keep_clear(const Limb& limb, bool was_lifted, double gap_m) {
  const auto part = at(limb.parts.back());
  char& squeezes = s_.squeezes[part];
  squeezes = squeezes_past(limb);
  const Clearance::LimbState state{was_lifted, is_struck(part) ? Haste::struck : Haste::at_ease,
                                   squeezes != 0 ? kNarrow_m : gap_m};
  const Clearance::Kept kept = s_.clearance.keep(part, s_.past, state, s_.postures.shown, s_.rules.world());
  if (squeezes != 0 && s_.rules.room().has_room(part, s_.rules.world())) squeezes = 0;
  switch (kept) {
    case Clearance::Kept::as_wanted: return;
    case Clearance::Kept::foot_lifted: return shift(limb, Shift::lifted);
    case Clearance::Kept::elsewhere: break;
  }
  shift(limb, Shift::held_off);
  // The lift of a foot so far is no speed of its leg. Joints without mass would lose that speed within some frames.
  const bool keeps_speed = was_lifted && !s_.past.easy.empty();
  for (const int p : limb.parts)
    if (keeps_speed)
      s_.path.correct(at(p), s_.past.before.coords, s_.postures.shown.coords);
    else
      s_.path.correct(at(p), s_.postures.shown.coords);
}

}  // namespace contort
