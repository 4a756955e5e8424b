#include "generator/motion/clearance.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "generator/motion/blend.h"
#include "generator/motion/joint_clamp.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// A limb may lose a third of its room in a frame, so it slows down before it stops.
constexpr double kApproach = 0.65;
constexpr double kSlowsDown_m = kApproach * kRoomBand_m;  // with more room it has not lost too much of any
constexpr double kCreep_m = 0.003;  // in a frame, which is slow enough to stop at once
constexpr std::array kShares = {0.8, 0.6, 0.4, 0.2, 0.1, 0.05, 0.02, 0.0};
constexpr double kYield = 0.3;  // of a joint's greatest speed, at which it gets out of the way
constexpr int kRounds = 2;
constexpr double kRise_s = 0.022;  // from rest to the greatest speed
constexpr double kCoast = 0.35;   // of its last step: the way of a joint that stops as soon as it can
constexpr std::array kCoasts = {kCoast, 0.6, 0.8};
constexpr double kFarStep = 0.05;      // of a joint's greatest step in a frame
constexpr double kFarWay_m = 0.005;    // of a body in a frame
constexpr std::array kBetween = {0.25, 0.5, 0.75};
constexpr double kWithMass = 2.0;  // of the acceleration at ease: what is more is a jolt (soft_joints.h)
constexpr double kLifted = 0.7;    // of a joint's greatest speed, while a foot is lifted
constexpr double kMore_m = 1e-5;  // rounding must not choose

}  // namespace

namespace {

Vec3 way_between(const Joint& joint, const Posture& from, const Posture& to) {
  return joint_way_vector(joint, from.coords.data() + joint.coord, to.coords.data() + joint.coord);
}

// Returns true if the joint's speed changes slowly enough for this acceleration at ease; empty: without mass.
bool keeps_pace(const Character& character, int j, const Past& past, std::span<const double> easy,
                const Posture& shown) {
  const Joint& joint = character.joint(j);
  const Vec3 step = way_between(joint, past.before, shown), last = way_between(joint, past.earlier, past.before);
  double most = joint.max_speed / kRise_s;
  if (!easy.empty()) most = std::min(most, kWithMass * easy[at(j)]);
  return length(step - last) <= most * past.frame_s * past.frame_s;
}

}  // namespace

bool moves_smoothly(const Character& character, int j, const Past& past, const Posture& shown) {
  const Joint& joint = character.joint(j);
  return length(way_between(joint, past.before, shown)) <= kLifted * joint.max_speed * past.frame_s &&
         keeps_pace(character, j, past, past.easy, shown);
}

struct Clearance::Case {
  const Character& character;
  LimbRoom& room;
  const StandingFeet& feet;
  const Limb& limb;
  std::size_t part;
  const Past& past;
  const Posture& wanted;
  Posture& stay;
  Posture& shown;
  Posture& saved;
  Posture& spare;
  std::span<Rigid> world;
  double enough_m = -kTooNear_m;
  bool is_lifted = false;
  bool was_lifted = false;
  Haste haste = Haste::at_ease;
  double gap_m = 1.0;

  // A foot of the limb's own that stands is lifted, and those on legs that it carries stay where they stood.
  void place() {
    forward_kinematics(character, shown.coords, limb.joints, world);
    forward_kinematics(character, shown.coords, limb.carried, world);
    is_lifted = false;
    for (const int leg : limb.legs)
      if (limb.is_its_own(feet.legs()[at(leg)]))
        is_lifted = feet.lift(at(leg), world, shown.coords);
      else if (feet.is_planted(at(leg)))
        feet.plant(at(leg), world, shown.coords);
  }
  // Returns true if a leg that the limb carries keeps its foot where it stood.
  bool plants() const {
    return std::ranges::any_of(limb.legs, [&](int leg) {
      return feet.is_planted(at(leg)) && !limb.is_its_own(feet.legs()[at(leg)]);
    });
  }

  // Joints are faster than the way that the limb was to go if a foot is lifted or stays where it stood.
  bool concerns_feet() const {
    return std::ranges::any_of(limb.legs, [&](int leg) {
      return limb.is_its_own(feet.legs()[at(leg)]) || feet.is_planted(at(leg));
    });
  }
  double room_m(RoomRange range) {
    range.gap_m = gap_m;
    return place(), room.room_m(part, world, range);
  }
  bool has_room(double least_m, double twins = 0.0) {
    return place(), room.has_room(part, world, least_m, gap_m, twins);
  }

