// Which soles stand and where they were put down.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/dynamics/figure.h"
#include "generator/dynamics/support.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

class Feet {
 public:
  void begin(const DynamicFigure& figure);

  std::span<const int> soles() const { return soles_; }  // of the figure, in the order in which they landed
  std::span<const StandingFoot> places() const { return places_; }
  bool none() const { return soles_.empty(); }
  bool stands(int sole) const;

  // By freedom: whether it is of a leg that stands.
  std::span<const char> stands_by_dof() const { return by_dof_; }

  void land(int sole, const Rigid& world_from_sole);
  void lift(int sole);
  void clear();

 private:
  void mark();
  const DynamicFigure* figure_ = nullptr;
  std::vector<int> soles_;
  std::vector<StandingFoot> places_;
  std::vector<char> by_dof_;
};

// The place of a sole, and its footprint if it comes down here: on the ground, tilted like it, turned as it was.
Rigid sole_place(const Sole& sole, const DynamicsScratch& dynamics);
Rigid footprint(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// The height of a sole's middle above the ground.
double gap_m(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// Whether all corners of a sole are near the ground and slow. Needs the velocities of inverse_dynamics.
bool lies_still(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// Which soles stand in each frame of a motion: near the ground, level with it, and hardly moving. Bit i: sole i.
std::vector<std::uint8_t> planned_stances(const Character& character, const DynamicFigure& figure,
                                          const Environment& environment, const Motion& motion);

// The firmness with which a sole stands in a frame of such stances, (0, 1]: less from when it landed and until it is
// lifted, so that weight comes and goes softly. A leg that is about to leave must not move the hips.
double firmness(std::span<const std::uint8_t> stances, int sole, int frame, double rate_hz);

// That, squared, by sole; and by freedom how easily legs give way (support.h): the less firm, the more.
void soften(const DynamicFigure& figure, std::span<const std::uint8_t> stances, int frame, double rate_hz,
            std::span<double> firmness_squared, std::span<double> ease);

}  // namespace contort
