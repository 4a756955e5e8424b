// The push that a figure shall withstand: falls after a harder one are notes, and no findings (docs/dynamics.md).
#pragma once

#include <optional>

#include "model/character/character.h"
#include "model/motion/motion.h"

namespace contort {

// A blow, and the greatest horizontal impulse that need not fell the figure.
struct Blow {
  int frame = 0;
  double impulse_N_s = 0.0;  // horizontal
  double withstands_N_s = 0.0;
  bool is_overpowering() const { return impulse_N_s > withstands_N_s; }
  bool operator==(const Blow&) const = default;
};

// A figure of mass m whose centre of mass is h above the ground, and d inside the edge of its support in the direction
// of a push, tips over that edge if a push gives it more than d sqrt(g/h): its extrapolated centre of mass then leaves the support (A. L. Hof et
// al., "The condition for dynamic stability", J. Biomechanics 38, 2005). So it withstands m d sqrt(g/h), with d of the
// character at rest, or the push that the character's file says (`withstands_N_s`). A figure that stands still with
// less support, as on one leg, withstands what that support allows.
// `direction` is horizontal and of length 1.
double withstands_N_s(const Character& character, const Motion& motion, int frame, const Vec3& direction);

// The first blow of the motion that is harder.
std::optional<Blow> overpowering_blow(const Character& character, const Motion& motion);

// The first frame that such a blow changes; the number of frames without one.
int first_overpowered_frame(const Character& character, const Motion& motion);

}  // namespace contort