  // Joints of the limb, and of legs that it carries and that stay where they stand.
  template <class Test>
  bool all_joints(Test test) const {
    if (!std::ranges::all_of(limb.joints, test)) return false;
    return limb.carried.empty() || std::ranges::all_of(limb.legs, [&](int leg) {
      if (!feet.is_planted(at(leg)) || limb.is_its_own(feet.legs()[at(leg)])) return true;
      return std::ranges::all_of(feet.legs()[at(leg)].joints, test);
    });
  }

  // A blend along the edge of a range may be longer than its ends are apart. The knee of a leg that starts from
  // straight gets fast at once, and must be able to stop at once.
  bool is_slow() const {
    const double share = is_lifted || was_lifted || plants() ? kLifted : 1.0;
    return all_joints([&](int j) { return length(step_of(j)) <= share * greatest_step(j); });
  }
  bool is_smooth() const {
    const std::span<const double> easy = haste == Haste::struck ? std::span<const double>() : past.easy;
    return all_joints([&](int j) { return keeps_pace(character, j, past, easy, shown); });
  }
  // Returns true if the limb is clear at the end of the way that it takes to stop, if it is too fast to stop at once.
  bool can_stop() {
    const double most = past.frame_s / kRise_s;
    if (all_joints([&](int j) { return length(step_of(j)) <= most * greatest_step(j); })) return true;
    for (const int p : limb.parts) copy_part(character, at(p), shown, spare);
    for (const int p : limb.parts) coast_part(character, at(p), past.before, spare, kCoast, shown);
    const bool is_clear_there = has_room(-kTooNear_m);
    for (const int p : limb.parts) copy_part(character, at(p), spare, shown);
    place();
    return is_clear_there;
  }
  // Returns true if the limb is clear on its way from the frame before, if it goes so far that it could pass through
  // something. Limbs of the same kind that have moved already go their way meanwhile.
  bool is_clear_between() {
    const double twins_way_m = room.twins_way_m(part, world);
    if (twins_way_m > 0.0 && !has_room(-kTooNear_m, 1.0)) return false;
    const auto stays_near = [&](int j) { return length(step_of(j)) <= kFarStep * greatest_step(j); };
    if (twins_way_m < kFarWay_m && all_joints(stays_near)) return true;
    for (const int p : limb.parts) copy_part(character, at(p), shown, spare);
    const bool is_clear_there = std::ranges::all_of(kBetween, [&](double share) {
      for (const int p : limb.parts) blend_part(character, at(p), past.before, spare, share, shown);
      return has_room(-kTooNear_m, share);
    });
    for (const int p : limb.parts) copy_part(character, at(p), spare, shown);
    place();
    return is_clear_there;
  }
  Vec3 step_of(int j) const { return way_between(character.joint(j), past.before, shown); }
  double greatest_step(int j) const { return character.joint(j).max_speed * past.frame_s; }
  bool is_clear() { return has_room(enough_m) && is_clear_between(); }
  // Feet that are placed change the steps of their joints; without any, steps need no placing and are looked at first.
  bool is_clear_and_slow() { return limb.legs.empty() ? is_slow() && is_clear() : is_clear() && is_slow(); }
  bool is_clear_slow_and_smooth() {
    return limb.legs.empty() ? is_smooth() && is_clear_and_slow() : is_clear_and_slow() && is_smooth();
  }

  // A limb that stops keeps its own foot in place, although hips that go down or lean carry the leg along: a straight
  // knee would have to lift the foot out of the ground at once.
  void find_stay() {
    for (const int p : limb.parts) copy_part(character, at(p), past.before, stay);
    forward_kinematics(character, stay.coords, limb.joints, world);
    for (const int leg : limb.legs)
      if (limb.is_its_own(feet.legs()[at(leg)])) feet.stay(at(leg), world, stay.coords);
  }

  void go(double share) const {
    for (const int p : limb.parts) blend_part(character, at(p), stay, wanted, share, shown);
  }

  // The greatest share of the way that is clear; if possible one that is also smooth, and that can be stopped after.
  bool stop_on_the_way() {
    const auto is_good = [&](double share) { return go(share), is_clear_and_slow(); };
    std::optional<double> good, smooth;
    for (const double share : kShares) {
      if (!is_good(share)) continue;
      if (!good) good = share;
      if (!is_smooth()) continue;
      if (can_stop()) return true;
      if (!smooth) smooth = share;
    }
    if (!good) return false;
    if (!smooth && slow_down()) return true;
    return is_good(smooth.value_or(*good));  // goes there once more
  }

  void coast(double steps) const {
    for (const int p : limb.parts) coast_part(character, at(p), past.earlier, past.before, steps, shown);
    for (const int j : limb.joints) {
      const Joint& joint = character.joint(j);
      clamp_to_range(joint, shown.coords.data() + joint.coord);
    }
  }

