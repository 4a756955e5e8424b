#include "generator/condition.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {

namespace {

bool is_near(const PlannedInterrupt& interrupt, const Surface& obstacle) {
  return obstacle.obstacle >= 0 && obstacle.distance_m <= interrupt.when.distance_m &&
         (interrupt.obstacle < 0 || interrupt.obstacle == obstacle.obstacle);
}

bool is_steep(const PlannedInterrupt& interrupt, const Vec3& normal) {
  return normal.y < det::cos(interrupt.when.slope_deg * kRadPerDeg);
}

}  // namespace

bool condition_holds(const PlannedInterrupt& interrupt, const Stage& stage, std::span<const Feedback> feedback,
              const Rigid& root) {
  const auto told = [&](bool Feedback::*what) { return feedback[static_cast<std::size_t>(interrupt.part)].*what; };
  switch (interrupt.when.event) {
    case Event::contact: return told(&Feedback::contact);
    case Event::aim_reached: return told(&Feedback::aim_reached);
    case Event::impact: return std::ranges::any_of(feedback, &Feedback::impact);
    case Event::near_obstacle: return is_near(interrupt, stage.environment.nearest_obstacle(root.p_m));
    case Event::ground_steeper:
      return is_steep(interrupt, stage.environment.normal_at(root.p_m.x, root.p_m.z));
    default: return false;
  }
}

}  // namespace contort
