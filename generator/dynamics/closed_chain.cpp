#include "generator/dynamics/closed_chain.h"

#include <algorithm>

namespace contort {

std::vector<int> closed_chain(const DynamicFigure& figure) {
  std::vector<int> links = {0};
  for (std::size_t i = 1; i < figure.body.links().size(); ++i)
    for (const Sole& sole : figure.soles)
      if (std::ranges::find(sole.leg_dofs, figure.body.links()[i].dof) != sole.leg_dofs.end())
        links.push_back(static_cast<int>(i));
  return links;
}

}  // namespace contort
