#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <cstdlib>
#include <type_traits>

#include "renders/raster/find_symbol.h"
#include "renders/raster/gl_backend.h"

namespace contort {
namespace {

struct EglApi {
  std::add_pointer_t<decltype(eglGetPlatformDisplay)> display = nullptr;
  std::add_pointer_t<decltype(eglInitialize)> initialize = nullptr;
  std::add_pointer_t<decltype(eglBindAPI)> bind = nullptr;
  std::add_pointer_t<decltype(eglCreateContext)> create = nullptr;
  std::add_pointer_t<decltype(eglDestroyContext)> destroy = nullptr;
  std::add_pointer_t<decltype(eglMakeCurrent)> make_current = nullptr;
  std::add_pointer_t<decltype(eglGetProcAddress)> function = nullptr;
};

bool find_all(void* library, EglApi& api) {
  return find_symbol(library, "eglGetPlatformDisplay", api.display) &&
         find_symbol(library, "eglInitialize", api.initialize) && find_symbol(library, "eglBindAPI", api.bind) &&
         find_symbol(library, "eglCreateContext", api.create) &&
         find_symbol(library, "eglDestroyContext", api.destroy) &&
         find_symbol(library, "eglMakeCurrent", api.make_current) &&
         find_symbol(library, "eglGetProcAddress", api.function);
}

// The library stays loaded, as libOSMesa does. It always uses the software driver, so that pictures of all machines are
// equal.
void* open_egl() {
  ::setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", /*overwrite=*/0);
  for (const char* name : {"libEGL.so.1", "libEGL.so"})
    if (void* library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  return nullptr;
}

class EglBackend final : public GlBackend {
 public:
  EglBackend(const EglApi& api, EGLDisplay display, EGLContext context)
      : api_(api), display_(display), context_(context) {}
  ~EglBackend() override {
    EglBackend::release();
    api_.destroy(display_, context_);
  }
  EglBackend(const EglBackend&) = delete;
  EglBackend& operator=(const EglBackend&) = delete;

  // Needs no surface, because all drawing goes to framebuffer objects.
  bool make_current() override {
    return api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }
  void release() override { api_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  void* function(const char* gl_name) override { return reinterpret_cast<void*>(api_.function(gl_name)); }
  std::string name() const override { return "libEGL"; }

 private:
  EglApi api_;
  EGLDisplay display_;
  EGLContext context_;
};

}  // namespace

Result<std::unique_ptr<GlBackend>> make_egl_backend() {
  void* library = open_egl();
  EglApi api;
  if (!library || !find_all(library, api))
    return Issue{"render.no_opengl", "",
                 "libEGL was not found, so no pictures can be drawn; install the packages libegl1, libegl-mesa0 and "
                 "libgl1-mesa-dri."};
  EGLDisplay display = api.display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (display == EGL_NO_DISPLAY || api.initialize(display, nullptr, nullptr) != EGL_TRUE ||
      api.bind(EGL_OPENGL_API) != EGL_TRUE)
    return Issue{"render.no_opengl", "", "libEGL cannot draw without a screen (EGL_MESA_platform_surfaceless)."};
  const EGLint wanted[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = api.create(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT) return Issue{"render.no_opengl", "", "libEGL cannot make an OpenGL 3.3 context."};
  return std::unique_ptr<GlBackend>(std::make_unique<EglBackend>(api, display, context));
}

}  // namespace contort
