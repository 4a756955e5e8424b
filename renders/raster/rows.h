// Lays out several motions below one another; see RowsInput.
#pragma once

#include <vector>

#include "renders/raster/renderer.h"
#include "renders/raster/strip.h"

namespace contort {

// Checks the input. It has the codes of StripRenderer::render for bad input.
Result<Done> check_rows(const RowsInput& input);

// Draws the rows. If text cannot be drawn, the reason is appended to `warnings`.
Result<Image> draw_rows(Renderer& renderer, const RowsInput& input, std::vector<Issue>& warnings);

}  // namespace contort
