// Lays out a film strip: header, tiles, captions.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renders/image.h"
#include "renders/raster/picture.h"
#include "renders/raster/strip.h"

namespace contort {

class Sheet {
 public:
  // `legend`: a line below the tiles; "" for none.
  Sheet(const StripInput& input, int tiles, const std::string& legend = "");

  int picture_width() const { return input_.tile_width; }
  int picture_height() const { return picture_height(input_); }
  static double picture_aspect(const StripInput& input);

  // Adds the next tile and returns its upper left corner. If `complete` is false, the caption says so.
  struct Corner {
    int x = 0, y = 0;
  };
  Corner add_tile(const Image& picture, int frame, bool complete);

  // Returns the reason why there is no text, if there is none.
  const std::optional<Issue>& text_issue() const { return text_issue_; }
  Image image() && { return std::move(image_); }

 private:
  static int picture_height(const StripInput& input);
  void write_header(bool is_narrow);
  void write_caption(int x, int y, int frame, bool complete);
  void write(int x, int y, int width, std::string_view text, int size, Rgb8 color);

  const StripInput& input_;
  int added_ = 0;
  Face face_;
  std::optional<Issue> text_issue_;
  Image image_;
};

}  // namespace contort