  // A joint that can stop after a step may be wanted elsewhere next, where no share of the way is smooth: it loses its
  // speed on the way that it was on.
  bool slow_down() {
    const double enough = std::exchange(enough_m, -kTooNear_m);
    const bool slows = std::ranges::any_of(kCoasts, [&](double steps) {
      coast(steps);
      return is_clear_slow_and_smooth();
    });
    enough_m = enough;
    return slows;
  }

  // Joints that may go where they are wanted go there, one by one, those that carry the others first.
  void slide() {
    for (const int j : limb.joints) {
      save();
      const Joint& joint = character.joint(j);
      std::copy_n(wanted.coords.begin() + joint.coord, coord_size(joint.kind), shown.coords.begin() + joint.coord);
      if (!is_clear_slow_and_smooth() || !can_stop()) restore();
    }
    place();
  }

  void save() {
    for (const int p : limb.parts) copy_part(character, at(p), shown, saved);
  }
  void restore() {
    for (const int p : limb.parts) copy_part(character, at(p), saved, shown);
  }

  // Turns one joint to either side, about each of its axes, and keeps what gives more room.
  void yield(const Joint& joint, double step, double& most_m) {
    const int axes = joint.kind == JointKind::ball ? 3 : 1;
    for (int i = 0; i < 2 * axes; ++i) {
      save();
      double* coords = shown.coords.data() + joint.coord;
      turn(joint, i / 2, i % 2 == 0 ? step : -step, coords);
      clamp_to_range(joint, coords);
      const double more_m = most_m + kMore_m;
      if (const double now_m = room_m({.low_m = more_m}); now_m > more_m && is_slow())
        most_m = now_m;
      else
        restore();
    }
  }

  static void turn(const Joint& joint, int axis, double step, double* coords) {
    if (joint.kind != JointKind::ball) {
      coords[0] += step;
      return;
    }
    Vec3 turn_rad(0.0);
    turn_rad[axis] = step;
    const Quat q = glm::normalize(quat_at(coords) * from_rotation_vector(turn_rad));
    coords[0] = q.w, coords[1] = q.x, coords[2] = q.y, coords[3] = q.z;
  }

  // Bodies that are too near do not touch yet: a limb that is too fast to stop at once may use that.
  bool coast_beside() {
    constexpr double kNarrow_m = 0.001;
    const auto is_apart = [&] { return place(), room.has_room(part, world, -kTooNear_m, kNarrow_m); };
    return std::ranges::any_of(kCoasts, [&](double steps) {
      return coast(steps), is_apart() && is_slow() && is_smooth();
    });
  }

  void get_out() {
    if (!is_smooth() && coast_beside()) return;
    go(0.0);
    double most_m = room_m({});
    for (int round = 0; round < kRounds && most_m < -kTooNear_m; ++round)
      for (const int j : limb.joints)
        if (const Joint& joint = character.joint(j); most_m < -kTooNear_m)
          yield(joint, kYield / kRounds * joint.max_speed * past.frame_s, most_m);
    place();
  }
};

void Clearance::begin(const Character& character, LimbRoom& room) {
  character_ = &character, room_ = &room;
  wanted_.coords.assign(at(character.coord_count()), 0.0);
  stay_ = saved_ = spare_ = wanted_;
}

Clearance::Kept Clearance::keep(std::size_t part, const Past& past, const LimbState& state, Posture& shown,
                                std::span<Rigid> world) {
  const Limb& limb = room_->limb_of(part);
  for (const int p : limb.parts) copy_part(*character_, at(p), shown, wanted_);
  Case now{*character_, *room_, room_->feet(), limb, part, past, wanted_, stay_, shown, saved_, spare_, world};
  now.was_lifted = state.was_lifted, now.haste = state.haste, now.gap_m = state.gap_m;
  const double wanted_m = wanted_m_ = now.room_m({-kTooNear_m, kSlowsDown_m});
  const bool is_easy = now.can_stop() && (!now.concerns_feet() || (now.is_slow() && now.is_smooth()));
  const Kept as_wanted = now.is_lifted ? Kept::foot_lifted : Kept::as_wanted;
  if (wanted_m >= kSlowsDown_m && is_easy) return as_wanted;
  now.find_stay();
  now.go(0.0);
  const double room_m = now.room_m({.low_m = -kTooNear_m});
  now.enough_m = std::max(-kTooNear_m, std::min(kApproach * room_m, room_m - kCreep_m));
  now.go(1.0);
  if (is_easy && now.is_clear()) return as_wanted;
  now.stop_on_the_way() ? now.slide() : now.get_out();
  return Kept::elsewhere;
}

}  // namespace contort
