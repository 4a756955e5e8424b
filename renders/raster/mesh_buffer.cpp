#include "renders/raster/mesh_buffer.h"

#include <GL/glcorearb.h>

#include <cstdint>

#include "model/core/assert.h"

namespace contort {

namespace {

constexpr std::size_t kFloatsPerVertex = 6;  // place and normal

void append_vertices(const Triangles& mesh, std::vector<float>& vertices) {
  for (std::size_t i = 0; i < mesh.positions_m.size(); ++i)
    for (const Vec3& v : {mesh.positions_m[i], mesh.normals[i]})
      for (int axis = 0; axis < 3; ++axis) vertices.push_back(static_cast<float>(v[axis]));
}

}  // namespace

void MeshBuffer::create() {
  gl_.GenVertexArrays(1, &vertex_array_);
  gl_.GenBuffers(1, &buffer_);
}

void MeshBuffer::destroy() {
  if (vertex_array_) gl_.DeleteVertexArrays(1, &vertex_array_);
  if (buffer_) gl_.DeleteBuffers(1, &buffer_);
}

void MeshBuffer::set(std::span<const Triangles> meshes) {
  std::vector<float> vertices;
  ranges_.clear();
  for (const Triangles& mesh : meshes) {
    ranges_.push_back(
        {static_cast<int>(vertices.size() / kFloatsPerVertex), static_cast<int>(mesh.positions_m.size())});
    append_vertices(mesh, vertices);
  }
  bind();
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(vertices.size() * sizeof(float)), vertices.data(),
                 GL_STATIC_DRAW);
  for (unsigned attribute = 0; attribute < 2; ++attribute) {
    const auto* offset = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(attribute * 3 * sizeof(float)));
    gl_.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, kFloatsPerVertex * sizeof(float), offset);
    gl_.EnableVertexAttribArray(attribute);
  }
}

void MeshBuffer::bind() const { gl_.BindVertexArray(vertex_array_); }

void MeshBuffer::draw(int mesh) const {
  CONTORT_ASSERT(static_cast<std::size_t>(mesh) < ranges_.size());
  const Range& range = ranges_[static_cast<std::size_t>(mesh)];
  gl_.DrawArrays(GL_TRIANGLES, range.first, range.count);
}

}  // namespace contort
