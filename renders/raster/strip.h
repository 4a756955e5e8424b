// Draws film strips: a finding in one picture.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "checks/fold.h"
#include "model/character/character.h"
#include "model/core/result.h"
#include "model/motion/motion.h"
#include "model/spec/dynamics_desc.h"
#include "model/world/environment.h"
#include "renders/image.h"
#include "renders/raster/gl_backend.h"
#include "renders/shots.h"
#include "renders/strip_views.h"

namespace contort {

inline constexpr char kStripFont[] = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf";

struct StripInput {
  const Character& character;
  const Motion& motion;              // A motion of this character.
  const Finding* finding = nullptr;  // Null: frames are evenly spaced and nothing is highlighted.
  std::string title{};               // "" for the finding's check and subject.
  std::string measured{};            // The finding's value and limit in words; "" for its margin.
  std::string note{};                // Shown prominently after the line of numbers; "" for none.
  std::string replay_command{};      // Stored in the PNG as "Comment".
  int tile_width = 320;              // Pixels, with the caption; in [96, 2048].
  int tile_height = 240;
  int columns = 4;                // In [1, 16].
  int tiles = 8;                  // In [1, 64]; fewer are drawn when the motion has fewer frames.
  const Motion* ghost = nullptr;  // The target motion, drawn translucent behind the figure, frame by frame.
  std::string font = kStripFont;
  const Environment* environment = nullptr;  // Null: a level plane at height 0.
  const DynamicsDesc* dynamics = nullptr;    // The spec's dynamics: its loads are drawn. Null: none.
  std::vector<int> frames{};                 // Empty: `tiles` of them are chosen.
  std::optional<double> azimuth_rad{};       // The direction of view, see View. Empty: the view that shows most of the
                                             // highlight.
  bool colliders = false;                    // true: colliders are drawn as wires around the figure.
  const Skin* skin = nullptr;                // Drawn instead of the parts' meshes.
};

// A row of several motions below one another, such as one action under different conditions.
struct StripRow {
  Story story;
  std::string label;  // above the row, at its start
};

struct RowsInput {
  std::vector<StripRow> rows;           // 1 to 16
  std::vector<int> frames;              // The frames of every row, 1 to 16; their numbers are in the tiles' corners.
  std::optional<double> azimuth_rad{};  // As in StripInput; chosen for the first row's middle tile.
  std::optional<int> marked_frame{};    // Its tiles have a red frame, and show `mark`.
  std::string mark{};
  std::string replay_command{};
  int tile_width = 176;  // Pixels, in [96, 2048].
  int tile_height = 208;
  std::string font = kStripFont;
};

struct StripDone {
  std::vector<int> frames;      // The frames on the tiles.
  int visible_pixels = 0;       // Pixels of the highlight at the worst frame. 0: it is hidden, or visible only through
                                // other pieces.
  std::vector<StripTile> tiles; // filled by render(): the camera of each tile, and its place in the picture
  std::vector<Issue> warnings;  // render.no_font: the picture was written, without text.
};

// Draws many strips with one OpenGL context, because making a context takes about as long as drawing a strip. Only one
// thread at a time may use it.
class StripRenderer {
 public:
  // Creates a renderer. Code: render.no_opengl, and others of Renderer::create.
  static Result<StripRenderer> create(GlSource source = GlSource::any);
  StripRenderer(StripRenderer&&) noexcept;
  ~StripRenderer();

  // Writes one PNG: a header, and a tile per frame. All tiles have one camera, chosen to show the highlight at the
  // worst frame; it moves along only with a figure that travels. Equal input, Mesa and font version: equal bytes. If a
  // path for it is given, it also writes the finding's half second as an animated WebP: one tile, from the same side,
  // at half speed. Codes: render.no_frames, render.wrong_motion, render.bad_frame, render.bad_size, render.png,
  // render.webp, render.gl_error, file.unwritable.
  Result<StripDone> render(const StripInput& input, const std::string& png_path, const std::string& webp_path = "");

  // Draws only the finding's worst frame, as a strip of one tile: a tile of a contact sheet. The codes of render().
  Result<Image> render_tile(const StripInput& input);

  // Draws strips, a row for each motion without header and captions, and one camera for all of them.
  Result<StripDone> render_rows(const RowsInput& input, const std::string& png_path);

  std::string description() const;  // OpenGL version and driver.

 private:
  struct State;
  explicit StripRenderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// Writes pictures of one size beside and below one another, as one PNG. Codes: render.bad_size (none, or more than
// 1,000), render.png, file.unwritable.
Result<Done> write_sheet(std::span<const Image> tiles, int columns, const std::string& png_path);

// Calls StripRenderer::render with a context of its own.
Result<StripDone> render_strip(const StripInput& input, const std::string& png_path);

}  // namespace contort
