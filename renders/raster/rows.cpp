#include "renders/raster/rows.h"

#include <utility>

#include "renders/raster/auto_camera.h"
#include "renders/raster/picture.h"

namespace contort {
namespace {

constexpr int kBand = 26;  // height of the band above each row, with its label
constexpr int kGap = 2;
constexpr int kPadding = 8;
constexpr int kLabelSize = 15;
constexpr int kNumberSize = 14;

constexpr Rgb8 kPaper{24, 29, 36};
constexpr Rgb8 kLabelColor{240, 243, 246};
constexpr Rgb8 kNumberColor{40, 48, 60};
constexpr Rgb8 kMarkColor{200, 20, 20};
constexpr int kMarkWidth = 4;

// The labels and tiles of the rows, and the picture on which they are placed.
class Table {
 public:
  Table(const RowsInput& input, std::vector<Issue>& warnings) : input_(input), face_{input.font}, warnings_(warnings) {
    const int columns = static_cast<int>(input.frames.size()), rows = static_cast<int>(input.rows.size());
    image_ = Image(columns * (input.tile_width + kGap) + kGap, rows * (kBand + input.tile_height) + kGap);
    fill(image_, 0, 0, image_.width, image_.height, kPaper);
  }

  void add_label(int row, const std::string& label) {
    write(kPadding, top_of(row) - kBand + 18, image_.width - 2 * kPadding, label, kLabelSize, kLabelColor);
  }

  void add_tile(int row, int column, const Image& picture, int frame, bool complete) {
    const int x = kGap + column * (input_.tile_width + kGap), y = top_of(row);
    paste(image_, picture, x, y);
    const bool marked = input_.marked_frame == frame;
    if (marked) add_mark(x, y);
    const std::string text = std::to_string(frame) + (complete ? "" : " NOT FINITE");
    const int width = input_.tile_width - 2 * kPadding;
    write(x + kPadding, y + 18, width, text, kNumberSize, marked ? kMarkColor : kNumberColor);
    if (marked) write(x + kPadding, y + input_.tile_height - 11, width, input_.mark, kNumberSize, kMarkColor);
  }

  Image image() && { return std::move(image_); }

 private:
  int top_of(int row) const { return kBand + row * (kBand + input_.tile_height); }

  void add_mark(int x, int y) {
    const int width = input_.tile_width, height = input_.tile_height;
    fill(image_, x, y, width, kMarkWidth, kMarkColor);
    fill(image_, x, y + height - kMarkWidth, width, kMarkWidth, kMarkColor);
    fill(image_, x, y, kMarkWidth, height, kMarkColor);
    fill(image_, x + width - kMarkWidth, y, kMarkWidth, height, kMarkColor);
  }

  void write(int x, int y, int width, const std::string& text, int size, Rgb8 color) {
    if (no_text_) return;  // One warning is enough.
    const Result<Done> written =
        write_text(image_, x, y, drawable_text(text, face_.fits(width, size)), size, color, face_);
    if (written) return;
    no_text_ = true;
    warnings_.push_back(written.issue());
  }

  const RowsInput& input_;
  Face face_;
  std::vector<Issue>& warnings_;
  bool no_text_ = false;
  Image image_;
};

template <typename Value>
void append(std::vector<Value>& all, const std::vector<Value>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

// The contents of all rows together, which one camera must frame.
struct Gathered {
  std::vector<Shots> rows;
  std::vector<std::vector<Vec3>> outlines;
  std::vector<Vec3> anchors;
};

Gathered gather(const RowsInput& input) {
  Gathered all;
  for (const StripRow& row : input.rows) {
    all.rows.push_back(take_shots(row.story, input.frames));
    append(all.outlines, all.rows.back().outlines);
    append(all.anchors, all.rows.back().anchors);
  }
  for (std::size_t r = 0; r < all.rows.size(); ++r) add_scenery(input.rows[r].story, all.outlines, all.rows[r]);
  return all;
}

Result<StripCamera> camera_for(Renderer& renderer, const RowsInput& input, const Gathered& all) {
  const Shots& first = all.rows.front();
  renderer.set_meshes(first.meshes);
  const Result<ProbedView> view =
      choose_view(renderer, input.rows.front().story, first, input.frames.size() / 2, input.azimuth_rad);
  if (!view) return view.issue();
  return frame_strip(all.outlines, all.anchors, view->view, static_cast<double>(input.tile_width) / input.tile_height);
}

}  // namespace

Result<Done> check_rows(const RowsInput& input) {
  const auto within = [](auto value, int low, int high) {
    return std::cmp_greater_equal(value, low) && std::cmp_less_equal(value, high);
  };
  if (!within(input.tile_width, 96, 2048) || !within(input.tile_height, 96, 2048))
    return Issue{"render.bad_size", "", "A tile may have 96 to 2048 pixels each way."};
  if (!within(input.rows.size(), 1, 16) || !within(input.frames.size(), 1, 16))
    return Issue{"render.bad_size", "",
                 "found " + std::to_string(input.rows.size()) + " rows of " + std::to_string(input.frames.size()) +
                     " frames, allowed are 1 to 16 of 1 to 16"};
  for (const StripRow& row : input.rows)
    if (Result<Done> fine = check_story(row.story, input.frames); !fine) {
      Issue issue = fine.issue();
      issue.text = row.label + ": " + issue.text;
      return issue;
    }
  return Done{};
}

Result<Image> draw_rows(Renderer& renderer, const RowsInput& input, std::vector<Issue>& warnings) {
  const Gathered all = gather(input);
  const Result<StripCamera> camera = camera_for(renderer, input, all);
  if (!camera) return camera.issue();
  Table table(input, warnings);
  for (std::size_t r = 0; r < all.rows.size(); ++r) {
    const Shots& row = all.rows[r];
    table.add_label(static_cast<int>(r), input.rows[r].label);
    renderer.set_meshes(row.meshes);
    for (std::size_t i = 0; i < row.frames.size(); ++i) {
      const Result<Image> picture =
          renderer.draw(row.lists[i], camera->at(row.anchors[i]), input.tile_width, input.tile_height);
      if (!picture) return picture;
      table.add_tile(static_cast<int>(r), static_cast<int>(i), *picture, row.frames[i], row.lists[i].complete);
    }
  }
  return std::move(table).image();
}

}  // namespace contort
