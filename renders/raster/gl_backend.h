// A source of OpenGL; the renderer uses only this interface. Mesa has dropped OSMesa from release 25.1 on. EGL without
// a screen replaces it, and gives the same bytes in the same release.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort {

class GlBackend {
 public:
  virtual ~GlBackend() = default;
  virtual bool make_current() = 0;                  // On the calling thread.
  virtual void release() = 0;                       // The calling thread has no context afterwards.
  virtual void* function(const char* gl_name) = 0;  // The address of a function; it may be non-null even if the
                                                    // function does not exist.
  virtual std::string name() const = 0;
};

// Renders in software with libOSMesa, OpenGL 3.3 core. Code: render.no_opengl, with the package to install.
Result<std::unique_ptr<GlBackend>> make_osmesa_backend();
// Renders with libEGL (EGL_MESA_platform_surfaceless), always with Mesa's software driver. The same code.
Result<std::unique_ptr<GlBackend>> make_egl_backend();

enum class GlSource { any, osmesa, egl };
std::optional<GlSource> gl_source(std::string_view name);  // "auto", "osmesa", "egl"

// Makes the requested backend; `any` is OSMesa, else EGL. Code: render.no_opengl.
Result<std::unique_ptr<GlBackend>> make_gl_backend(GlSource source);

}  // namespace contort
