// Finds the soles that bear on the ground, and the corners on which they do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/figure.h"
#include "model/world/environment.h"

namespace contort {

inline constexpr std::uint8_t kAllCorners = 0xF;

// The way in which a sole bears on the ground.
struct Bearing {
  std::uint8_t corners = 0;  // bit k: on corner k of Sole::corners_m
  // The bearing depth from these towards the other corners, as a fraction of the distance: toes and heels give way.
  double depth = 1.0;
  bool operator==(const Bearing&) const = default;
};

class Feet {
 public:
  void begin(const DynamicFigure& figure);

  std::span<const int> soles() const { return soles_; }  // indices of the figure's soles that bear, rising
  const Bearing& bearing(int sole) const { return bearings_[static_cast<std::size_t>(sole)]; }
  bool none() const { return soles_.empty(); }
  bool stands(int sole) const { return bearing(sole).corners != 0; }

  // Is true, by degree of freedom, for those of legs that stand.
  std::span<const char> stands_by_dof() const { return by_dof_; }

  void put(int sole, const Bearing& bearing);
  void clear();

 private:
  void mark();
  const DynamicFigure* figure_ = nullptr;
  std::vector<int> soles_;
  std::vector<Bearing> bearings_;  // by sole
  std::vector<char> by_dof_;
};

// Appends the points on which a sole bears, in its link's frame. If the sole alone bears the figure with this force,
// only points for which its ankle is strong enough.
void add_bearing_points(const Sole& sole, const Bearing& bearing, double alone_N, std::vector<Vec3>& points);

// The place of a sole and its footprint if it landed here: on the ground, with the ground's tilt and its own heading.
Rigid sole_place(const Sole& sole, const DynamicsScratch& dynamics);
Rigid footprint(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// Returns true if all corners of a sole are near the ground and slow. Needs the velocities of inverse_dynamics.
bool lies_still(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// The firmness with which a sole stands in a frame of such stances, (0, 1]: less just after landing and just before
// lifting, so that weight is transferred softly. A leg that is about to leave must not move the hips.
double firmness(std::span<const std::uint8_t> stances, int sole, int frame, double rate_hz);

}  // namespace contort
