// Chooses a camera that shows the fault. With a fixed camera, the forearm at fault was behind the body in three frames
// of eight.
#pragma once

#include <optional>

#include "renders/raster/renderer.h"
#include "renders/shots.h"

namespace contort {

struct ProbedView {
  View view;
  int visible_pixels = 0;  // pixels of all highlighted pieces, in a picture of 96 x 72; 0: hidden from every side
};

// Draws the frame from each of the views, and chooses the first one in which the least visible highlight group is about
// as visible as in the best view. Views past the scenery are better than views through it. Without highlight it does
// the same for the whole figure; without scenery too, it takes the first view.
Result<ProbedView> best_view(Renderer& renderer, const DrawList& list, std::span<const Triangles> meshes,
                             std::span<const View> views);

// Chooses the view for a picture of a frame, whose meshes are set: the given azimuth, or else the best of views_of().
Result<ProbedView> choose_view(Renderer& renderer, const Story& story, const Shots& shots, std::size_t tile,
                               std::optional<double> azimuth_rad);

}  // namespace contort
