// Writes animated pictures with libwebp; OpenImageIO writes only still ones.
#pragma once

#include <span>
#include <string>

#include "model/core/result.h"
#include "renders/image.h"

namespace contort {

// Returns an animated WebP that loops forever. Frames have the first one's size, and each is shown for the given
// time. Equal frames give equal bytes with one version of libwebp. Code: render.webp.
Result<std::string> webp_bytes(std::span<const Image> frames, int milliseconds_per_frame);

}  // namespace contort
