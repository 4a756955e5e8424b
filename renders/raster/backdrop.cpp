#include "renders/raster/backdrop.h"

#include <GL/glcorearb.h>

#include <string>

#include "renders/raster/matrices.h"
#include "renders/raster/shaders.h"
#include "renders/raster/uniforms.h"

namespace contort {

namespace {

// With a greater value the ground hides feet behind a rise; with a smaller one the rise is hardly visible.
constexpr float kShapedGroundAlpha = 0.6f;

}  // namespace

Result<Done> Backdrop::create() {
  const std::string level = std::string(shaders::kLevel) + shaders::kGroundFragment,
                    shaped = std::string(shaders::kShaped) + shaders::kGroundFragment;
  const struct {
    unsigned& program;
    const char *vertex, *fragment;
  } programs[] = {{sky_, shaders::kBackgroundVertex, shaders::kBackgroundFragment},
                  {level_, shaders::kGroundVertex, level.c_str()},
                  {shaped_, shaders::kSolidVertex, shaped.c_str()}};
  for (const auto& p : programs) {
    const Result<unsigned> made = make_program(gl_, p.vertex, p.fragment);
    if (!made) return made.issue();
    p.program = *made;
  }
  gl_.GenVertexArrays(1, &no_vertices_);
  return Done{};
}

void Backdrop::destroy() {
  for (const unsigned program : {sky_, level_, shaped_})
    if (program) gl_.DeleteProgram(program);
  if (no_vertices_) gl_.DeleteVertexArrays(1, &no_vertices_);
}

void Backdrop::draw_sky() const {
  gl_.UseProgram(sky_);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindVertexArray(no_vertices_);
  gl_.Uniform4f(gl_.GetUniformLocation(sky_, "bottom"), 0.800f, 0.822f, 0.850f, 1.0f);
  gl_.Uniform4f(gl_.GetUniformLocation(sky_, "top"), 0.938f, 0.949f, 0.962f, 1.0f);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void Backdrop::begin_ground(unsigned program, const DrawList& list, const Eye& eye, bool show) const {
  gl_.UseProgram(program);
  gl_.Disable(GL_CULL_FACE);
  set_matrix(gl_, program, "clip_from_world", eye.clip_from_world);
  set_vector(gl_, program, "middle", Vec3(0.0, list.scenery.level_m - eye.center_m.y, 0.0));
  set_vector(gl_, program, "world_origin", -eye.center_m);
  set_number(gl_, program, "reach", 0.75 * glm::length(eye.at));
  set_number(gl_, program, "show", show ? 1.0 : 0.0);
}

void Backdrop::draw_level(const DrawList& list, const Eye& eye, bool show) const {
  begin_ground(level_, list, eye, show);
  gl_.BindVertexArray(no_vertices_);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

// Draws depth first, so that of several ground surfaces only the nearest is visible.
void Backdrop::draw_shaped(const DrawList& list, const Eye& eye) const {
  gl_.DepthMask(GL_TRUE);
  draw_shaped_layer(list, eye, false);
  gl_.DepthMask(GL_FALSE);
  gl_.DepthFunc(GL_LEQUAL);
  draw_shaped_layer(list, eye, true);
  gl_.DepthFunc(GL_LESS);
}

void Backdrop::draw_shaped_layer(const DrawList& list, const Eye& eye, bool show) const {
  begin_ground(shaped_, list, eye, show);
  meshes_.bind();
  set_vector(gl_, shaped_, "to_light", eye.to_light);
  set_matrix(gl_, shaped_, "light_from_world", eye.light_from_world);
  shadows_.bind();
  for (const DrawInstance& instance : list.scenery.ground) {
    set_matrix(gl_, shaped_, "world_from_mesh", float_matrix(instance.world_from_mesh, eye.center_m));
    set_color(gl_, gl_.GetUniformLocation(shaped_, "color"), instance.color, kShapedGroundAlpha);
    meshes_.draw(instance.mesh);
  }
}

}  // namespace contort
