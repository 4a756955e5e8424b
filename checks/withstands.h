// The push that a figure must withstand. A fall after a harder push is a note, not a finding
// (docs/internals/dynamics.md).
#pragma once

#include <optional>

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

// A blow, and the greatest horizontal impulse that the figure must withstand.
struct Blow {
  int frame = 0;
  double impulse_N_s = 0.0;  // horizontal
  double withstands_N_s = 0.0;
  bool is_overpowering() const { return impulse_N_s > withstands_N_s; }
  bool operator==(const Blow&) const = default;
};

// Returns the greatest horizontal impulse along `direction`, which is horizontal and of length 1, before the frame.
//
// The centre of mass of a figure of mass m is at height h, and at the distance d from the edge of the support in that
// direction. The figure tips over the edge if the push gives it a speed above d sqrt(g/h), because its extrapolated
// centre of mass then leaves the support (A. L. Hof et al., "The condition for dynamic stability", J. Biomechanics 38,
// 2005). So it withstands m d sqrt(g/h), with the d of the character at rest, or the value in the character's file
// (`withstands_N_s`). A figure that stands still with less support, as on one leg, withstands what that support allows.
// Loads that it carries do not count.
double withstands_N_s(const Character& character, const Motion& motion, int frame, const Vec3& direction);

// Returns the first blow of the motion that is harder than the figure must withstand.
std::optional<Blow> overpowering_blow(const Character& character, const Motion& motion);

// Returns the first frame that such a blow changes; the number of frames if there is none.
int first_overpowered_frame(const Character& character, const Motion& motion);

}  // namespace contort
