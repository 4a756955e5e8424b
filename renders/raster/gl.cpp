#include "renders/raster/gl.h"

#include <GL/glcorearb.h>

#include <string>
#include <type_traits>

namespace contort {
namespace {

#define CONTORT_GL_TYPE(name, type, result, parameters) \
  static_assert(std::is_same_v<decltype(Gl::name), PFNGL##type##PROC>, "gl" #name " has other parameters");
CONTORT_GL_FUNCTIONS(CONTORT_GL_TYPE)
#undef CONTORT_GL_TYPE

template <class Function>
void load(GlBackend& backend, const char* name, Function*& into) {
  into = reinterpret_cast<Function*>(backend.function(name));
}

std::string text_of(const Gl& gl, GLenum name) {
  const auto* text = reinterpret_cast<const char*>(gl.GetString(name));
  return text ? text : "";
}

Result<unsigned> compile(const Gl& gl, GLenum kind, const char* text) {
  const unsigned shader = gl.CreateShader(kind);
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  int compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[1024] = "";
  gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl.DeleteShader(shader);
  return Issue{"render.shader", "", std::string("OpenGL refused a shader: ") + log};
}

Result<unsigned> link(const Gl& gl, unsigned vertex, unsigned fragment) {
  const unsigned program = gl.CreateProgram();
  gl.AttachShader(program, vertex);
  gl.AttachShader(program, fragment);
  gl.LinkProgram(program);
  int linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  char log[1024] = "";
  gl.GetProgramInfoLog(program, sizeof log, nullptr, log);
  gl.DeleteProgram(program);
  return Issue{"render.shader", "", std::string("OpenGL refused to link shaders: ") + log};
}

}  // namespace

Result<Gl> load_gl(GlBackend& backend) {
  Gl gl;
  bool all = true;
#define CONTORT_GL_LOAD(name, type, result, parameters) \
  load(backend, "gl" #name, gl.name);                   \
  all = all && gl.name;
  CONTORT_GL_FUNCTIONS(CONTORT_GL_LOAD)
#undef CONTORT_GL_LOAD
  if (!all || text_of(gl, GL_VERSION).empty())
    return Issue{"render.no_opengl", "", backend.name() + " gives no working OpenGL (GL_VERSION is empty)."};
  int major = 0, minor = 0;
  gl.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33)
    return Issue{"render.old_opengl", "", "OpenGL 3.3 is needed, found " + describe_gl(gl) + "."};
  return gl;
}

std::string describe_gl(const Gl& gl) { return text_of(gl, GL_VERSION) + " on " + text_of(gl, GL_RENDERER); }

Result<unsigned> make_program(const Gl& gl, const char* vertex_text, const char* fragment_text) {
  const Result<unsigned> vertex = compile(gl, GL_VERTEX_SHADER, vertex_text);
  if (!vertex) return vertex;
  const Result<unsigned> fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_text);
  const Result<unsigned> program = fragment ? link(gl, *vertex, *fragment) : fragment;
  gl.DeleteShader(*vertex);
  if (fragment) gl.DeleteShader(*fragment);
  return program;
}

}  // namespace contort
