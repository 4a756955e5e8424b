#include "renders/raster/renderer.h"

#include <GL/glcorearb.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "renders/raster/matrices.h"
#include "renders/raster/shaders.h"

namespace contort {
namespace {

constexpr int kOversampling = 2;  // See halve_and_flip.
constexpr float kGhostAlpha = 0.42f;
constexpr float kFigureAlpha = 0.5f;        // Of the ghost of a whole figure.
constexpr float kMarkAlpha = 0.55f;         // Of translucent marks, which are seen as they are and not at their rims.
constexpr double kGhostSetback_m = 0.03;    // Away from the eye: a figure that coincides with its ghost hides it.
constexpr float kObstacleAlpha = 0.42f;     // A figure behind two walls stays clear.
constexpr float kShapedGroundAlpha = 0.6f;  // More hides feet behind a rise, less hides the rise.
constexpr float kShineThroughAlpha = 0.4f;  // More looks as if nothing were in front.
constexpr float kShadowAlpha = 0.20f;

bool is_ghost_figure(const DrawInstance& instance) {
  return instance.ghost && !instance.mark && instance.highlight == 0;
}

bool is_opaque(const DrawInstance& instance) { return !instance.ghost && !instance.on_top; }

// Neither opaque, nor of another kind.
bool is_translucent(const DrawInstance& instance) { return instance.ghost && !is_ghost_figure(instance); }

bool shines_through(const DrawInstance& instance) {
  return instance.highlight > 0 || (instance.mark && !instance.ghost && !instance.on_top);
}

bool casts_shadow(const DrawInstance& instance) { return !instance.ghost && !instance.mark; }

}  // namespace

// The camera as the shaders want it.
struct Renderer::Eye {
  Eye(const Camera& camera, int width, int height)
      : clip_from_world(clip_matrix(camera, static_cast<double>(width) / height)),
        center_m(camera.center_m),
        at(camera.eye_m - camera.center_m),
        // From above the camera's left shoulder: all strips are lit alike, and shadows fall away from the viewer.
        to_light(unit_or(1.1 * Vec3(0, 1, 0) + 0.65 * camera.back - 0.55 * camera.right, Vec3(0, 1, 0))),
        light_from_world(light_matrix(camera, static_cast<double>(width) / height, to_light)) {}
  glm::mat4 clip_from_world;
  Vec3 center_m, at, to_light;
  glm::mat4 light_from_world;
};

struct Renderer::Paint {
  float alpha = 1.0f;
  float rim = 1.0f;
  const glm::mat4* flatten = nullptr;  // For shadows.
  const Vec3* color = nullptr;         // Instead of the instance's own.
};

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
  for (const unsigned program : {solid_.program, flat_.program, background_, ground_, shaped_ground_})
    if (program) gl_.DeleteProgram(program);
  if (vertex_array_) gl_.DeleteVertexArrays(1, &vertex_array_);
  if (no_vertices_) gl_.DeleteVertexArrays(1, &no_vertices_);
  if (buffer_) gl_.DeleteBuffers(1, &buffer_);
}

Result<Done> Renderer::set_up() {
  const std::string level = std::string(shaders::kLevel) + shaders::kGroundFragment,
                    shaped = std::string(shaders::kShaped) + shaders::kGroundFragment;
  const struct {
    unsigned& program;
    const char *vertex, *fragment;
  } programs[] = {{solid_.program, shaders::kSolidVertex, shaders::kSolidFragment},
                  {flat_.program, shaders::kFlatVertex, shaders::kFlatFragment},
                  {background_, shaders::kBackgroundVertex, shaders::kBackgroundFragment},
                  {ground_, shaders::kGroundVertex, level.c_str()},
                  {shaped_ground_, shaders::kSolidVertex, shaped.c_str()}};
  for (const auto& p : programs) {
    const Result<unsigned> made = make_program(gl_, p.vertex, p.fragment);
    if (!made) return made.issue();
    p.program = *made;
  }
  for (Solid* solid : {&solid_, &flat_}) {
    solid->place = gl_.GetUniformLocation(solid->program, "world_from_mesh");
    solid->color = gl_.GetUniformLocation(solid->program, "color");
    solid->rim = gl_.GetUniformLocation(solid->program, "rim");
  }
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenVertexArrays(1, &no_vertices_);  // Core profile draws nothing without a vertex array, even an empty one.
  gl_.GenBuffers(1, &buffer_);
  return gl_errors();
}

