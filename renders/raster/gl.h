// The OpenGL 3.3 functions of the renderer, as a table of pointers. gl* symbols are never linked: with two GL libraries
// in one process the linker may choose the one without a context, and then every call silently does nothing.
#pragma once

#include <cstddef>

#include "model/core/result.h"
#include "renders/raster/gl_backend.h"

namespace contort {

// X(name without gl, name in the typedef of glcorearb.h, result, parameters). GL's own type names are aliases of these.
#define CONTORT_GL_FUNCTIONS(X)                                                                                        \
  X(AttachShader, ATTACHSHADER, void, (unsigned program, unsigned shader))                                             \
  X(BindBuffer, BINDBUFFER, void, (unsigned target, unsigned buffer))                                                  \
  X(BindFramebuffer, BINDFRAMEBUFFER, void, (unsigned target, unsigned framebuffer))                                   \
  X(BindRenderbuffer, BINDRENDERBUFFER, void, (unsigned target, unsigned renderbuffer))                                \
  X(BindTexture, BINDTEXTURE, void, (unsigned target, unsigned texture))                                               \
  X(BindVertexArray, BINDVERTEXARRAY, void, (unsigned array))                                                          \
  X(BlendFunc, BLENDFUNC, void, (unsigned source, unsigned destination))                                               \
  X(BufferData, BUFFERDATA, void, (unsigned target, std::ptrdiff_t size, const void* data, unsigned usage))            \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS, unsigned, (unsigned target))                                       \
  X(Clear, CLEAR, void, (unsigned mask))                                                                               \
  X(ClearColor, CLEARCOLOR, void, (float red, float green, float blue, float alpha))                                   \
  X(CompileShader, COMPILESHADER, void, (unsigned shader))                                                             \
  X(CreateProgram, CREATEPROGRAM, unsigned, ())                                                                        \
  X(CreateShader, CREATESHADER, unsigned, (unsigned type))                                                             \
  X(DeleteBuffers, DELETEBUFFERS, void, (int n, const unsigned* buffers))                                              \
  X(DeleteFramebuffers, DELETEFRAMEBUFFERS, void, (int n, const unsigned* framebuffers))                               \
  X(DeleteProgram, DELETEPROGRAM, void, (unsigned program))                                                            \
  X(DeleteRenderbuffers, DELETERENDERBUFFERS, void, (int n, const unsigned* renderbuffers))                            \
  X(DeleteShader, DELETESHADER, void, (unsigned shader))                                                               \
  X(DeleteTextures, DELETETEXTURES, void, (int n, const unsigned* textures))                                           \
  X(DeleteVertexArrays, DELETEVERTEXARRAYS, void, (int n, const unsigned* arrays))                                     \
  X(DepthFunc, DEPTHFUNC, void, (unsigned function))                                                                   \
  X(DepthMask, DEPTHMASK, void, (unsigned char flag))                                                                  \
  X(Disable, DISABLE, void, (unsigned capability))                                                                     \
  X(DrawArrays, DRAWARRAYS, void, (unsigned mode, int first, int count))                                               \
  X(DrawBuffer, DRAWBUFFER, void, (unsigned buffer))                                                                   \
  X(Enable, ENABLE, void, (unsigned capability))                                                                       \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY, void, (unsigned index))                                          \
  X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER, void,                                                            \
    (unsigned target, unsigned attachment, unsigned renderbuffer_target, unsigned renderbuffer))                       \
  X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D, void,                                                                  \
    (unsigned target, unsigned attachment, unsigned texture_target, unsigned texture, int level))                      \
  X(GenBuffers, GENBUFFERS, void, (int n, unsigned* buffers))                                                          \
  X(GenFramebuffers, GENFRAMEBUFFERS, void, (int n, unsigned* framebuffers))                                           \
  X(GenRenderbuffers, GENRENDERBUFFERS, void, (int n, unsigned* renderbuffers))                                        \
  X(GenTextures, GENTEXTURES, void, (int n, unsigned* textures))                                                       \
  X(GenVertexArrays, GENVERTEXARRAYS, void, (int n, unsigned* arrays))                                                 \
  X(GetError, GETERROR, unsigned, ())                                                                                  \
  X(GetIntegerv, GETINTEGERV, void, (unsigned name, int* data))                                                        \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG, void, (unsigned program, int size, int* length, char* log))                  \
  X(GetProgramiv, GETPROGRAMIV, void, (unsigned program, unsigned name, int* value))                                   \
  X(GetShaderInfoLog, GETSHADERINFOLOG, void, (unsigned shader, int size, int* length, char* log))                     \
  X(GetShaderiv, GETSHADERIV, void, (unsigned shader, unsigned name, int* value))                                      \
  X(GetString, GETSTRING, const unsigned char*, (unsigned name))                                                       \
  X(GetUniformLocation, GETUNIFORMLOCATION, int, (unsigned program, const char* name))                                 \
  X(LinkProgram, LINKPROGRAM, void, (unsigned program))                                                                \
  X(ReadBuffer, READBUFFER, void, (unsigned buffer))                                                                   \
  X(ReadPixels, READPIXELS, void, (int x, int y, int width, int height, unsigned format, unsigned type, void* pixels)) \
  X(RenderbufferStorage, RENDERBUFFERSTORAGE, void, (unsigned target, unsigned format, int width, int height))         \
  X(ShaderSource, SHADERSOURCE, void, (unsigned shader, int count, const char* const* strings, const int* lengths))    \
  X(StencilFunc, STENCILFUNC, void, (unsigned function, int reference, unsigned mask))                                 \
  X(StencilOp, STENCILOP, void, (unsigned stencil_fail, unsigned depth_fail, unsigned pass))                           \
  X(TexImage2D, TEXIMAGE2D, void,                                                                                      \
    (unsigned target, int level, int inner_format, int width, int height, int border, unsigned format, unsigned type,  \
     const void* pixels))                                                                                              \
  X(TexParameteri, TEXPARAMETERI, void, (unsigned target, unsigned name, int value))                                   \
  X(Uniform1f, UNIFORM1F, void, (int location, float x))                                                               \
  X(Uniform3f, UNIFORM3F, void, (int location, float x, float y, float z))                                             \
  X(Uniform4f, UNIFORM4F, void, (int location, float x, float y, float z, float w))                                    \
  X(UniformMatrix4fv, UNIFORMMATRIX4FV, void, (int location, int count, unsigned char transpose, const float* values)) \
  X(UseProgram, USEPROGRAM, void, (unsigned program))                                                                  \
  X(VertexAttribPointer, VERTEXATTRIBPOINTER, void,                                                                    \
    (unsigned index, int size, unsigned type, unsigned char normalized, int stride, const void* pointer))              \
  X(Viewport, VIEWPORT, void, (int x, int y, int width, int height))

struct Gl {
#define CONTORT_GL_MEMBER(name, type, result, parameters) result(*name) parameters = nullptr;
  CONTORT_GL_FUNCTIONS(CONTORT_GL_MEMBER)
#undef CONTORT_GL_MEMBER
};

// The backend must be current. Pointers prove nothing (see GlBackend::function), so this also queries the version.
// Codes: render.no_opengl, render.old_opengl.
Result<Gl> load_gl(GlBackend& backend);

// Returns the version and driver on which pixels depend, such as "4.5 (Core Profile) Mesa 22.3.6 on llvmpipe (LLVM
// 15.0.6, 256 bits)".
std::string describe_gl(const Gl& gl);

// Makes a program from GLSL text. Code: render.shader, with the driver's log.
Result<unsigned> make_program(const Gl& gl, const char* vertex_text, const char* fragment_text);

}  // namespace contort
