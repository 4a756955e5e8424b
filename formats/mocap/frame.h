// Brings an asset into the frame of the rest of the program: metres, +Y up. A file of motion capture does not tell its
// own.
#pragma once

#include "model/asset/asset.h"

namespace contort {

// Lengths of rest poses and of clips, from a unit of so many metres to metres.
void scale_lengths(double unit_m, Asset& asset);

// Turns all roots, at rest and in clips, so that +Z becomes +Y.
void turn_z_up(Asset& asset);

}  // namespace contort
