// Makes the solid of each bone, for collisions and mass.
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

// Returns for each bone its capsules, or boxes for feet that stand on the ground; without masses.
std::vector<BoneBody> fit_bodies(const RiggedFigure& figure);

// Returns true if masses come from de Leva's table of human segments, and not from volume.
bool weighs_as_human(const RiggedFigure& figure);

// Fills in the masses.
void weigh(const RiggedFigure& figure, std::vector<BoneBody>& bodies);

// Returns the lowest point of the shapes, in the bone's frame.
double lowest_of(const std::vector<ColliderShape>& shapes);

}  // namespace contort