Result<Done> Renderer::draw_test_pixel() {
  if (Result<Done> ready = target_.use(8, 8); !ready) return ready;
  gl_.ClearColor(1.0f, 0.0f, 1.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  draw_background();
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
  std::vector<float> vertices;
  ranges_.clear();
  for (const Triangles& mesh : meshes) {
    ranges_.push_back({static_cast<int>(vertices.size() / 6), static_cast<int>(mesh.positions_m.size())});
    for (std::size_t i = 0; i < mesh.positions_m.size(); ++i)
      for (const Vec3& v : {mesh.positions_m[i], mesh.normals[i]})
        for (int axis = 0; axis < 3; ++axis) vertices.push_back(static_cast<float>(v[axis]));
  }
  backend_->make_current();
  gl_.BindVertexArray(vertex_array_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices.size() * sizeof(float)), vertices.data(),
                 GL_STATIC_DRAW);
  for (unsigned attribute = 0; attribute < 2; ++attribute) {
    const auto* offset = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(attribute * 3 * sizeof(float)));
    gl_.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 6 * sizeof(float), offset);
    gl_.EnableVertexAttribArray(attribute);
  }
}

Result<Image> Renderer::draw(const DrawList& list, const Camera& camera, int width, int height) {
  backend_->make_current();
  const int wide = width * kOversampling, high = height * kOversampling;
  const Eye eye(camera, width, height);
  if (Result<Done> ready = draw_shadow_map(list, eye); !ready) return ready.issue();
  if (Result<Done> ready = target_.use(wide, high); !ready) return ready.issue();
  gl_.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  draw_background();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  begin_solid(eye);
  for (const DrawInstance& instance : list.instances)
    if (is_opaque(instance)) draw_instance(instance, eye, {});
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
  gl_.Disable(GL_DEPTH_TEST);
  Image image = halve_and_flip(target_.read(), wide, high);
  if (Result<Done> fine = gl_errors(); !fine) return fine.issue();
  return image;
}

Result<std::vector<int>> Renderer::count_visible(const DrawList& list, const Camera& camera, int width, int height) {
  backend_->make_current();
  if (Result<Done> ready = target_.use(width, height); !ready) return ready.issue();
  const Eye eye(camera, width, height);
  gl_.ClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  begin_flat(eye.clip_from_world);
  std::vector<int> counts(1, 0);
  for (const DrawInstance& instance : list.instances) {
    if (!is_opaque(instance)) continue;
    const Vec3 group(instance.highlight / 255.0, 0.0, 0.0);
    counts.resize(std::max(counts.size(), static_cast<std::size_t>(instance.highlight) + 1), 0);
    draw_instance(instance, eye, {.color = &group});
  }
  draw_hiding(list, eye);
  gl_.Disable(GL_DEPTH_TEST);
  const std::vector<std::uint8_t>& pixels = target_.read();
  for (std::size_t i = 0; i < pixels.size(); i += 4) ++counts[pixels[i]];
  counts[0] = 0;
  if (Result<Done> fine = gl_errors(); !fine) return fine.issue();
  return counts;
}

void Renderer::draw_background() {
  gl_.UseProgram(background_);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindVertexArray(no_vertices_);
  gl_.Uniform4f(gl_.GetUniformLocation(background_, "bottom"), 0.800f, 0.822f, 0.850f, 1.0f);
  gl_.Uniform4f(gl_.GetUniformLocation(background_, "top"), 0.938f, 0.949f, 0.962f, 1.0f);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

Result<Done> Renderer::draw_shadow_map(const DrawList& list, const Eye& eye) {
  if (list.scenery.ground.empty()) return Done{};
  if (Result<Done> ready = shadow_map_.use(); !ready) return ready;
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LESS);
  begin_flat(eye.light_from_world);
  for (const DrawInstance& instance : list.instances)
    if (casts_shadow(instance)) draw_instance(instance, eye, {});
  gl_.Disable(GL_DEPTH_TEST);
  return Done{};
}

