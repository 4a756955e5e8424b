#include "generator/dynamics/joint_ends.h"

#include <algorithm>

#include "generator/dynamics/tracking.h"
#include "model/core/index.h"

namespace contort {

namespace {

// Calls visit(joint, link) for hinges and travels that no foot holds.
template <class Visit>
void for_free(const Character& character, const Multibody& body, std::span<const char> held, Visit visit) {
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (link.kind != JointKind::ball && held[at(link.dof)] == 0) visit(character.joints()[i], link);
  }
}

}  // namespace

void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, double tick_s, std::span<double> acceleration) {
  const double ahead_s = shortest_horizon_s(tick_s);
  const double per_distance = 2.0 / (ahead_s * ahead_s);
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    double& asked = acceleration[at(link.dof)];
    const double then = state.coords[at(link.coord)] + ahead_s * state.velocity[at(link.dof)];
    asked = std::min(asked, per_distance * (joint.high - then));
    asked = std::max(asked, per_distance * (joint.low - then));
  });
}

void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state) {
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    double& rate = state.velocity[at(link.dof)];
    const double now = state.coords[at(link.coord)];
    rate = std::min(rate, std::max(joint.high - now, 0.0) / tick_s);
    rate = std::max(rate, std::min(joint.low - now, 0.0) / tick_s);
  });
}

}  // namespace contort
