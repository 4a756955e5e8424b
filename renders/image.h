// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace contort {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // sRGB, 3 bytes per pixel, rows from the top.

  Image() = default;
  Image(int width_px, int height_px)
      : width(width_px),
        height(height_px),
        rgb(3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {}

  std::uint8_t* pixel(int x, int y) { return rgb.data() + offset(x, y); }
  const std::uint8_t* pixel(int x, int y) const { return rgb.data() + offset(x, y); }
  bool operator==(const Image&) const = default;

 private:
  std::size_t offset(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

}  // namespace contort
