// Text and PNG, by OpenImageIO.
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

// A monospaced face by full path: names are looked up differently on every system, and without a face nothing is
// written. `fits` is how many characters have room in so many pixels.
struct Face {
  std::string path;
  int fits(int width_px, int size_px) const { return static_cast<int>(width_px / (0.6021 * size_px)); }
};

// The text that can be drawn: ASCII. OpenImageIO 2.4 draws other characters as wrong ones (a degree sign as the digit
// 0), so signs of ours are spelled out and the rest is "?". Longer text is cut, with "..." at its end.
std::string drawable_text(std::string_view text, int max_chars);

// Writes drawable text with the baseline's left end at (x, y). Code: render.no_font.
Result<Done> write_text(Image& image, int x, int y, std::string_view text, int size_px, Rgb8 color, const Face& face);

// PNG bytes, with `comment` in a tEXt chunk named Comment. Equal pictures give equal bytes. Code: render.png.
Result<std::string> png_bytes(const Image& image, const std::string& comment);

}  // namespace contort
