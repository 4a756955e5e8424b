// The layout of several motions below one another; see RowsInput.
#pragma once

#include <vector>

#include "renders/raster/renderer.h"
#include "renders/raster/strip.h"

namespace contort {

// Codes: those of StripRenderer::render that are about its input.
Result<Done> check_rows(const RowsInput& input);

// Appends to `warnings` why there is no text, if there is none.
Result<Image> draw_rows(Renderer& renderer, const RowsInput& input, std::vector<Issue>& warnings);

}  // namespace contort
