// The accelerations that joints of a figure with mass may have at ease. Actions that blend, react and reach within
// these ask of no joint more than its strength, and of the feet no more than they can hold.
#pragma once

#include <vector>

#include "generator/dynamics/figure.h"

namespace contort {

// By joint: rad/s^2, m/s^2 of travels; of the root and of massless ends: infinite. From the mass matrix at rest. Of a
// joint's strength, what gravity may take at worst is left out. The acceleration of one joint also moves the zero
// moment point by no more than a share of the way from below the centre of mass to the edge of the soles, and one of a
// leg takes no more than a share of the strength of any joint of the legs that stand meanwhile.
std::vector<double> easy_accelerations(const Character& character, const DynamicFigure& figure);

}  // namespace contort
