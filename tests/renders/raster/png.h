// Pictures from files.
#pragma once

#include <OpenImageIO/imageio.h>

#include <stdexcept>
#include <string>

#include "renders/image.h"

namespace contort {

struct Png {
  Image image;
  std::string comment;
};

inline Png read_png(const std::string& path) {
  const auto file = OIIO::ImageInput::open(path);
  if (!file) throw std::runtime_error(OIIO::geterror());
  Png png{Image(file->spec().width, file->spec().height), file->spec().get_string_attribute("Comment")};
  if (file->spec().nchannels != 3) throw std::runtime_error(path + " is not RGB");
  file->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, png.image.rgb.data());
  return png;
}

}  // namespace contort
