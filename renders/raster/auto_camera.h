// A camera that sees the fault. A fixed one had the offending forearm behind the body in three frames of eight.
#pragma once

#include <optional>

#include "renders/raster/renderer.h"
#include "renders/shots.h"

namespace contort {

struct ProbedView {
  View view;
  int visible_pixels = 0;  // of all highlighted pieces, in a picture of 96 x 72; 0: hidden from every side
};

// Looks at the frame from each of the views. Takes the first from which the least visible highlight group shows about
// as well as from anywhere; a view past the scenery is better than one through it. Without highlight the same for the
// whole figure, and where there is no scenery, the first of all.
Result<ProbedView> best_view(Renderer& renderer, const DrawList& list, std::span<const Triangles> meshes,
                             std::span<const View> views);

// For a picture of a frame, whose meshes are set: from the azimuth that is given, else the best of views_of.
Result<ProbedView> choose_view(Renderer& renderer, const Story& story, const Shots& shots, std::size_t tile,
                               std::optional<double> azimuth_rad);

}  // namespace contort
