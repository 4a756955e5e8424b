// Holds the triangles of all meshes of a picture in one buffer of the GPU.
#pragma once

#include <span>
#include <vector>

#include "model/character/shape.h"
#include "renders/raster/gl.h"

namespace contort {

class MeshBuffer {
 public:
  explicit MeshBuffer(const Gl& gl) : gl_(gl) {}
  MeshBuffer(const MeshBuffer&) = delete;
  MeshBuffer& operator=(const MeshBuffer&) = delete;

  // Call once, with the context current.
  void create();
  void destroy();

  // Sets the triangles to which mesh numbers refer from now on.
  void set(std::span<const Triangles> meshes);
  void bind() const;  // must precede draw(), unless nothing else was bound since
  void draw(int mesh) const;

 private:
  struct Range {
    int first = 0;
    int count = 0;
  };

  const Gl& gl_;
  unsigned vertex_array_ = 0, buffer_ = 0;
  std::vector<Range> ranges_;
};

}  // namespace contort
