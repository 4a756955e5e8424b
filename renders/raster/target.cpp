#include "renders/raster/target.h"

#include <GL/glcorearb.h>

#include <string>

namespace contort {
namespace {

constexpr int kLargestSide = 8192;  // llvmpipe allows 16384, but such a large picture is a mistake.

}  // namespace

Result<Done> Target::use(int width, int height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide)
    return Issue{"render.bad_size", "",
                 "A picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels cannot be drawn."};
  gl_.Viewport(0, 0, width, height);
  if (framebuffer_ && width == width_ && height == height_) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    return Done{};
  }
  clear();
  width_ = width;
  height_ = height;
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.GenRenderbuffers(2, renderbuffers_);
  const GLenum formats[] = {GL_RGBA8, GL_DEPTH24_STENCIL8};
  const GLenum places[] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT};
  for (int i = 0; i < 2; ++i) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[i]);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, formats[i], width, height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, renderbuffers_[i]);
  }
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return Done{};
  return Issue{"render.framebuffer", "", "OpenGL cannot draw off screen in this size (" + describe_gl(gl_) + ")."};
}

const std::vector<std::uint8_t>& Target::read() {
  pixels_.resize(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels_.data());
  return pixels_;
}

void Target::clear() {
  if (!framebuffer_) return;
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteRenderbuffers(2, renderbuffers_);
  framebuffer_ = 0;
}

Image halve_and_flip(const std::vector<std::uint8_t>& rgba, int width, int height) {
  Image image(width / 2, height / 2);
  const std::size_t stride = 4 * static_cast<std::size_t>(width);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* lower = rgba.data() + stride * static_cast<std::size_t>(height - 2 - 2 * y);
    std::uint8_t* to = image.pixel(0, y);
    for (int x = 0; x < image.width; ++x, to += 3, lower += 8)
      for (int c = 0; c < 3; ++c)
        to[c] = static_cast<std::uint8_t>((lower[c] + lower[c + 4] + lower[stride + static_cast<std::size_t>(c)] +
                                           lower[stride + static_cast<std::size_t>(c) + 4] + 2) /
                                          4);
  }
  return image;
}

}  // namespace contort
