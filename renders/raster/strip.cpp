#include "renders/raster/strip.h"

#include <algorithm>

#include "model/core/output.h"
#include "renders/frames.h"
#include "renders/legend.h"
#include "renders/raster/auto_camera.h"
#include "renders/raster/picture.h"
#include "renders/raster/renderer.h"
#include "renders/raster/rows.h"
#include "renders/raster/sheet.h"
#include "renders/raster/webp.h"
#include "renders/shots.h"

namespace contort {
namespace {

Story story_of(const StripInput& input) {
  return {input.character,   input.motion,   input.finding,   input.ghost,
          input.environment, input.dynamics, input.colliders, input.skin};
}

Result<Done> check_input(const StripInput& input) {
  if (input.tile_width < 96 || input.tile_width > 2048 || input.tile_height < 96 || input.tile_height > 2048)
    return Issue{"render.bad_size", "", "A tile may have 96 to 2048 pixels each way."};
  if (input.columns < 1 || input.columns > 16 || input.tiles < 1 || input.tiles > 64 || input.frames.size() > 64)
    return Issue{"render.bad_size", "", "A strip may have 1 to 64 tiles in 1 to 16 columns."};
  return check_story(story_of(input), input.frames);
}

std::vector<int> frames_of(const StripInput& input) {
  const int count = input.motion.frame_count;
  if (!input.frames.empty()) return input.frames;
  if (!input.finding) return spread_frames(count, input.tiles, input.motion.first_frame);
  return choose_frames(input.finding->first_frame, input.finding->worst_frame, input.finding->last_frame, count,
                       input.tiles);
}

// All data of a strip except its pixels.
struct Plan {
  Shots shots;
  View view;
  StripCamera camera;
  int visible_pixels = 0;
  std::string legend{};  // of all pictures; "" for none
};

Plan plan_strip(const StripInput& input, const std::vector<int>& frames) {
  const Story story = story_of(input);
  Plan plan{take_shots(story, frames), {}, {}, 0};
  add_scenery(story, plan.shots.outlines, plan.shots);
  plan.legend = legend_of(story, plan.shots.lists);
  return plan;
}

// The tile with the finding's worst frame. Without a finding it is the middle one, in which a walking figure is already
// on the stairs.
std::size_t probed_tile(const StripInput& input, const std::vector<int>& frames) {
  if (!input.finding) return frames.size() / 2;
  const auto found = std::lower_bound(frames.begin(), frames.end(), input.finding->worst_frame);
  return std::min(static_cast<std::size_t>(found - frames.begin()), frames.size() - 1);
}

Result<Done> choose_camera(Renderer& renderer, const StripInput& input, double aspect, Plan& plan) {
  const Shots& shots = plan.shots;
  const std::size_t tile = probed_tile(input, shots.frames);
  const Result<ProbedView> view = choose_view(renderer, story_of(input), shots, tile, input.azimuth_rad);
  if (!view) return view.issue();
  plan.view = view->view;
  plan.camera = frame_strip(shots.outlines, shots.anchors, view->view, aspect);
  plan.visible_pixels = view->visible_pixels;
  return Done{};
}

// `count` of the planned frames, from `first` on, in one picture.
struct Tiles {
  std::size_t first = 0, count = 0;
};

Result<Image> draw_tiles(Renderer& renderer, const StripInput& input, const Plan& plan, const Tiles& tiles,
                         StripDone& done) {
  const Shots& shots = plan.shots;
  Sheet sheet(input, static_cast<int>(tiles.count), plan.legend);
  for (std::size_t i = tiles.first; i < tiles.first + tiles.count; ++i) {
    const Camera camera = plan.camera.at(shots.anchors[i]);
    const Result<Image> picture = renderer.draw(shots.lists[i], camera, sheet.picture_width(), sheet.picture_height());
    if (!picture) return picture;
    const auto [x, y] = sheet.add_tile(*picture, shots.frames[i], shots.lists[i].complete);
    done.tiles.push_back({shots.frames[i], camera, x, y, picture->width, picture->height});
  }
  if (sheet.text_issue()) done.warnings.push_back(*sheet.text_issue());
  return std::move(sheet).image();
}

// Writes the animation: a sheet of one tile for each frame of the half second, in their order.
Result<Done> write_clip(Renderer& renderer, const StripInput& input, const View& view, const std::string& path) {
  const int middle = input.finding ? input.finding->worst_frame : (input.motion.first_frame + input.motion.frame_count) / 2;
  const Clip clip = choose_clip(middle, input.motion.frame_count, input.motion.rate_hz);
  Plan plan = plan_strip(input, clip.frames);
  plan.camera = frame_strip(plan.shots.outlines, plan.shots.anchors, view, Sheet::picture_aspect(input));
  renderer.set_meshes(plan.shots.meshes);
  std::vector<Image> images;
  StripDone unused;  // its warnings are the same as the strip's
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    Result<Image> image = draw_tiles(renderer, input, plan, {i, 1}, unused);
    if (!image) return image.issue();
    images.push_back(std::move(image).value());
  }
  const Result<std::string> bytes = webp_bytes(images, clip.milliseconds_per_frame);
  return bytes ? write_output(path, *bytes) : bytes.issue();
}

Result<Done> write_png(const Image& image, const std::string& comment, const std::string& path) {
  const Result<std::string> bytes = png_bytes(image, comment);
  return bytes ? write_output(path, *bytes) : bytes.issue();
}

}  // namespace

