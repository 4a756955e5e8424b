// Draws a DrawList. One renderer belongs to one thread at a time; to draw faster, run several processes: all contexts
// of a process share one rasterizer in Mesa (two threads give 1.17 times the pictures, two processes 2.0 times).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/character/shape.h"
#include "model/core/result.h"
#include "renders/camera.h"
#include "renders/draw_list.h"
#include "renders/image.h"
#include "renders/raster/gl.h"
#include "renders/raster/gl_backend.h"
#include "renders/raster/shadow_map.h"
#include "renders/raster/target.h"

namespace contort {

class Renderer {
 public:
  // Makes the backend current, and draws and reads a test pixel: a GL that does nothing is refused here.
  // Codes: render.no_opengl, render.old_opengl, render.shader, render.framebuffer.
  static Result<std::unique_ptr<Renderer>> create(std::unique_ptr<GlBackend> backend);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Version and driver; pictures are the same, byte by byte, only where this is the same.
  std::string description() const { return describe_gl(gl_); }

  // The triangles that DrawInstance::mesh means from now on.
  void set_meshes(std::span<const Triangles> meshes);

  // Codes: render.bad_size, render.framebuffer, render.gl_error.
  Result<Image> draw(const DrawList& list, const Camera& camera, int width, int height);

  // Pixels, without anti-aliasing, in which each highlight group is seen and not hidden, by scenery neither; index =
  // group, [0] is unused.
  Result<std::vector<int>> count_visible(const DrawList& list, const Camera& camera, int width, int height);

 private:
  struct Range {
    int first = 0;
    int count = 0;
  };
  // A program that draws triangles, and where its uniforms are.
  struct Solid {
    unsigned program = 0;
    int place = -1, color = -1, rim = -1;
  };
  struct Paint;
  struct Eye;

  explicit Renderer(std::unique_ptr<GlBackend> backend)
      : backend_(std::move(backend)), target_(gl_), shadow_map_(gl_) {}
  Result<Done> set_up();
  Result<Done> draw_test_pixel();
  Result<Done> gl_errors() const;

  void draw_background();
  Result<Done> draw_shadow_map(const DrawList& list, const Eye& eye);
  void draw_level_ground(const DrawList& list, const Eye& eye, bool show);
  void draw_shaped_ground(const DrawList& list, const Eye& eye, bool show);
  void draw_ground(const DrawList& list, const Eye& eye);
  void begin_ground(unsigned program, const DrawList& list, const Eye& eye, bool show);
  void draw_shadows(const DrawList& list, const Eye& eye);
  void draw_obstacles(const DrawList& list, const Eye& eye);
  void draw_hiding(const DrawList& list, const Eye& eye);
  void draw_translucent(const DrawList& list, const Eye& eye);
  void draw_ghost_figure(const DrawList& list, const Eye& eye);
  void draw_on_top(const DrawList& list, const Eye& eye);
  void begin_solid(const Eye& eye);                   // Instances are shaded from now on,
  void begin_flat(const glm::mat4& clip_from_world);  // or have their colour as it is.
  void begin(const Solid& solid, const glm::mat4& clip_from_world);
  void draw_instance(const DrawInstance& instance, const Eye& eye, const Paint& paint);
  void draw_range(const DrawInstance& instance);
  void set_matrix(unsigned program, const char* name, const glm::mat4& matrix);
  void set3(unsigned program, const char* name, const Vec3& v);
  void set_color(int location, const Vec3& color, float alpha);

  std::unique_ptr<GlBackend> backend_;
  Gl gl_;
  Solid solid_, flat_;
  const Solid* begun_ = nullptr;                              // one of the two
  unsigned background_ = 0, ground_ = 0, shaped_ground_ = 0;  // programs
  unsigned vertex_array_ = 0, no_vertices_ = 0, buffer_ = 0;
  std::vector<Range> ranges_;
  Target target_;
  ShadowMap shadow_map_;
};

}  // namespace contort
