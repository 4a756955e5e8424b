// Reads a figure's bones from the nodes and skins of a file.
#pragma once

#include "import/figure.h"
#include "model/core/result.h"

namespace contort {

// Also fills in families, sides and names, but not roles. Codes import.no_skin, .no_vertices, .unknown_skin,
// .too_many_joints, .flat, .too_large.
Result<RiggedFigure> read_figure(const SkinnedAsset& asset, const ImportOptions& options);

}  // namespace contort
