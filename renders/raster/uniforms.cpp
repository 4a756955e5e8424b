#include "renders/raster/uniforms.h"

#include <GL/glcorearb.h>

#include <glm/gtc/type_ptr.hpp>

namespace contort {

void set_matrix(const Gl& gl, unsigned program, const char* name, const glm::mat4& matrix) {
  gl.UniformMatrix4fv(gl.GetUniformLocation(program, name), 1, GL_FALSE, glm::value_ptr(matrix));
}

void set_number(const Gl& gl, unsigned program, const char* name, double value) {
  gl.Uniform1f(gl.GetUniformLocation(program, name), static_cast<float>(value));
}

void set_vector(const Gl& gl, unsigned program, const char* name, const Vec3& v) {
  gl.Uniform3f(gl.GetUniformLocation(program, name), static_cast<float>(v.x), static_cast<float>(v.y),
               static_cast<float>(v.z));
}

void set_color(const Gl& gl, int location, const Vec3& color, float alpha) {
  gl.Uniform4f(location, static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z), alpha);
}

}  // namespace contort
