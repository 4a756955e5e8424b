// Film strips: what a finding looks like, in one picture.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "checks/fold.h"
#include "generator/character/character.h"
#include "generator/core/result.h"
#include "generator/motion/motion.h"
#include "generator/world/environment.h"

namespace contort {

inline constexpr char kStripFont[] = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf";

struct StripInput {
  const Character& character;
  const Motion& motion;              // Of this character.
  const Finding* finding = nullptr;  // Null: frames are evenly spaced and nothing is highlighted.
  std::string title{};               // "" for the finding's check and subject.
  std::string replay_command{};      // Goes into the PNG as "Comment".
  int tile_width = 320;              // Pixels, with the caption; in [96, 2048].
  int tile_height = 240;
  int columns = 4;                // In [1, 16].
  int tiles = 8;                  // In [1, 64]; fewer are drawn when the motion has fewer frames.
  const Motion* ghost = nullptr;  // Drawn translucent behind, frame by frame: the motion that was aimed for.
  std::string font = kStripFont;
  const Environment* environment = nullptr;  // Null: a level plane at height 0.
};

struct StripDone {
  std::vector<int> frames;      // What is on the tiles.
  int visible_pixels = 0;       // Of what is highlighted, at the worst frame. 0: it only shines through, if at all.
  std::vector<Issue> warnings;  // render.no_font: the picture was written, without text.
};

// Draws many strips with one OpenGL context, which costs about as much as a strip. Belongs to one thread at a time.
class StripRenderer {
 public:
  // Code: render.no_opengl, and others of Renderer::create.
  static Result<StripRenderer> create();
  StripRenderer(StripRenderer&&) noexcept;
  ~StripRenderer();

  // Writes one PNG: a header, and a tile per frame. All tiles have one camera, chosen to show the highlight at the
  // worst frame; it moves along only with a figure that travels. Equal input, Mesa and font version: equal bytes.
  // Codes: render.no_frames, render.wrong_motion, render.bad_size, render.png, render.gl_error, file.unwritable.
  Result<StripDone> render(const StripInput& input, const std::string& png_path);

  std::string description() const;  // OpenGL version and driver.

 private:
  struct State;
  explicit StripRenderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

// The same with a context of its own.
Result<StripDone> render_strip(const StripInput& input, const std::string& png_path);

}  // namespace contort