struct StripRenderer::State {
  std::unique_ptr<Renderer> renderer;
};

StripRenderer::StripRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
StripRenderer::StripRenderer(StripRenderer&&) noexcept = default;
StripRenderer::~StripRenderer() = default;

Result<StripRenderer> StripRenderer::create(GlSource source) {
  Result<std::unique_ptr<GlBackend>> backend = make_gl_backend(source);
  if (!backend) return backend.issue();
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(std::move(backend).value());
  if (!renderer) return renderer.issue();
  return StripRenderer(std::make_unique<State>(State{std::move(renderer).value()}));
}

std::string StripRenderer::description() const { return state_->renderer->description(); }

Result<StripDone> StripRenderer::render(const StripInput& input, const std::string& png_path,
                                        const std::string& webp_path) {
  if (Result<Done> fine = check_input(input); !fine) return fine.issue();
  Plan plan = plan_strip(input, frames_of(input));
  Renderer& renderer = *state_->renderer;
  renderer.set_meshes(plan.shots.meshes);
  const double aspect = Sheet::picture_aspect(input);
  if (Result<Done> chosen = choose_camera(renderer, input, aspect, plan); !chosen) return chosen.issue();
  StripDone done{plan.shots.frames, plan.visible_pixels, {}, {}};
  const Result<Image> image = draw_tiles(renderer, input, plan, {0, plan.shots.frames.size()}, done);
  if (!image) return image.issue();
  if (Result<Done> written = write_png(*image, input.replay_command, png_path); !written) return written.issue();
  if (webp_path.empty()) return done;
  if (Result<Done> moving = write_clip(renderer, input, plan.view, webp_path); !moving) return moving.issue();
  return done;
}

Result<Image> StripRenderer::render_tile(const StripInput& whole) {
  StripInput input = whole;
  input.frames = {input.finding ? input.finding->worst_frame : input.motion.frame_count / 2};
  if (Result<Done> fine = check_input(input); !fine) return fine.issue();
  Plan plan = plan_strip(input, input.frames);
  plan.legend.clear();  // the pictures of a contact sheet have one size
  state_->renderer->set_meshes(plan.shots.meshes);
  if (Result<Done> chosen = choose_camera(*state_->renderer, input, Sheet::picture_aspect(input), plan); !chosen)
    return chosen.issue();
  StripDone unused;
  return draw_tiles(*state_->renderer, input, plan, {0, 1}, unused);
}

Result<StripDone> StripRenderer::render_rows(const RowsInput& input, const std::string& png_path) {
  if (Result<Done> fine = check_rows(input); !fine) return fine.issue();
  StripDone done{input.frames, 0, {}, {}};
  const Result<Image> image = draw_rows(*state_->renderer, input, done.warnings);
  if (!image) return image.issue();
  if (Result<Done> written = write_png(*image, input.replay_command, png_path); !written) return written.issue();
  return done;
}

Result<Done> write_sheet(std::span<const Image> tiles, int columns, const std::string& png_path) {
  constexpr std::size_t kMostTiles = 1000;
  if (tiles.empty() || tiles.size() > kMostTiles || columns < 1)
    return Issue{"render.bad_size", "", "A contact sheet has 1 to 1000 pictures."};
  const int wide = std::min(columns, static_cast<int>(tiles.size()));
  const int high = (static_cast<int>(tiles.size()) + wide - 1) / wide;
  Image sheet(wide * tiles.front().width, high * tiles.front().height);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const int at = static_cast<int>(i);
    paste(sheet, tiles[i], at % wide * tiles.front().width, at / wide * tiles.front().height);
  }
  return write_png(sheet, "", png_path);
}

Result<StripDone> render_strip(const StripInput& input, const std::string& png_path) {
  Result<StripRenderer> renderer = StripRenderer::create();
  if (!renderer) return renderer.issue();
  return std::move(renderer).value().render(input, png_path);
}

}  // namespace contort
