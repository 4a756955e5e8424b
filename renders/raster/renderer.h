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
#include "renders/raster/backdrop.h"
#include "renders/raster/brush.h"
#include "renders/raster/eye.h"
#include "renders/raster/gl.h"
#include "renders/raster/gl_backend.h"
#include "renders/raster/mesh_buffer.h"
#include "renders/raster/shadow_map.h"
#include "renders/raster/target.h"

namespace contort {

class Renderer {
 public:
  // Makes the backend current, and draws and reads a test pixel, to refuse an OpenGL that does nothing. Codes:
  // render.no_opengl, render.old_opengl, render.shader, render.framebuffer.
  static Result<std::unique_ptr<Renderer>> create(std::unique_ptr<GlBackend> backend);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Returns version and driver. Pictures are equal byte by byte only if these are equal.
  std::string description() const { return describe_gl(gl_); }

  // Sets the triangles to which DrawInstance::mesh refers from now on.
  void set_meshes(std::span<const Triangles> meshes);

  // Draws a picture. Codes: render.bad_size, render.framebuffer, render.gl_error.
  Result<Image> draw(const DrawList& list, const Camera& camera, int width, int height);

  // Returns for each highlight group the number of pixels, without anti-aliasing, in which it is visible and not
  // hidden, also not by scenery; index = group, [0] is unused.
  Result<std::vector<int>> count_visible(const DrawList& list, const Camera& camera, int width, int height);

 private:
  explicit Renderer(std::unique_ptr<GlBackend> backend)
      : backend_(std::move(backend)),
        target_(gl_),
        shadow_map_(gl_),
        meshes_(gl_),
        brush_(gl_, meshes_),
        backdrop_(gl_, meshes_, shadow_map_) {}
  Result<Done> set_up();
  Result<Done> draw_test_pixel();
  Result<Done> gl_errors() const;

  Result<Done> draw_shadow_map(const DrawList& list, const Eye& eye);
  void draw_ground(const DrawList& list, const Eye& eye);
  void draw_shadows(const DrawList& list, const Eye& eye);
  void draw_obstacles(const DrawList& list, const Eye& eye);
  void draw_groups(const DrawList& list, const Eye& eye);
  void draw_hiding(const DrawList& list, const Eye& eye);
  void draw_translucent(const DrawList& list, const Eye& eye);
  void draw_ghost_figure(const DrawList& list, const Eye& eye);
  void draw_on_top(const DrawList& list, const Eye& eye);
  void draw_blended(const DrawList& list, const Eye& eye);

  std::unique_ptr<GlBackend> backend_;
  Gl gl_;
  Target target_;
  ShadowMap shadow_map_;
  MeshBuffer meshes_;
  Brush brush_;
  Backdrop backdrop_;
};

}  // namespace contort
