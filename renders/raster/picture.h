// Writes text and PNG with OpenImageIO.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "model/core/result.h"
#include "renders/image.h"

namespace contort {

struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
};

void fill(Image& image, int x, int y, int width, int height, Rgb8 color);
void paste(Image& image, const Image& piece, int x, int y);  // The piece must lie inside.

// A monospaced font, by its full path, because names of fonts differ between systems. Without the font no text is
// written. `fits` returns the number of characters that fit into a width in pixels.
struct Face {
  std::string path;
  int fits(int width_px, int size_px) const { return static_cast<int>(width_px / (0.6021 * size_px)); }
};

// Returns the text as drawable ASCII. OpenImageIO 2.4 draws other characters wrongly (a degree sign as the digit 0), so
// known signs are spelled out and all others become "?". Text that is too long is cut and ends in "...".
std::string drawable_text(std::string_view text, int max_chars);

// Writes drawable text with the baseline's left end at (x, y). Code: render.no_font.
Result<Done> write_text(Image& image, int x, int y, std::string_view text, int size_px, Rgb8 color, const Face& face);

// PNG bytes, with `comment` in a tEXt chunk named Comment. Equal pictures give equal bytes. Code: render.png.
Result<std::string> png_bytes(const Image& image, const std::string& comment);

}  // namespace contort
