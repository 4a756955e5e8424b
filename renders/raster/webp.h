// Moving pictures, by libwebp; OpenImageIO writes only still ones.
#pragma once

#include <span>
#include <string>

#include "model/core/result.h"
#include "renders/image.h"

namespace contort {

// An animated WebP that goes on forever. Frames have the first one's size and are shown for so long each. Equal frames
// give equal bytes with one version of libwebp. Code: render.webp.
Result<std::string> webp_bytes(std::span<const Image> frames, int milliseconds_per_frame);

}  // namespace contort
