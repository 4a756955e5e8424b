// Where OpenGL comes from. The renderer knows only this; Mesa has dropped OSMesa from release 25.1 on, and an EGL
// backend will take its place behind the same four functions.
#pragma once

#include <memory>
#include <string>

#include "generator/core/result.h"

namespace contort {

class GlBackend {
 public:
  virtual ~GlBackend() = default;
  virtual bool make_current() = 0;                  // On the calling thread.
  virtual void release() = 0;                       // The calling thread has no context afterwards.
  virtual void* function(const char* gl_name) = 0;  // May be non-null for names that do not exist.
  virtual std::string name() const = 0;
};

// Software rendering by libOSMesa, OpenGL 3.3 core. Code: render.no_opengl, with the package to install.
Result<std::unique_ptr<GlBackend>> make_osmesa_backend();

}  // namespace contort
