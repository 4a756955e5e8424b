// The feet of a target motion: the places of its soles in each frame, and the corners that bear. A foot that rolls over
// its heel or its toes bears on two corners.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/dynamics/feet.h"
#include "generator/dynamics/support.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

class ContactPlan {
 public:
  ContactPlan() = default;
  ContactPlan(const Character& character, const DynamicFigure& figure, const Environment& environment,
              const Motion& motion);

  int frame_count() const { return frame_count_; }
  // A sole bears on the corners that are near the ground and stay in place, and then as long as these are less than 2
  // cm above the ground. At some time in between one of them comes within 4 mm of it.
  const Bearing& bearing(int frame, int sole) const { return bearings_[index(frame, sole)]; }
  // Bit i: sole i bears on at least one corner.
  std::uint8_t standing(int frame) const;
  const Rigid& sole(int frame, int sole) const { return soles_[index(frame, sole)]; }
  // Frames to the nearest one in which the sole bears: 0 while it does.
  int airborne(int frame, int sole) const { return airborne_[index(frame, sole)]; }
  // Copies the places of soles that do not bear from a motion.
  void move_airborne(const Character& character, const DynamicFigure& figure, const Motion& motion);
  // The sole at a time in frames, interpolated by cubics. Before the first frame and after the last one it stays in
  // place, with the rates of these frames.
  SoleMotion sole_at(double frame, int sole) const;
  // m/s^2, rad/s^2, world axes: interpolated between the frames' accelerations, which come from neighbouring frames.
  void acceleration_at(double frame, int sole, Vec3& linear, Vec3& angular) const;

 private:
  std::size_t index(int frame, int sole) const { return static_cast<std::size_t>(frame * sole_count_ + sole); }
  void drop_touches(int sole, std::span<const double> lowest_m);
  void count_airborne();
  SoleMotion slope(int frame, int sole) const;
  SoleMotion bend(int frame, int sole) const;

  double rate_hz_ = 60.0;
  int frame_count_ = 0;
  int sole_count_ = 0;
  std::vector<Bearing> bearings_;  // frames x soles
  std::vector<int> airborne_;      // frames x soles
  std::vector<Rigid> soles_;       // frames x soles
};

}  // namespace contort
