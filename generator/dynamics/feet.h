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
  double depth = 1.0;        // from these towards the other corners, as a share of the way: toes and heels give way
  bool operator==(const Bearing&) const = default;
};

class Feet {
 public:
  void begin(const DynamicFigure& figure);

  std::span<const int> soles() const { return soles_; }  // of the figure, rising
  const Bearing& bearing(int sole) const { return bearings_[static_cast<std::size_t>(sole)]; }
  bool none() const { return soles_.empty(); }
  bool stands(int sole) const { return bearing(sole).corners != 0; }

  // By freedom: whether it is of a leg that stands.
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

// The points on which a sole bears, in its link's frame; where it bears the whole figure with this force, those that
// its ankle is strong enough for. Appends.
void add_bearing_points(const Sole& sole, const Bearing& bearing, double alone_N, std::vector<Vec3>& points);

// The place of a sole, and its footprint if it comes down here: on the ground, tilted like it, turned as it was.
Rigid sole_place(const Sole& sole, const DynamicsScratch& dynamics);
Rigid footprint(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// Whether all corners of a sole are near the ground and slow. Needs the velocities of inverse_dynamics.
bool lies_still(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment);

// The firmness with which a sole stands in a frame of such stances, (0, 1]: less from when it landed and until it is
// lifted, so that weight comes and goes softly. A leg that is about to leave must not move the hips.
double firmness(std::span<const std::uint8_t> stances, int sole, int frame, double rate_hz);

}  // namespace contort
