// Converts a model from its units and heading to metres, facing +Z.
#pragma once

#include "import/figure.h"
#include "import/owned_surface.h"
#include "model/core/result.h"

namespace contort {

// Scales the figure by the options or by a guess, and turns it in steps of 90 degrees until its left is on +X. Makes
// positions relative to its root, and points relative to their bones. `box` has all vertices, in the file's units.
// Codes import.flat, import.too_large.
Result<Done> to_metres(RiggedFigure& figure, const ModelBox& box, const ImportOptions& options);

}  // namespace contort
