#include "generator/dynamics/leg_stops.h"

#include <algorithm>

#include "generator/dynamics/linear.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr int kPassesOfStops = 3;      // a hinge that is stopped may push another one to its end
constexpr double kAtEnd_rad = 1e-4;    // a hinge this near to its end stays there as long as it is pushed outward
constexpr double kLeastAnswer = 1e-9;  // 1/(kg m^2): a hinge that answers less to its end is held by all others

}  // namespace

void LegStops::find_hinges(const Character& character, const Multibody& body, std::span<const char> held,
                           std::span<const double> target) {
  hinges_.clear();
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (held[at(link.dof)] == 0 || link.kind != JointKind::hinge) continue;
    const Joint& joint = character.joints()[i];
    const double wanted = target[at(link.coord)];
    hinges_.push_back({link.dof, link.coord, std::min(joint.low, wanted), std::max(joint.high, wanted)});
  }
}

void LegStops::stop(const SupportRows& support, int sole_count, double up_N, double tick_s,
                    EquationOfMotion& equation) {
  has_factors_ = false;
  bool any = true;
  for (int pass = 0; pass < kPassesOfStops && any; ++pass) {
    any = false;
    for (const Hinge& hinge : hinges_) {
      const double now = equation.state.coords[at(hinge.coord)], rate = equation.state.velocity[at(hinge.dof)];
      const double least = std::min(hinge.low - now, 0.0) / tick_s, most = std::max(hinge.high - now, 0.0) / tick_s;
      if (rate >= least && rate <= most) continue;
      push(hinge.dof, std::clamp(rate, least, most) - rate, support, sole_count, up_N * tick_s, equation);
      any = true;
    }
  }
  at_ends_.clear();
  for (const Hinge& hinge : hinges_) {
    const double then = equation.state.coords[at(hinge.coord)] + tick_s * equation.state.velocity[at(hinge.dof)];
    if (then < hinge.low + kAtEnd_rad) at_ends_.push_back({hinge.dof, -1.0});
    if (then > hinge.high - kAtEnd_rad) at_ends_.push_back({hinge.dof, 1.0});
  }
}

void LegStops::push(int dof, double missing, const SupportRows& support, int sole_count, double up_N_s,
                    EquationOfMotion& equation) {
  if (!has_factors_) equation.find_factors();
  has_factors_ = true;
  still_.assign(at(support.count), 0.0);
  change_.assign(equation.size(), 0.0);
  change_[at(dof)] = 1.0;
  respond(equation.body(), equation.factors, support, still_, response_, change_);
  if (change_[at(dof)] < kLeastAnswer) return;
  const double impulse = missing / change_[at(dof)];
  for (int sole = 0; sole < sole_count; ++sole) up_N_s += impulse * response_.push[at(6 * sole + 1)];
  if (up_N_s >= 0.0) add_scaled(impulse, change_, equation.state.velocity);
}

}  // namespace contort
