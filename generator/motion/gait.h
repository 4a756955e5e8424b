// Gait: the places of root and feet as functions of time, for any number of legs. A stance foot is fixed in the world;
// its foothold is its home place carried along the path to the middle of that stance, put on the ground.
// docs/internals/gait.md has the equations.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "generator/motion/gait_params.h"
#include "generator/motion/gait_timing.h"
#include "model/motion/legs.h"
#include "generator/motion/swing.h"
#include "model/world/environment.h"

namespace contort {

struct FootTarget {
  Rigid world_from_sole;
  bool stands = true;
};

// The rotation of an arm from hanging down.
struct ArmSwing {
  double forward_rad = 0.0;
  double out_rad = 0.0;
  double elbow_rad = 0.0;
  bool operator==(const ArmSwing&) const = default;
};

struct GaitFrame {
  Rigid root;
  Rigid stands_at;  // the place that the course has reached: a turn about +Y and a point of the plane y = 0
  std::array<FootTarget, kMaxLegs> feet;
  std::array<ArmSwing, 2> arms;  // left and right
  double short_m = 0.0;  // feet that stay too far apart for hips at their height at rest: these are as much lower
};

// Returns the fraction of an additive that a part may show, [0, 1]: 0 for a standing foot and its leg, more for a
// swinging foot the higher it is, and 1 for parts that are neither leg nor foot.
bool is_of_leg(std::span<const Leg> legs, int part);
double freedom_of(const GaitFrame& frame, std::span<const Leg> legs, const Environment& environment, int part);

// The state of a gait: its parameters, fixed when it begins, and each leg's present step, which is computed once. The
// caller owns it.
class Gait {
 public:
  // Begins at the character's place, a turn about +Y and a point of the plane. Feet stay at their given soles, put down
  // on the ground, until they are lifted. Feet without a given sole, or too far from home, begin at home.
  void begin(const Character& character, std::span<const Leg> legs, const Environment& environment,
             const Rigid& world_from_start, std::span<const Rigid> seen_soles);

  const std::array<Rigid, kMaxLegs>& first_soles() const { return first_soles_; }
  const Rigid& world_from_start() const { return world_from_start_; }

  // Returns the frame in which the figure stands on its present feet, with hips lowered by a fraction of the shortest
  // leg.
  GaitFrame stand(double lower_share);

  // Returns the frame at a time of a course of duration_s. The course begins and ends standing, and at its end every
  // foot is at home. Call it with the parameters and the duration of begin().
  GaitFrame at(const GaitParams& params, double time_s, double duration_s);

 private:
  Rigid nominal(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const;
  double missing_gap_m(const Leg& leg, const Rigid& foot, const Leg& other, const Rigid& beside) const;
  double apart_m(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const;
  Rigid foothold(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int step) const;
  void take_step(const GaitParams& params, const GaitTiming& timing, const Leg& leg, int number, Step& step) const;
  Vec3 direction(const GaitParams& params, double turned_rad) const;
  Vec3 middle() const;
  Vec3 turning_way(const GaitParams& params, const GaitTiming& timing, double time_s) const;
  const Vec3& whole_turn(const GaitParams& params, const GaitTiming& timing) const;
  Rigid course(const GaitParams& params, const GaitTiming& timing, double time_s) const;
  void swing_arms(const GaitParams& params, const GaitTiming& timing, double time_s, double moving,
                  GaitFrame& frame) const;
  double below_rest_m(const Rigid& root) const;
  Rigid root_over(std::span<const Vec3> feet, const Rigid& course, double lower_m) const;
  void lower_to_reach(std::span<const double> holds, double bend, GaitFrame& frame) const;

  const Character* character_ = nullptr;
  std::span<const Leg> legs_;
  const Environment* environment_ = nullptr;
  Rigid world_from_start_;
  std::array<Step, kMaxLegs> steps_;
  std::array<Rigid, kMaxLegs> first_soles_;
  mutable std::optional<Vec3> whole_turn_;
};

}  // namespace contort
