// Sets the uniforms of shader programs.
#pragma once

#include <glm/mat4x4.hpp>

#include "model/core/math.h"
#include "renders/raster/gl.h"

namespace contort {

// Sets a uniform of the program, which must be in use. No effect if it has no uniform of that name.
void set_matrix(const Gl& gl, unsigned program, const char* name, const glm::mat4& matrix);
void set_number(const Gl& gl, unsigned program, const char* name, double value);
void set_vector(const Gl& gl, unsigned program, const char* name, const Vec3& v);
void set_color(const Gl& gl, int location, const Vec3& color, float alpha);

}  // namespace contort
