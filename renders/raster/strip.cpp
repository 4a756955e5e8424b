#include "renders/raster/strip.h"

#include <algorithm>
#include <cmath>

#include "generator/core/files.h"
#include "generator/motion/kinematics.h"
#include "renders/frames.h"
#include "renders/raster/auto_camera.h"
#include "renders/raster/renderer.h"
#include "renders/raster/sheet.h"
#include "renders/scenery.h"

namespace contort {
namespace {

constexpr double kAroundFigure_m = 1.0;  // A few steps of a stair.

std::size_t at(int index) { return static_cast<std::size_t>(index); }

Result<Done> check_motion(const Character& character, const Motion& motion) {
  const bool whole = motion.coord_count == character.coord_count() && motion.frame_count >= 0 &&
                     motion.coords.size() == at(motion.frame_count) * at(motion.coord_count) &&
                     motion.root.size() == at(motion.frame_count);
  if (!whole)
    return Issue{"render.wrong_motion", "", "The motion does not belong to the character " + character.name() + "."};
  if (motion.frame_count == 0) return Issue{"render.no_frames", "", "The motion has no frames."};
  return Done{};
}

Result<Done> check_input(const StripInput& input) {
  if (input.tile_width < 96 || input.tile_width > 2048 || input.tile_height < 96 || input.tile_height > 2048)
    return Issue{"render.bad_size", "", "A tile may have 96 to 2048 pixels each way."};
  if (input.columns < 1 || input.columns > 16 || input.tiles < 1 || input.tiles > 64)
    return Issue{"render.bad_size", "", "A strip may have 1 to 64 tiles in 1 to 16 columns."};
  if (Result<Done> fits = check_motion(input.character, input.motion); !fits) return fits;
  return input.ghost ? check_motion(input.character, *input.ghost) : Done{};
}

std::vector<int> frames_of(const StripInput& input) {
  const int count = input.motion.frame_count;
  if (!input.finding) return spread_frames(count, input.tiles);
  return choose_frames(input.finding->first_frame, input.finding->worst_frame, input.finding->last_frame, count,
                       input.tiles);
}

DrawList list_of(const StripInput& input, const Figure& figure, int frame) {
  DrawList list;
  std::vector<Rigid> world(input.character.joints().size());
  const auto add = [&](const Motion& motion, Look look) {
    forward_kinematics(input.character, motion.root[at(frame)], motion.row(frame), world);
    add_figure(list, figure, world, look);
  };
  add(input.motion, Look::solid);
  if (input.ghost && frame < input.ghost->frame_count) add(*input.ghost, Look::ghost);
  return list;
}

// The place on the ground below the root: what a following camera follows.
Vec3 anchor_of(const Motion& motion, const Environment& environment, int frame) {
  const Vec3& root = motion.root[at(frame)].p_m;
  const bool usable = std::fabs(root.x) <= kWorldReach_m && std::fabs(root.z) <= kWorldReach_m;
  return usable ? Vec3(root.x, environment.height_at(root.x, root.z), root.z) : Vec3(0.0);
}

// Everything about a strip but its pixels.
struct Plan {
  Figure figure;
  std::vector<Triangles> meshes;  // The figure's, then the scenery's.
  std::vector<int> frames;
  std::vector<DrawList> lists;  // one per frame
  std::vector<std::vector<Vec3>> outlines;
  std::vector<Vec3> anchors;
  StripCamera camera;
  int visible_pixels = 0;
};

Environment environment_of(const StripInput& input) { return input.environment ? *input.environment : Environment(); }

Plan plan_strip(const StripInput& input) {
  Plan plan;
  const Environment environment = environment_of(input);
  const Highlight highlight = input.finding ? highlighted(input.character, *input.finding) : Highlight{};
  plan.figure = make_figure(input.character, highlight);
  plan.meshes = plan.figure.meshes;
  plan.frames = frames_of(input);
  for (const int frame : plan.frames) {
    plan.lists.push_back(list_of(input, plan.figure, frame));
    plan.outlines.push_back(outline(plan.lists.back(), plan.meshes));
    plan.anchors.push_back(anchor_of(input.motion, environment, frame));
  }
  const Scenery scenery = make_scenery(environment, region_around(plan.outlines), plan.meshes);
  for (DrawList& list : plan.lists) list.scenery = scenery;
  return plan;
}

// The worst frame of the finding. Without one, the middle: a walker is on its stair by then.
std::size_t probed_tile(const StripInput& input, const std::vector<int>& frames) {
  if (!input.finding) return frames.size() / 2;
  const auto found = std::lower_bound(frames.begin(), frames.end(), input.finding->worst_frame);
  return std::min(static_cast<std::size_t>(found - frames.begin()), frames.size() - 1);
}

Result<Done> choose_camera(Renderer& renderer, const StripInput& input, double aspect, Plan& plan) {
  const std::size_t tile = probed_tile(input, plan.frames);
  const std::vector<View> views = views_of(environment_of(input), plan.anchors[tile], kAroundFigure_m);
  const Result<ProbedView> view = best_view(renderer, plan.lists[tile], plan.meshes, views);
  if (!view) return view.issue();
  plan.camera = frame_strip(plan.outlines, plan.anchors, view->view, aspect);
  plan.visible_pixels = view->visible_pixels;
  return Done{};
}

Result<Image> draw_sheet(Renderer& renderer, const StripInput& input, const Plan& plan, std::vector<Issue>& warnings) {
  Sheet sheet(input, static_cast<int>(plan.frames.size()));
  for (std::size_t i = 0; i < plan.frames.size(); ++i) {
    const Camera camera = plan.camera.follows ? moved(plan.camera.camera, plan.anchors[i]) : plan.camera.camera;
    const Result<Image> picture = renderer.draw(plan.lists[i], camera, sheet.picture_width(), sheet.picture_height());
    if (!picture) return picture;
    sheet.add_tile(*picture, plan.frames[i], plan.lists[i].complete);
  }
  if (sheet.text_issue()) warnings.push_back(*sheet.text_issue());
  return std::move(sheet).image();
}

}  // namespace

struct StripRenderer::State {
  std::unique_ptr<Renderer> renderer;
};

StripRenderer::StripRenderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
StripRenderer::StripRenderer(StripRenderer&&) noexcept = default;
StripRenderer::~StripRenderer() = default;

Result<StripRenderer> StripRenderer::create() {
  Result<std::unique_ptr<GlBackend>> backend = make_osmesa_backend();
  if (!backend) return backend.issue();
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(std::move(backend).value());
  if (!renderer) return renderer.issue();
  return StripRenderer(std::make_unique<State>(State{std::move(renderer).value()}));
}

std::string StripRenderer::description() const { return state_->renderer->description(); }

Result<StripDone> StripRenderer::render(const StripInput& input, const std::string& png_path) {
  if (Result<Done> fine = check_input(input); !fine) return fine.issue();
  Plan plan = plan_strip(input);
  Renderer& renderer = *state_->renderer;
  renderer.set_meshes(plan.meshes);
  const double aspect = Sheet::picture_aspect(input);
  if (Result<Done> chosen = choose_camera(renderer, input, aspect, plan); !chosen) return chosen.issue();
  StripDone done{plan.frames, plan.visible_pixels, {}};
  const Result<Image> image = draw_sheet(renderer, input, plan, done.warnings);
  if (!image) return image.issue();
  const Result<std::string> bytes = png_bytes(*image, input.replay_command);
  if (!bytes) return bytes.issue();
  if (Result<Done> written = write_file(png_path, *bytes); !written) return written.issue();
  return done;
}

Result<StripDone> render_strip(const StripInput& input, const std::string& png_path) {
  Result<StripRenderer> renderer = StripRenderer::create();
  if (!renderer) return renderer.issue();
  return std::move(renderer).value().render(input, png_path);
}

}  // namespace contort
