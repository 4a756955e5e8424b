#include "generator/dynamics/strength.h"

#include <algorithm>

namespace contort {

namespace {

constexpr double kRounding = 1e-9;  // share of a limit

}  // namespace

double affordable_share(const DynamicFigure& figure, std::span<const double> hold, std::span<const double> efforts) {
  double share = 1.0;
  for (std::size_t i = kRootDofs; i < efforts.size(); ++i) {
    const double limit = efforts[i] > 0.0 ? figure.strength_high[i] : figure.strength_low[i];
    const double over = efforts[i] > 0.0 ? efforts[i] - limit : limit - efforts[i];
    if (!(over > 0.0)) continue;
    const double way = efforts[i] - hold[i];
    const double reached = way != 0.0 ? (limit - hold[i]) / way : 0.0;
    share = std::min(share, std::clamp(reached, 0.0, 1.0));
  }
  return share;
}

bool exceeds_strength(const DynamicFigure& figure, std::span<const double> efforts) {
  for (std::size_t i = kRootDofs; i < efforts.size(); ++i)
    if (efforts[i] > figure.strength_high[i] * (1.0 + kRounding) ||
        efforts[i] < figure.strength_low[i] * (1.0 + kRounding))
      return true;
  return false;
}

Overload greatest_share(const DynamicFigure& figure, std::span<const double> efforts) {
  Overload worst;
  for (std::size_t i = kRootDofs; i < efforts.size(); ++i) {
    const double limit = efforts[i] > 0.0 ? figure.strength_high[i] : figure.strength_low[i];
    const double share = efforts[i] == 0.0 ? 0.0 : limit != 0.0 ? efforts[i] / limit : 1e9;
    if (share > worst.share) worst = {static_cast<int>(i), share};
  }
  return worst;
}

void clamp_to_strength(const DynamicFigure& figure, std::span<double> efforts) {
  std::fill_n(efforts.begin(), kRootDofs, 0.0);
  for (std::size_t i = kRootDofs; i < efforts.size(); ++i)
    efforts[i] = std::clamp(efforts[i], figure.strength_low[i], figure.strength_high[i]);
}

}  // namespace contort
