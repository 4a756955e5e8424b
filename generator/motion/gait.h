// Gait: where root and feet are as functions of time, for any number of legs. A stance foot is fixed in the world; its
// foothold is its home place carried along the path to the middle of that stance, put on the ground. docs/gait.md has
// the equations.
#pragma once

#include <array>
#include <span>

#include "generator/motion/foothold.h"
#include "model/motion/legs.h"
#include "model/world/environment.h"

namespace contort {

struct GaitParams {
  double speed_m_s = 1.0;    // >= 0, of the root; 0 stands
  double heading_rad = 0.0;  // of travel, from where the character faces; it keeps facing the same way
  double cycle_s = 1.0;      // > 0, between two steps of one foot
  double duty = 0.6;         // (0, 1): the share of the cycle in which a foot stands
  double under = 0.5;        // (0, 1): of the stance, when the hips have come over the foot
  int lead = 0;              // the side that stands when it begins: 0 left, 1 right
  bool trot = false;         // run: legs cross-wise together; else rows one after another
  double lift_m = 0.08;      // of a swinging foot, at least
  double lower_m = 0.0;      // the root below its height at rest
  double bounce_m = 0.0;     // of the root, twice in a cycle: up between the feet (run), or down there where < 0 (walk)
  double heel_up_rad = 0.0;  // >= 0, of a sole when it leaves the ground over its toes
  double toes_up_rad = 0.0;  // >= 0, of a sole that comes down on its heel
};

// Sensible parameters for a speed on these legs: longer legs step more slowly, as pendulums do (Froude number).
GaitParams walk_params(std::span<const Leg> legs, double speed_m_s, double heading_rad);
GaitParams run_params(std::span<const Leg> legs, double speed_m_s, double heading_rad);

// The share of the bounce, [0, 1], at so many cycles after a stance began: 0 where the hips are over the foot.
double root_beat(const GaitParams& params, double cycles);

double least_length_m(std::span<const Leg> legs);  // 1 where there is none

struct FootTarget {
  Rigid world_from_sole;
  bool stands = true;
};

struct GaitFrame {
  Rigid root;
  Rigid stands_at;  // a turn about +Y and a place on the plane y = 0: where the course has come to
  std::array<FootTarget, kMaxLegs> feet;
};

// What is being walked: fixed when it begins, and each leg's present step, found once. Caller-owned.
class Gait {
 public:
  // From where the character stands: a turn about +Y and a place on the plane. Feet stay where their soles are seen until
  // they are lifted, put down on the ground below; those too far away from home for that, or not given, are at home.
  void begin(const Character& character, std::span<const Leg> legs, const Environment& environment,
             const Rigid& world_from_start, std::span<const Rigid> seen_soles);

  const std::array<Rigid, kMaxLegs>& first_soles() const { return first_soles_; }
  const Rigid& world_from_start() const { return world_from_start_; }

  // Standing where the feet are, the hips lowered by a share of the shortest leg.
  GaitFrame stand(double lower_share);

  // At a time of a course of duration_s; it begins and ends standing, at the end with every foot at home.
  GaitFrame at(const GaitParams& params, double time_s, double duration_s);

 private:
  struct Step {
    int number = -1000000;  // of the stance before the swing
    Rigid from;             // world_from_sole
    Rigid to;
    double bump_m = 0.0;  // how high it is lifted over the straight way
    double margin = 0.0;  // the share of the swing before it goes forward, and after
    double landed_up = 0.0;  // shares of the largest roll, [0, 1]: of the toes when it came to `from`,
    double leaves_up = 0.0;  // of the heel when it leaves there,
    double lands_up = 0.0;   // of the toes when it comes to `to`
  };
  struct Cycle {
    int step = 0;         // stances since the beginning
    double stance = 0.0;  // how much of it is over, [0, 1]
    double swing = 0.0;   // 0: stands; else how much of the swing is over, (0, 1)
  };

  // How the root's way rises and falls, for the whole course.
  struct Pace {
    double speed_m_s = 0.0;
    double moving_s = 0.0;  // then it stands again
    double up_s = 0.0;
    double down_s = 0.0;
  };

  double phase(const GaitParams& params, const Leg& leg) const;
  double first_lift_s(const GaitParams& params, const Leg& leg) const;
  Pace pace_of(const GaitParams& params, double duration_s) const;
  Cycle cycle_of(const GaitParams& params, const Leg& leg, double time_s) const;
  Vec3 travel(const GaitParams& params, double distance_m) const;
  Rigid foothold(const GaitParams& params, const Pace& pace, const Leg& leg, int step) const;
  Rigid first_sole(const Leg& leg, const Rigid* seen) const;
  Rigid put_down(const Vec3& at, const Foothold& foothold) const;
  Rigid stand_at(const Leg& leg, const Vec3& home_m, const Vec3& direction) const;
  void take_step(const GaitParams& params, const Pace& pace, const Leg& leg, int number, Step& step) const;
  double clear_bump(const Leg& leg, const Step& step, double margin) const;
  void choose_swing(const Leg& leg, double lift_m, Step& step) const;
  double room_to_roll(const Leg& leg, const Rigid& world_from_sole, double end_m, double beyond_m) const;
  void choose_rolling(const GaitParams& params, const Leg& leg, const Rigid& before, Step& step) const;
  static Rigid sole_roll(const GaitParams& params, const Leg& leg, const Step& step, const Cycle& cycle);
  static double travelled_m(const Pace& pace, double time_s);
  static double step_share(const GaitParams& params, const Pace& pace, double time_s);
  Rigid root_over(std::span<const Vec3> feet, std::span<const double> holds, const GaitFrame& frame,
                  const Vec3& travel_m, double lower_m, double bend) const;

  const Character* character_ = nullptr;
  std::span<const Leg> legs_;
  const Environment* environment_ = nullptr;
  Rigid world_from_start_;
  double leg_length_m_ = 1.0;  // of the shortest
  int rows_ = 1;
  std::array<Step, kMaxLegs> steps_;
  std::array<Rigid, kMaxLegs> first_soles_;
};

}  // namespace contort
