// walk, run, turn, crouch and squat: the root, all legs and all feet in one course (motion/gait.h).
#include <algorithm>
#include <cmath>

#include "generator/actions/action.h"
#include "generator/motion/joint_clamp.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/foot_roll.h"
#include "generator/motion/pace.h"
#include "generator/motion/root_blend.h"
#include "generator/motion/stand_on.h"
#include "generator/motion/way.h"
#include "generator/motion/weighty_bend.h"
#include "model/core/detmath.h"
#include "model/core/index.h"

namespace contort {

namespace {

ParamDef number(const char* name, double low, double high, double preset, const char* help) {
  ParamDef def;
  def.name = name, def.help = help;
  def.low = low, def.high = high, def.preset = preset;
  return def;
}

ParamDef lead() {
  ParamDef def;
  def.name = "lead";
  def.type = ParamType::choice;
  def.choices = {"left", "right"};
  def.preset = std::string("left");
  def.help = "Side whose foot stands when the action begins.";
  return def;
}

std::vector<ParamDef> params_of_gait(double fastest_m_s, double preset_m_s) {
  return {
      lead(), number("speed_m_s", 0.0, fastest_m_s, preset_m_s, "Speed between the start and the stop."),
      number(
          "heading_deg", -180.0, 180.0, 0.0,
          "Direction of travel relative to the direction that the character faces; 90 is to its left. The character "
          "turns there as it starts; slow walks go sideways or backward.")};
}

std::vector<ParamDef> params_of_bend() {
  return {number("share", 0.0, 0.6, 0.3, "Distance by which the hips go down, as a fraction of the legs' length."),
          number("lean_deg", -30.0, 90.0, 0.0, "Angle by which the hips lean forward at the lowest point."),
          number("back_m", -0.5, 0.5, 0.0,
                 "Distance by which the hips go back there, so that a figure that leans forward stays over its feet.")};
}

bool is_root_with_legs(const Character& character, const Part& part) {
  if (&part != character.parts().data()) return false;
  return std::any_of(character.sockets().begin(), character.sockets().end(), [](const Socket& socket) {
    return std::string_view(socket.name).ends_with("/sole");
  });
}

bool is_root(const RuleInput& in) { return &in.part == in.character.parts().data(); }

// The place of a foot while the course comes in: its first offset from the course goes away with the blend.
Rigid blended_sole(const RuleInput& in, std::size_t leg) {
  const Rigid& wanted = in.body.frame.feet[leg].world_from_sole;
  const double left = 1.0 - in.came_in;
  const Rigid& seen = in.body.seen_soles[leg];
  const Rigid& first = in.body.first_soles[leg];
  if (left <= 0.0 || seen == first) return wanted;
  const Quat off = seen.q * glm::conjugate(first.q) * wanted.q;
  const Quat q = slerp_short(wanted.q, off, left);
  const Vec3 on = lower_end_m(in.legs[leg], seen);  // a foot that stands on its toes turns about them
  return {q, wanted * on + left * (seen * on - first * on) - q * on};
}

void begin_course(const RuleInput& in) {
  in.body.gait.begin(in.character, in.legs, in.environment, in.stands_at,
                     std::span(in.body.seen_soles).first(in.legs.size()));
  in.body.first_soles = in.body.gait.first_soles();
  const bool is_resumed = in.body.begun >= 0 && in.time.left_s < in.time.duration_s - 1e-9;
  if (!is_resumed) in.body.faced = in.stands_at.q;
  in.body.begun = in.took_over;
}

// The course's frame, made by the first part that asks for it. It begins where the root was when it was taken.
template <class Make>
const GaitFrame& frame_of(const RuleInput& in, Make make) {
  WholeBody& body = in.body;
  if (body.begun < 0 || (is_root(in) && body.begun != in.took_over)) begin_course(in);
  if (body.made_in == in.frame) return body.frame;
  const GaitFrame before = body.frame;
  body.frame = make(body.gait);
  for (std::size_t i = 0; i < in.legs.size(); ++i)
    body.lands[i] = body.made_in >= 0 && body.frame.feet[i].stands && !before.feet[i].stands;
  for (std::size_t i = 0; i < in.legs.size(); ++i) body.frame.feet[i].world_from_sole = blended_sole(in, i);
  body.made_in = in.frame, body.since_s = in.time.since_s;
  return body.frame;
}

// A foot on a leg that has another action is nowhere near its sole, and only turns as far as its ankle goes.
void level(const RuleInput& in, const Leg& leg, const Rigid& sole, Posture& posture) {
  constexpr double kNear_m = 0.001;
  level_foot(in.character, leg, in.world, sole.q * Vec3(0, 1, 0), posture.coords);
  const auto ankles = std::span(leg.ankles).first(at(leg.ankle_count));
  if (ankles.empty()) return;
  const Joint& first = in.character.joint(ankles.front());
  const Vec3 ankle_m = in.world[at(first.parent)] * first.parent_from_joint.p_m;
  if (length(ankle_m - sole * leg.sole_from_ankle) < kNear_m) return;
  for (const int j : ankles) clamp_to_range(in.character.joint(j), &posture.coords[at(in.character.joint(j).coord)]);
}

template <class Make>
void follow(const RuleInput& in, Posture& posture, Make make) {
  const GaitFrame& frame = frame_of(in, make);
  const int part = static_cast<int>(&in.part - in.character.parts().data());
  if (part == 0) posture.root = frame.root;
  for (std::size_t i = 0; i < in.legs.size(); ++i) {
    const Leg& leg = in.legs[i];
    Rigid& sole = in.body.frame.feet[i].world_from_sole;
    if (leg.part == part) sole = stand_on(in.character, leg, in.world, sole, posture.coords).world_from_sole;
    if (leg.foot_part == part && leg.part != part) level(in, leg, sole, posture);
    if (leg.part == part || leg.foot_part == part) in.feedback.contact = in.body.lands[i];
  }
}

// The heading of a course from where the figure faces now: a course that was cut has made a part of its turn before.
double heading_rad(const RuleInput& in) {
  const WholeBody& body = in.body;
  const Quat turned = glm::conjugate(body.faced) * body.gait.world_from_start().q;
  return wrap_angle(in.params[2] * kRadPerDeg - 2.0 * det::atan2(turned.y, turned.w));
}

using ParamsFor = GaitParams (*)(std::span<const Leg>, double speed_m_s, double heading_rad, const Pace& pace);

double ramp(double time_s, double length_s) {
  return length_s > 0.0 ? minimum_jerk(std::min(1.0, time_s / length_s)) : 1.0;
}

// A course as it is seen while it comes in and fades: its root goes from where it was found, and back to standing.
GaitFrame with_blends(const RuleInput& in, const GaitFrame& frame, double content_s, double comes_in_s) {
  const ActionTime& time = in.time;
  const double played_s = content_s * time.takes_s / time.duration_s;
  const double left_s = time.fades_by_s - (time.duration_s - time.left_s + content_s) * time.takes_s / time.duration_s;
  const LegsBelow below{in.character, in.legs, in.environment, frame.short_m};
  Rigid home = brought_along(below, in.world[0], in.base_stands_at, frame.stands_at);
  lower_to_reach_m(below, home);
  GaitFrame seen = frame;
  seen.root = blend_root(below, in.from.root, seen.root, ramp(played_s, comes_in_s));
  seen.root = blend_root(below, home, seen.root, ramp(std::max(0.0, left_s), time.fades_s));
  return seen;
}

bool begins_on_its_feet(const RuleInput& in) {
  constexpr double kStands_m = 0.002;
  for (std::size_t leg = 0; leg < in.legs.size(); ++leg)
    if (length(in.body.seen_soles[leg].p_m - in.body.first_soles[leg].p_m) > kStands_m) return false;
  return true;
}

bool begins_where_it_stands(const RuleInput& in, const GaitParams& params) {
  constexpr double kNear_m = 0.002, kNear_rad = 0.005;
  Gait gait = in.body.gait;
  const Rigid root = gait.at(params, 0.0, in.time.left_s).root;
  const Rigid& now = in.from.root;
  return begins_on_its_feet(in) && length(root.p_m - now.p_m) < kNear_m &&
         rotation_angle(glm::conjugate(root.q) * now.q) < kNear_rad;
}

// The length of a half cycle from `even_s` on, if the course goes straight over level ground there at its full speed
// and has not turned much before; else 0.
double even_for_s(const RuleInput& in, const GaitParams& params, double lasts_s, double even_s) {
  constexpr double kLittle_rad = 20.0 * kRadPerDeg;
  const GaitTiming timing(params, in.legs, lasts_s);
  const double half_s = 0.5 * params.cycle_s;
  const bool is_even = timing.speed_m_s(even_s) == params.speed_m_s && timing.turn_s() <= even_s &&
                       timing.speed_m_s(even_s + half_s) == params.speed_m_s;
  const bool is_straight = params.heading_rad == 0.0 && std::fabs(params.turn_rad) <= kLittle_rad;
  const bool is_plain = in.environment.is_level() && is_straight && params.speed_m_s > 0.0 && begins_on_its_feet(in);
  return is_plain && is_even ? half_s : 0.0;
}

// The greatest speed for whose start and stop there is time (GaitTiming). Walks that need it may hurry.
double speed_in_time_m_s(const GaitParams& params, double lasts_s) {
  constexpr double kHurries_m_s2 = 1.5;
  const double moving_s = std::max(lasts_s - params.cycle_s, 0.5 * lasts_s);
  const double acceleration_m_s2 = params.trot ? params.acceleration_m_s2 : kHurries_m_s2;
  return 0.5 * acceleration_m_s2 * moving_s;
}

GaitParams params_at(const RuleInput& in, ParamsFor params_for, const Pace& pace) {
  const auto at_speed = [&](double speed_m_s) {
    GaitParams params = params_for(in.legs, speed_m_s, heading_rad(in), pace);
    params.lead = static_cast<int>(in.params[0]);
    if (in.has_mass) spare_strength(in.legs, params);
    return params;
  };
  const GaitParams params = at_speed(in.params[1]);
  if (!in.has_mass) return params;
  const double most_m_s = speed_in_time_m_s(params, in.time.left_s);
  return params.speed_m_s > most_m_s ? at_speed(in.params[1] * most_m_s / params.speed_m_s) : params;
}

// The turn to the target, from where the figure faces now; 0 for a point above or below it.
double turn_to_target_rad(const RuleInput& in) {
  constexpr double kNowhere_m = 0.01;
  const Vec3 target_m = in.world_from_start * Vec3(in.params[0], in.params[1], in.params[2]);
  const Vec3 apart_m = target_m - in.stands_at.p_m;
  const bool is_above = std::fabs(apart_m.x) < kNowhere_m && std::fabs(apart_m.z) < kNowhere_m;
  return is_above ? 0.0 : azimuth_rad(in.stands_at, target_m);
}

// `params_at(pace)` gives the parameters at a share of what is asked for, which is `wanted_m_s`.
template <class ParamsAt>
void begin_gait(const RuleInput& in, double wanted_m_s, ParamsAt params_at, Posture& posture) {
  WholeBody& body = in.body;
  begin_course(in);
  const double lasts_s = in.time.left_s, step_s = in.time.duration_s / in.time.takes_s * in.time.frame_s;
  GaitParams params = params_at(Pace{});
  Pace pace_of_params;
  double comes_in_s = std::max(kLeastWay_s, in.time.comes_in_s);
  const auto frame_at = [&](Gait& gait, const Pace& pace, double time_s) {
    if (!(pace == pace_of_params)) params = params_at(pace), pace_of_params = pace;
    return with_blends(in, gait.at(params, time_s, lasts_s), time_s, comes_in_s);
  };
  body.pace = {}, body.comes_at_once = false;
  if (step_s > 0.0) {
    const double even_s = 0.5 * (lasts_s - params.cycle_s);  // half of the time in which it moves
    const CourseTrial course{frame_at, lasts_s, step_s, in.time.frame_s, even_s, even_for_s(in, params, lasts_s, even_s)};
    const auto pace = [&] {
      return fitting_pace(in.character, in.room, body.gait, course, in.world, in.scratch, posture.coords);
    };
    body.pace = pace();
    if (body.pace.speed < 1.0 && in.time.comes_in_s <= 0.0 && begins_where_it_stands(in, params_at(Pace{}))) {
      comes_in_s = 0.0;
      const Pace at_once = pace();
      body.comes_at_once = at_once.speed > body.pace.speed;
      if (body.comes_at_once) body.pace = at_once;
    }
  }
  body.gait_params = params_at(body.pace);
  const GaitTiming timing(body.gait_params, in.legs, lasts_s);
  // On the spot it stands when it has turned, and the speed of its steps was not asked for.
  const bool stays = body.gait_params.speed_m_s == 0.0;
  const bool is_slower = stays ? body.pace.speed < 1e-9 : body.gait_params.speed_m_s < wanted_m_s;
  body.is_slower = is_slower || std::fabs(timing.turn_rad() - body.gait_params.turn_rad) > 1e-9;
  body.lasts_s = stays ? std::min(lasts_s, timing.turn_s() + 1.5 * body.gait_params.cycle_s) : lasts_s;
}

template <class ParamsAt>
void go(const RuleInput& in, double wanted_m_s, ParamsAt params_at, Posture& posture) {
  WholeBody& body = in.body;
  if (body.begun < 0 || (is_root(in) && body.begun != in.took_over)) begin_gait(in, wanted_m_s, params_at, posture);
  follow(in, posture, [&](Gait& gait) {
    return body.pace.speed > 0.0 ? gait.at(body.gait_params, in.time.since_s, body.lasts_s) : gait.stand(0.0);
  });
  if (is_root(in)) in.feedback.is_slower = body.is_slower;
}

// The knees' angle goes with `share`, not the hips' height: that would have knees start from straight with a jerk. Two
// bones of one length and a knee of angle k reach cos(k/2) of their length.
GaitFrame bent(const RuleInput& in, Gait& gait, double share) {
  GaitFrame frame = gait.stand(1.0 - det::cos(share * det::acos(1.0 - in.params[0])));
  frame.root.p_m += frame.root.q * Vec3(0.0, 0.0, -share * in.params[2]) + share * in.body.over_feet_m;
  frame.root.q = frame.root.q * axis_angle(Vec3(1, 0, 0), share * in.params[1] * kRadPerDeg);
  return frame;
}

// The depth of a bend over the progress of its course.
struct BendShape {
  double (*share_at)(double progress);
  double peak;  // the greatest rate of the share, in whole ways for each duration
};

// The time in which a bend comes in: if its use leaves that open, the time of the way of hips and feet to their stand.
double comes_in_s(const RuleInput& in, const Rigid& root) {
  double longest_s = way_s(in.from.root, root);
  for (std::size_t leg = 0; leg < in.legs.size(); ++leg)
    longest_s = std::max(longest_s, way_s(in.body.seen_soles[leg], in.body.first_soles[leg]));
  return in.time.comes_in_s > 0.0 ? std::max(in.time.comes_in_s, kHurriedWay * longest_s) : longest_s;
}

// The peak of the share that is seen: a course that comes in while it bends makes both ways at once.
double peak_with_blends(const BendShape& shape, const ActionTime& time) {
  if (!(time.takes_s > 0.0) || (time.comes_in_s <= 0.0 && time.fades_s <= 0.0)) return shape.peak;
  const int frames = static_cast<int>(std::ceil(time.takes_s / time.frame_s));
  double before = 0.0, most = 0.0;
  for (int n = 1; n <= frames; ++n) {
    const double at_s = std::min(n * time.frame_s, time.takes_s);
    const double share = shape.share_at(at_s / time.takes_s) * ramp(at_s, time.comes_in_s) *
                         ramp(time.takes_s - at_s, time.fades_s);
    most = std::max(most, std::fabs(share - before)), before = share;
  }
  return std::max(shape.peak, most * time.takes_s / time.frame_s);
}

// The share of the deepest bend that standing legs can follow while it comes in and fades, too.
double depth_with_blends(const RuleInput& in, const BendShape& shape, const ActionTime& time, Posture& posture) {
  WholeBody& body = in.body;
  if (!(time.takes_s > 0.0)) return 1.0;
  const auto frame_at = [&](Gait& gait, const Pace& pace, double time_s) {
    const double share = shape.share_at(std::min(1.0, (time.duration_s - time.left_s + time_s) / time.duration_s));
    return with_blends(in, bent(in, gait, pace.speed * body.deepest_bend * share), time_s, time.comes_in_s);
  };
  const double step_s = time.duration_s / time.takes_s * time.frame_s;
  const CourseTrial course{frame_at, time.left_s, step_s, time.frame_s, 0.0, 0.0};
  return fitting_depth(in.character, in.room, body.gait, course, in.world, in.scratch, posture.coords);
}

// The share of the deepest bend on which a figure with mass stays calm, also while it comes in and fades.
double calm_depth(const RuleInput& in, const BendShape& shape, const ActionTime& time) {
  const auto root_at = [&](double deepest, double progress) {
    const GaitFrame frame = bent(in, in.body.gait, deepest * shape.share_at(progress));
    return with_blends(in, frame, progress * time.left_s, time.comes_in_s).root;
  };
  return calm_bend({root_at, inverse(in.world[0]) * center_of_mass_m(in.character, in.world), time.takes_s});
}

void begin_bend(const RuleInput& in, const BendShape& shape, Posture& posture) {
  WholeBody& body = in.body;
  begin_course(in);
  body.over_feet_m = Vec3(0.0), body.is_slower = false;
  const auto frame_at = [&](double part) { return bent(in, body.gait, part); };
  ActionTime time = in.time;
  time.comes_in_s = comes_in_s(in, bent(in, body.gait, shape.share_at(time.progress)).root);
  const Bend whole{frame_at, in.time.takes_s, peak_with_blends(shape, time)};
  if (in.has_mass)
    body.over_feet_m = shift_over_feet_m(in.character, in.legs, whole, in.world, in.scratch, posture.coords);
  body.deepest_bend = deepest_bend(in.character, in.room, whole, in.world, in.scratch, posture.coords);
  if (in.has_mass) {
    const double balanced = balanced_bend(in.character, in.legs, whole, in.world, in.scratch, posture.coords);
    body.deepest_bend = std::min(body.deepest_bend, balanced);
    const double calm = calm_depth(in, shape, time);
    body.is_slower = calm < body.deepest_bend;
    body.deepest_bend = std::min(body.deepest_bend, calm);
  }
  body.deepest_bend *= depth_with_blends(in, shape, time, posture);
  body.lowest = frame_at(body.deepest_bend);
}

void bend(const RuleInput& in, const BendShape& shape, Posture& posture) {
  WholeBody& body = in.body;
  if (is_root(in) && body.begun != in.took_over) begin_bend(in, shape, posture);
  const double share = shape.share_at(in.time.progress);
  follow(in, posture, [&](Gait& gait) { return bent(in, gait, body.deepest_bend * share); });
  if (!is_root(in)) return;
  in.feedback.is_slower = body.is_slower;
  in.feedback.at_range_end = body.deepest_bend < 1.0 && !body.is_slower;
}

double squat_share(double progress) { return 0.5 - 0.5 * det::cos(2.0 * kPi * progress); }

}  // namespace

std::vector<ParamDef> walk_params(const Character&, const Part&) { return params_of_gait(3.0, 1.2); }
bool walk_supports(const Character& character, const Part& part) { return is_root_with_legs(character, part); }
void walk_rule(const RuleInput& in, Posture& posture) {
  go(in, in.params[1], [&](const Pace& pace) { return params_at(in, contort::walk_params, pace); }, posture);
}

std::vector<ParamDef> run_params(const Character&, const Part&) { return params_of_gait(8.0, 3.0); }
bool run_supports(const Character& character, const Part& part) { return is_root_with_legs(character, part); }
void run_rule(const RuleInput& in, Posture& posture) {
  go(in, in.params[1], [&](const Pace& pace) { return params_at(in, contort::run_params, pace); }, posture);
}

std::vector<ParamDef> turn_params(const Character&, const Part&) {
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -1000.0, target.high = 1000.0;
  target.preset = Vec3(2.0, 1.2, -2.0);
  target.domain = Domain::around;
  target.mirrored = Mirrored::point;
  target.help = "Target point, m, from the place where the character stood at first. Its height does not matter.";
  return {target};
}
bool turn_supports(const Character& character, const Part& part) { return is_root_with_legs(character, part); }
void turn_rule(const RuleInput& in, Posture& posture) {
  const bool begins = in.body.begun < 0 || (is_root(in) && in.body.begun != in.took_over);
  const double turn_rad = begins ? turn_to_target_rad(in) : 0.0;
  go(in, 0.0, [&](const Pace& pace) { return contort::turn_params(in.legs, turn_rad, pace.speed); }, posture);
}

std::vector<ParamDef> crouch_params(const Character&, const Part&) { return params_of_bend(); }
bool crouch_supports(const Character& character, const Part& part) { return is_root_with_legs(character, part); }
void crouch_rule(const RuleInput& in, Posture& posture) {
  bend(in, {minimum_jerk, 1.875}, posture);
}

std::vector<ParamDef> squat_params(const Character&, const Part&) { return params_of_bend(); }
bool squat_supports(const Character& character, const Part& part) { return is_root_with_legs(character, part); }
void squat_rule(const RuleInput& in, Posture& posture) {
  bend(in, {squat_share, kPi}, posture);
}

}  // namespace contort
