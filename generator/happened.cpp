#include "generator/happened.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort {

bool happened(const PlannedInterrupt& interrupt, const Stage& stage, std::span<const Feedback> feedback,
              const Rigid& root) {
  const auto told = [&](bool Feedback::*what) { return feedback[static_cast<std::size_t>(interrupt.part)].*what; };
  switch (interrupt.when.event) {
    case Event::contact: return told(&Feedback::contact);
    case Event::aim_reached: return told(&Feedback::aim_reached);
    case Event::impact: return std::ranges::any_of(feedback, &Feedback::impact);
    case Event::near_obstacle: {
      const Surface surface = stage.environment.nearest_obstacle(root.p_m);
      return surface.obstacle >= 0 && surface.distance_m <= interrupt.when.distance_m &&
             (interrupt.obstacle < 0 || interrupt.obstacle == surface.obstacle);
    }
    case Event::ground_steeper: {
      const Vec3 normal = stage.environment.normal_at(root.p_m.x, root.p_m.z);
      return normal.y < det::cos(interrupt.when.slope_deg * kRadPerDeg);
    }
    default: return false;
  }
}

}  // namespace contort
