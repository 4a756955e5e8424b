// A pose as a small drawing of lines in the text of a page: it needs no renderer and no file beside the page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"

namespace contort {

struct StickFigure {
  std::vector<Vec3> points;     // places of joints in the world, +Y up
  std::vector<int> parents{};   // by point: the point that carries it; -1 for none
  std::vector<char> marked{};   // by point: true if the finding is about this joint
  bool operator==(const StickFigure&) const = default;
};

// Returns <svg> markup with the figure seen from its front left, a little from above, and `alt` for those who cannot
// see it. Points that are not finite are left out; "" if fewer than two are left.
std::string stick_figure_svg(const StickFigure& figure, std::string_view alt);

}  // namespace contort
