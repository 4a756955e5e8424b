// An off-screen picture with depth and stencil that can be read back into memory.
#pragma once

#include <cstdint>
#include <vector>

#include "model/core/result.h"
#include "renders/image.h"
#include "renders/raster/gl.h"

namespace contort {

class Target {
 public:
  explicit Target(const Gl& gl) : gl_(gl) {}
  ~Target() { clear(); }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  // Makes this the target of drawing, in this size. Codes: render.bad_size, render.framebuffer.
  Result<Done> use(int width, int height);

  // Returns RGBA, 4 bytes per pixel, rows from the bottom (as in OpenGL).
  const std::vector<std::uint8_t>& read();

 private:
  void clear();

  const Gl& gl_;
  int width_ = 0;
  int height_ = 0;
  unsigned framebuffer_ = 0;
  unsigned renderbuffers_[2] = {0, 0};  // colour, depth and stencil
  std::vector<std::uint8_t> pixels_;
};

// Averages squares of 2 x 2 pixels and reverses the order of rows. This is the anti-aliasing: cheaper than
// multisampling with a software rasterizer, and the same with every driver.
Image halve_and_flip(const std::vector<std::uint8_t>& rgba, int width, int height);

}  // namespace contort
