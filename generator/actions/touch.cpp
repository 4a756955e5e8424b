// touch: the hand lightly touches the nearest obstacle while something else goes on. Where none is near enough, the arm
// does what it did.
#include <algorithm>

#include "generator/actions/hand.h"
#include "generator/actions/limb_way.h"
#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kTouch_m = 0.005;

Rigid world_from_character(const RuleInput& in) { return in.world[0] * inverse(in.character.rest_root()); }

// Seen from where the hand would be easily, not from where it is: else the touch would follow itself along the wall.
Surface surface_from(const RuleInput& in, const Vec3& grip_m) {
  return in.environment.nearest_obstacle(world_from_character(in) * grip_m);
}

// By how much the easy place of the grip moves when the arm is raised forward, in the character's frame.
Vec3 raised_by_m(const RuleInput& in, double raise_rad) {
  const Vec3 shoulder_m = inverse(world_from_character(in)) * in.world[at(in.part.reach.front().upper)].p_m;
  const Vec3 hanging_m = in.easy_grip_m - shoulder_m;
  return axis_angle(Vec3(1, 0, 0), -raise_rad) * hanging_m - hanging_m;
}

bool is_in_range(const RuleInput& in, const Posture& posture) {
  const std::span<const Joint> own = in.character.joints().subspan(at(in.part.first_joint), at(in.part.joint_count));
  return std::ranges::all_of(own, [&](const Joint& joint) { return contort::is_in_range(joint, posture.coords); });
}

// Returns true if the hand reaches its place on the wall, and the arm keeps its ranges and touches no body there.
bool touches_well(const RuleInput& in, int obstacle, Posture& posture) {
  constexpr int kSettles = 3;  // a wrist comes nearer to its place with every frame
  const Surface surface = surface_from(in, in.easy_grip_m + in.body.raised_by_m);
  if (surface.obstacle != obstacle || surface.distance_m > in.params[0]) return false;
  double missing_m = 0.0;
  in.body.begun = -1;
  for (int pass = 0; pass < kSettles; ++pass)
    missing_m = lay_hand_on(in, surface.point_m, surface.normal, in.body.touch_gap_m, posture);
  const auto part = at(static_cast<int>(&in.part - in.character.parts().data()));
  return missing_m < kTouch_m && is_in_range(in, posture) && in.room.has_room(part, in.world) && find_way(in, posture);
}

// Between the hip and a near wall there is no room for a hand and its elbow: the arm touches the wall farther in front,
// raised as little as possible, or if need be not as closely.
void choose_place(const RuleInput& in, int obstacle, Posture& posture) {
  constexpr double kEasyGap_m = 0.03;
  for (const double gap_m : {in.params[1], kEasyGap_m})
    for (const double raise_deg : {0.0, 20.0, 40.0, 60.0, 80.0}) {
      if (gap_m < in.params[1]) break;
      in.body.raised_by_m = raised_by_m(in, raise_deg * kRadPerDeg), in.body.touch_gap_m = gap_m;
      if (touches_well(in, obstacle, posture)) return;
    }
  in.body.raised_by_m = Vec3(0.0), in.body.touch_gap_m = in.params[1];
  in.body.begun = in.body.way_chosen_in = -1;
}

}  // namespace

std::vector<ParamDef> touch_params(const Character&, const Part&) {
  ParamDef within;
  within.name = "within_m";
  within.low = 0.0, within.high = 3.0;
  within.preset = 0.6;
  within.help = "Greatest distance between the hand and a surface that it touches.";
  ParamDef gap;
  gap.name = "gap_m";
  gap.low = 0.0, gap.high = 0.5;
  gap.preset = 0.03;
  gap.help = "Least distance between the grip and the surface; a hand that needs more keeps more.";
  return {within, gap};
}

bool touch_supports(const Character& character, const Part& part) { return is_arm(character, part); }

void touch_rule(const RuleInput& in, Posture& posture) {
  Surface surface = surface_from(in, in.easy_grip_m);
  if (surface.obstacle < 0 || surface.distance_m > in.params[0]) return;
  if (!in.part.reach.empty() && in.body.begun != in.took_over) choose_place(in, surface.obstacle, posture);
  if (in.body.raised_by_m != Vec3(0.0)) surface = surface_from(in, in.easy_grip_m + in.body.raised_by_m);
  const double missing_m = lay_hand_on(in, surface.point_m, surface.normal, in.body.touch_gap_m, posture);
  if (!in.part.reach.empty()) go_round(in, posture);
  in.feedback.contact = !in.part.reach.empty() && missing_m < kTouch_m;
}

}  // namespace contort
