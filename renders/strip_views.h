// Writes the cameras of a film strip's tiles, for a viewer that shows the same pictures.
#pragma once

#include <string>
#include <vector>

#include "model/core/result.h"
#include "renders/camera.h"

namespace contort {

struct StripTile {
  int frame = 0;
  Camera camera{};
  int x = 0, y = 0, width = 0, height = 0;  // place of the picture without its caption, in the strip's pixels
};

// Returns contort.strip/1 (docs/reference/report.md): JSON in one line, safe inside of a <script>. All tiles have the
// same size.
std::string strip_views_json(const std::vector<StripTile>& tiles);

// Writes it as a script beside the strip: "x.png" has "x.js". Code file.unwritable.
Result<Done> write_strip_views(const std::string& png, const std::vector<StripTile>& tiles);

}  // namespace contort