void Renderer::draw_ground(const DrawList& list, const Eye& eye) {
  if (list.scenery.ground.empty()) {
    draw_level_ground(list, eye, true);
    draw_shadows(list, eye);
    return;
  }
  gl_.DepthMask(GL_TRUE);  // Depth alone first: of ground behind ground, only what is nearest may be seen.
  draw_shaped_ground(list, eye, false);
  gl_.DepthMask(GL_FALSE);
  gl_.DepthFunc(GL_LEQUAL);
  draw_shaped_ground(list, eye, true);
  gl_.DepthFunc(GL_LESS);
}

void Renderer::begin_ground(unsigned program, const DrawList& list, const Eye& eye, bool show) {
  const auto set1 = [&](const char* name, double value) {
    gl_.Uniform1f(gl_.GetUniformLocation(program, name), static_cast<float>(value));
  };
  gl_.UseProgram(program);
  gl_.Disable(GL_CULL_FACE);
  set_matrix(program, "clip_from_world", eye.clip_from_world);
  set3(program, "middle", Vec3(0.0, list.scenery.level_m - eye.center_m.y, 0.0));
  set3(program, "world_origin", -eye.center_m);
  set1("reach", 0.75 * glm::length(eye.at));
  set1("show", show ? 1.0 : 0.0);
}

