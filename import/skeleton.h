// From the file's nodes and skins to a figure's bones.
#pragma once

#include "import/figure.h"
#include "model/core/result.h"

namespace contort {

// Families, sides and names are filled too; roles are not. Codes import.no_skin, .no_vertices, .unknown_skin,
// .too_many_joints, .flat, .too_large.
Result<RiggedFigure> read_figure(const SkinnedAsset& asset, const ImportOptions& options);

}  // namespace contort
