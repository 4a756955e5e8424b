// The solid of each bone: what collides, and its mass.
#pragma once

#include <optional>
#include <vector>

#include "import/figure.h"
#include "model/character/inertia.h"

namespace contort {

struct BoneBody {
  std::vector<ColliderShape> shapes;  // in the bone's frame
  double volume_m3 = 0.0;
  BodyInertia inertia;
};

// Capsules, and boxes for feet that stand on the ground; without masses. By bone.
std::vector<BoneBody> fit_bodies(const RiggedFigure& figure);

// Whether it is weighed by de Leva's shares of a human's mass, and not by volume.
bool weighs_as_human(const RiggedFigure& figure);

// Fills the masses.
void weigh(const RiggedFigure& figure, std::vector<BoneBody>& bodies);

// The lowest point of the shapes, in the bone's frame.
double lowest_of(const std::vector<ColliderShape>& shapes);

}  // namespace contort