void Renderer::draw_level_ground(const DrawList& list, const Eye& eye, bool show) {
  begin_ground(ground_, list, eye, show);
  gl_.BindVertexArray(no_vertices_);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Renderer::draw_shaped_ground(const DrawList& list, const Eye& eye, bool show) {
  begin_ground(shaped_ground_, list, eye, show);
  gl_.BindVertexArray(vertex_array_);
  set3(shaped_ground_, "to_light", eye.to_light);
  set_matrix(shaped_ground_, "light_from_world", eye.light_from_world);
  shadow_map_.bind();
  for (const DrawInstance& instance : list.scenery.ground) {
    set_matrix(shaped_ground_, "world_from_mesh", float_matrix(instance.world_from_mesh, eye.center_m));
    set_color(gl_.GetUniformLocation(shaped_ground_, "color"), instance.color, kShapedGroundAlpha);
    draw_range(instance);
  }
}

void Renderer::draw_shadows(const DrawList& list, const Eye& eye) {
  static constexpr Vec3 kBlack(0.05, 0.07, 0.10);
  const double lifted = list.scenery.level_m - eye.center_m.y + 0.001;
  const glm::mat4 flatten = shadow_matrix(eye.to_light, lifted);
  gl_.Enable(GL_STENCIL_TEST);  // Each pixel once, or shadows of several parts would add up.
  gl_.StencilFunc(GL_EQUAL, 0, 0xff);
  gl_.StencilOp(GL_KEEP, GL_KEEP, GL_INCR);
  begin_flat(eye.clip_from_world);
  for (const DrawInstance& instance : list.instances)
    if (casts_shadow(instance))
      draw_instance(instance, eye, {.alpha = kShadowAlpha, .flatten = &flatten, .color = &kBlack});
  gl_.Disable(GL_STENCIL_TEST);
}

void Renderer::draw_translucent(const DrawList& list, const Eye& eye) {
  begin_solid(eye);
  for (const DrawInstance& instance : list.instances)
    if (is_translucent(instance))
      draw_instance(instance, eye,
                    instance.mark ? Paint{.alpha = kMarkAlpha} : Paint{.alpha = kGhostAlpha, .rim = 0.45f});
  gl_.DepthFunc(GL_GREATER);  // Only where something is in front.
  for (const DrawInstance& instance : list.instances)
    if (shines_through(instance)) draw_instance(instance, eye, {.alpha = kShineThroughAlpha});
  gl_.DepthFunc(GL_LESS);
}

// Grey and of one layer: depth alone first, or limbs behind limbs would add up to black.
void Renderer::draw_ghost_figure(const DrawList& list, const Eye& eye) {
  const Vec3 back_m = -kGhostSetback_m * glm::normalize(eye.at);
  begin_solid(eye);
  for (const bool show : {false, true}) {
    gl_.DepthMask(show ? GL_FALSE : GL_TRUE);
    gl_.DepthFunc(show ? GL_LEQUAL : GL_LESS);
    for (DrawInstance instance : list.instances) {
      if (!is_ghost_figure(instance)) continue;
      instance.world_from_mesh.p_m += back_m;
      draw_instance(instance, eye, {.alpha = show ? kFigureAlpha : 0.0f});
    }
  }
  gl_.DepthFunc(GL_LESS);
}

void Renderer::draw_on_top(const DrawList& list, const Eye& eye) {
  begin_flat(eye.clip_from_world);
  gl_.DepthFunc(GL_ALWAYS);
  for (const DrawInstance& instance : list.instances)
    if (instance.on_top) draw_instance(instance, eye, {});
  gl_.DepthFunc(GL_LESS);
}

// Over all else, so that nothing hides behind them; ground still hides what is below it.
void Renderer::draw_obstacles(const DrawList& list, const Eye& eye) {
  if (list.scenery.obstacles.empty()) return;
  if (list.scenery.ground.empty()) {
    gl_.DepthMask(GL_TRUE);
    draw_level_ground(list, eye, false);
    gl_.DepthMask(GL_FALSE);
  }
  begin_solid(eye);
  for (const DrawInstance& instance : list.scenery.obstacles) draw_instance(instance, eye, {.alpha = kObstacleAlpha});
}

// Scenery as if nothing were translucent, as group 0.
void Renderer::draw_hiding(const DrawList& list, const Eye& eye) {
  static constexpr Vec3 kNoGroup(0.0);
  gl_.Disable(GL_CULL_FACE);  // The eye may be below the ground.
  for (const auto* instances : {&list.scenery.ground, &list.scenery.obstacles})
    for (const DrawInstance& instance : *instances) draw_instance(instance, eye, {.color = &kNoGroup});
}

void Renderer::begin_solid(const Eye& eye) {
  begin(solid_, eye.clip_from_world);
  set3(solid_.program, "eye", eye.at);
  set3(solid_.program, "to_light", eye.to_light);
}

void Renderer::begin_flat(const glm::mat4& clip_from_world) { begin(flat_, clip_from_world); }

void Renderer::begin(const Solid& solid, const glm::mat4& clip_from_world) {
  begun_ = &solid;
  gl_.UseProgram(solid.program);
  gl_.BindVertexArray(vertex_array_);
  gl_.Enable(GL_CULL_FACE);  // Counter-clockwise seen from outside; halves the work.
  set_matrix(solid.program, "clip_from_world", clip_from_world);
}

void Renderer::draw_instance(const DrawInstance& instance, const Eye& eye, const Paint& paint) {
  glm::mat4 world_from_mesh = float_matrix(instance.world_from_mesh, eye.center_m);
  if (paint.flatten) world_from_mesh = *paint.flatten * world_from_mesh;
  gl_.UniformMatrix4fv(begun_->place, 1, GL_FALSE, glm::value_ptr(world_from_mesh));
  set_color(begun_->color, paint.color ? *paint.color : instance.color, paint.alpha);
  gl_.Uniform1f(begun_->rim, paint.rim);  // Without effect where the program has none.
  draw_range(instance);
}

void Renderer::draw_range(const DrawInstance& instance) {
  CONTORT_ASSERT(static_cast<std::size_t>(instance.mesh) < ranges_.size());
  const Range& range = ranges_[static_cast<std::size_t>(instance.mesh)];
  gl_.DrawArrays(GL_TRIANGLES, range.first, range.count);
}

void Renderer::set_matrix(unsigned program, const char* name, const glm::mat4& matrix) {
  gl_.UniformMatrix4fv(gl_.GetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(matrix));
}

void Renderer::set3(unsigned program, const char* name, const Vec3& v) {
  gl_.Uniform3f(gl_.GetUniformLocation(program, name), static_cast<float>(v.x), static_cast<float>(v.y),
                static_cast<float>(v.z));
}

void Renderer::set_color(int location, const Vec3& color, float alpha) {
  gl_.Uniform4f(location, static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z), alpha);
}

}  // namespace contort
