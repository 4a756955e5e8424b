#include "renders/raster/renderer.h"

#include <GL/glcorearb.h>

#include <algorithm>

#include "renders/raster/layers.h"
#include "renders/raster/matrices.h"

namespace contort {
namespace {

constexpr int kOversampling = 2;  // See halve_and_flip.
constexpr float kGhostAlpha = 0.42f;
constexpr float kFigureAlpha = 0.5f;        // Opacity of the ghost of a whole figure.
constexpr float kMarkAlpha = 0.55f;         // Opacity of translucent marks, the same at all angles.
// Moves the ghost away from the eye, so that a figure at the same place hides it.
constexpr double kGhostSetback_m = 0.03;
constexpr float kObstacleAlpha = 0.42f;     // Through two walls, a figure is still clearly visible.
constexpr float kShineThroughAlpha = 0.4f;  // A greater value would look as if nothing were in front.
constexpr float kShadowAlpha = 0.20f;

bool is_on_top(const DrawInstance& instance) { return instance.on_top; }

// The number of pixels of each group, which is in the red channel.
std::vector<int> count_groups(const std::vector<std::uint8_t>& rgba) {
  std::vector<int> counts(256, 0);
  for (std::size_t i = 0; i < rgba.size(); i += 4) ++counts[rgba[i]];
  return counts;
}

// The number of groups of opaque instances, including group 0.
std::size_t group_count(const DrawList& list) {
  std::size_t count = 1;
  for (const DrawInstance& instance : list.instances)
    if (is_opaque(instance)) count = std::max(count, static_cast<std::size_t>(instance.highlight) + 1);
  return count;
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(std::unique_ptr<GlBackend> backend) {
  if (!backend->make_current())
    return Issue{"render.no_opengl", "", backend->name() + " cannot make its OpenGL context current."};
  std::unique_ptr<Renderer> renderer(new Renderer(std::move(backend)));
  Result<Gl> gl = load_gl(*renderer->backend_);
  if (!gl) return gl.issue();
  renderer->gl_ = *gl;
  if (Result<Done> done = renderer->set_up(); !done) return done.issue();
  if (Result<Done> done = renderer->draw_test_pixel(); !done) return done.issue();
  return renderer;
}

Renderer::~Renderer() {
  if (!gl_.DeleteProgram || !backend_->make_current()) return;
  brush_.destroy();
  backdrop_.destroy();
  meshes_.destroy();
}

Result<Done> Renderer::set_up() {
  if (Result<Done> made = brush_.create(); !made) return made;
  if (Result<Done> made = backdrop_.create(); !made) return made;
  meshes_.create();
  return gl_errors();
}

Result<Done> Renderer::draw_test_pixel() {
  if (Result<Done> ready = target_.use(8, 8); !ready) return ready;
  gl_.ClearColor(1.0f, 0.0f, 1.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  backdrop_.draw_sky();
  const std::uint8_t* middle = target_.read().data() + 4 * (4 * 8 + 4);
  const bool cleared_only = middle[0] == 255 && middle[1] == 0;
  if (middle[3] != 255 || cleared_only)
    return Issue{"render.no_opengl", "", "OpenGL answers but draws nothing (" + description() + ")."};
  return gl_errors();
}

Result<Done> Renderer::gl_errors() const {
  const GLenum error = gl_.GetError();
  if (error == GL_NO_ERROR) return Done{};
  return Issue{"render.gl_error", "", "OpenGL reports error " + std::to_string(error) + " (" + description() + ")."};
}

void Renderer::set_meshes(std::span<const Triangles> meshes) {
  backend_->make_current();
  meshes_.set(meshes);
}

Result<Image> Renderer::draw(const DrawList& list, const Camera& camera, int width, int height) {
  backend_->make_current();
  const int wide = width * kOversampling, high = height * kOversampling;
  const Eye eye(camera, width, height);
  if (Result<Done> ready = draw_shadow_map(list, eye); !ready) return ready.issue();
  if (Result<Done> ready = target_.use(wide, high); !ready) return ready.issue();
  gl_.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  backdrop_.draw_sky();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  brush_.begin_shaded(eye);
  brush_.draw_all(list.instances, eye, {}, is_opaque);
  draw_blended(list, eye);
  gl_.Disable(GL_DEPTH_TEST);
  Image image = halve_and_flip(target_.read(), wide, high);
  if (Result<Done> fine = gl_errors(); !fine) return fine.issue();
  return image;
}

// Draws everything that hides nothing, without writing depth.
void Renderer::draw_blended(const DrawList& list, const Eye& eye) {
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.DepthMask(GL_FALSE);
  draw_ground(list, eye);
  draw_translucent(list, eye);
  draw_obstacles(list, eye);
  draw_ghost_figure(list, eye);
  gl_.Disable(GL_BLEND);
  draw_on_top(list, eye);
  gl_.DepthMask(GL_TRUE);
}

Result<std::vector<int>> Renderer::count_visible(const DrawList& list, const Camera& camera, int width, int height) {
  backend_->make_current();
  if (Result<Done> ready = target_.use(width, height); !ready) return ready.issue();
  const Eye eye(camera, width, height);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  brush_.begin_flat(eye.clip_from_world);
  draw_groups(list, eye);
  draw_hiding(list, eye);
  gl_.Disable(GL_DEPTH_TEST);
  std::vector<int> counts = count_groups(target_.read());
  counts.resize(group_count(list));
  counts[0] = 0;
  if (Result<Done> fine = gl_errors(); !fine) return fine.issue();
  return counts;
}

// Draws opaque instances with the number of their group in the red channel.
void Renderer::draw_groups(const DrawList& list, const Eye& eye) {
  for (const DrawInstance& instance : list.instances) {
    if (!is_opaque(instance)) continue;
    const Vec3 group(instance.highlight / 255.0, 0.0, 0.0);
    brush_.draw(instance, eye, {.color = &group});
  }
}

Result<Done> Renderer::draw_shadow_map(const DrawList& list, const Eye& eye) {
  if (list.scenery.ground.empty()) return Done{};
  if (Result<Done> ready = shadow_map_.use(); !ready) return ready;
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  brush_.begin_flat(eye.light_from_world);
  brush_.draw_all(list.instances, eye, {}, casts_shadow);
  gl_.Disable(GL_DEPTH_TEST);
  return Done{};
}

void Renderer::draw_ground(const DrawList& list, const Eye& eye) {
  if (!list.scenery.ground.empty()) return backdrop_.draw_shaped(list, eye);
  backdrop_.draw_level(list, eye, true);
  draw_shadows(list, eye);
}

void Renderer::draw_shadows(const DrawList& list, const Eye& eye) {
  static constexpr Vec3 kBlack(0.05, 0.07, 0.10);
  const double lifted = list.scenery.level_m - eye.center_m.y + 0.001;
  const glm::mat4 flatten = shadow_matrix(eye.to_light, lifted);
  gl_.Enable(GL_STENCIL_TEST);  // Draws each pixel once; otherwise shadows of several parts would add up.
  gl_.StencilFunc(GL_EQUAL, 0, 0xff);
  gl_.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  brush_.begin_flat(eye.clip_from_world);
  brush_.draw_all(list.instances, eye, {.alpha = kShadowAlpha, .flatten = &flatten, .color = &kBlack}, casts_shadow);
  gl_.Disable(GL_STENCIL_TEST);
}

void Renderer::draw_translucent(const DrawList& list, const Eye& eye) {
  brush_.begin_shaded(eye);
  for (const DrawInstance& instance : list.instances)
    if (is_translucent(instance))
      brush_.draw(instance, eye, instance.mark ? Paint{.alpha = kMarkAlpha} : Paint{.alpha = kGhostAlpha, .rim = 0.45f});
  gl_.DepthFunc(GL_GREATER);  // Only pixels behind other objects.
  brush_.draw_all(list.instances, eye, {.alpha = kShineThroughAlpha}, shines_through);
  gl_.DepthFunc(GL_LESS);
}

// Draws the grey figure as one layer. Depth comes first; otherwise limbs behind limbs would add up to black.
void Renderer::draw_ghost_figure(const DrawList& list, const Eye& eye) {
  const Vec3 back_m = -kGhostSetback_m * glm::normalize(eye.at);
  brush_.begin_shaded(eye);
  for (const bool show : {false, true}) {
    gl_.DepthMask(show ? GL_FALSE : GL_TRUE);
    gl_.DepthFunc(show ? GL_LEQUAL : GL_LESS);
    for (DrawInstance instance : list.instances) {
      if (!is_ghost_figure(instance)) continue;
      instance.world_from_mesh.p_m += back_m;
      brush_.draw(instance, eye, {.alpha = show ? kFigureAlpha : 0.0f});
    }
  }
  gl_.DepthFunc(GL_LESS);
}

void Renderer::draw_on_top(const DrawList& list, const Eye& eye) {
  brush_.begin_flat(eye.clip_from_world);
  gl_.DepthFunc(GL_ALWAYS);
  brush_.draw_all(list.instances, eye, {}, is_on_top);
  gl_.DepthFunc(GL_LESS);
}

// Draws obstacles over everything else, so that they hide nothing. Ground still hides objects below it.
void Renderer::draw_obstacles(const DrawList& list, const Eye& eye) {
  if (list.scenery.obstacles.empty()) return;
  if (list.scenery.ground.empty()) {
    gl_.DepthMask(GL_TRUE);
    backdrop_.draw_level(list, eye, false);
    gl_.DepthMask(GL_FALSE);
  }
  brush_.begin_shaded(eye);
  for (const DrawInstance& instance : list.scenery.obstacles) brush_.draw(instance, eye, {.alpha = kObstacleAlpha});
}

// Draws scenery as if it were opaque, as group 0.
void Renderer::draw_hiding(const DrawList& list, const Eye& eye) {
  static constexpr Vec3 kNoGroup(0.0);
  gl_.Disable(GL_CULL_FACE);  // The eye may be below the ground.
  for (const auto* instances : {&list.scenery.ground, &list.scenery.obstacles})
    for (const DrawInstance& instance : *instances) brush_.draw(instance, eye, {.color = &kNoGroup});
}

}  // namespace contort
