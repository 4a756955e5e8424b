// Comfortable accelerations of the joints of a figure with mass. Actions that blend, react and reach within these need
// no more than the strength of any joint, and no more than the feet can hold.
#pragma once

#include <vector>

#include "generator/dynamics/figure.h"

namespace contort {

// Values by joint: rad/s^2, m/s^2 for travels; infinite for the root and massless ends. They come from the mass matrix
// at rest. The greatest effort of gravity is subtracted from a joint's strength. The acceleration of one joint also
// moves the zero moment point by no more than a fraction of the distance from below the centre of mass to the edge of
// the soles, and that of a leg takes no more than a fraction of the strength of any joint of the legs that stand
// meanwhile.
std::vector<double> easy_accelerations(const Character& character, const DynamicFigure& figure);

}  // namespace contort
