// Converts an asset to metres and +Y up. A file of motion capture does not declare its own unit and axes.
#pragma once

#include "model/asset/asset.h"

namespace contort {

// Scales the lengths of rest poses and clips from a unit of `unit_m` metres to metres.
void scale_lengths(double unit_m, Asset& asset);

// Turns all roots, at rest and in clips, so that +Z becomes +Y.
void turn_z_up(Asset& asset);

}  // namespace contort
