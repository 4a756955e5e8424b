// Functions that actions of hands share.
#pragma once

#include "generator/actions/action.h"

namespace contort {

// Returns true if a part can reach but does not stand on the ground: it has a reach chain and no sole.
bool is_arm(const Character& character, const Part& part);

// The grip of an arm: its own, or that of the part attached to it; otherwise the tip of its reach chain.
int grip_of(const Character& character, const Part& arm);

// The comfortable place of the grip: below the shoulder, as the arm hangs, at four fifths of its length. In the
// character's frame.
Vec3 easy_grip_m(const Character& character, const Part& arm);

// The hand of an arm, and the attached object with this point.
HeldObject held_object(const Character& character, int arm, int point);

void rest_part(const Character& character, const Part& part, Posture& posture);

// Brings the grip of an arm to a point with the hand's joints at rest. For the hand, which is moved after the arm, it
// sets the rest posture. Returns the distance of the grip from the point.
double bring_grip_to(const RuleInput& in, const Vec3& point_world_m, Posture& posture);

// Brings the grip of an arm to a surface and turns the wrist so that the palm (the grip's +Z) faces it as nearly as it
// can; the swivel is chosen for both when the action takes the arm. The grip is `gap_m` from the surface, or farther if
// hand and forearm would otherwise enter it. For the hand, which is moved after the arm, it uses the arm's result.
// Returns the distance of the grip from its place.
double lay_hand_on(const RuleInput& in, const Vec3& point_m, const Vec3& normal, double gap_m, Posture& posture);

}  // namespace contort
