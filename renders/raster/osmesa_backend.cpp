#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <type_traits>

#include "renders/raster/find_symbol.h"
#include "renders/raster/gl_backend.h"

#ifdef CONTORT_ASAN
// Mesa 22.3 leaks 160 bytes with every context, for any order of calls, and LeakSanitizer would let the process fail.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }  // a clean run prints nothing
#endif

namespace contort {
namespace {

struct OsmesaApi {
  std::add_pointer_t<decltype(OSMesaCreateContextAttribs)> create = nullptr;
  std::add_pointer_t<decltype(OSMesaDestroyContext)> destroy = nullptr;
  std::add_pointer_t<decltype(OSMesaMakeCurrent)> make_current = nullptr;
  std::add_pointer_t<decltype(OSMesaGetProcAddress)> function = nullptr;
};

// The library stays loaded, because Mesa's threads and exit handlers may outlive a context.
void* open_osmesa() {
  // Threads of one process would compete for one lock. Several processes are faster instead (twice as fast on two
  // cores).
  ::setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
    if (void* library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  return nullptr;
}

class OsmesaBackend final : public GlBackend {
 public:
  OsmesaBackend(const OsmesaApi& api, OSMesaContext context) : api_(api), context_(context) {}
  ~OsmesaBackend() override {
    OsmesaBackend::release();
    api_.destroy(context_);
  }
  OsmesaBackend(const OsmesaBackend&) = delete;
  OsmesaBackend& operator=(const OsmesaBackend&) = delete;

  // All drawing goes to framebuffer objects. OSMesa requires a buffer, but it is not used.
  bool make_current() override {
    return api_.make_current(context_, unused_.data(), GL_UNSIGNED_BYTE, kUnusedSide, kUnusedSide) == GL_TRUE;
  }
  void release() override { api_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  void* function(const char* gl_name) override { return reinterpret_cast<void*>(api_.function(gl_name)); }
  std::string name() const override { return "libOSMesa"; }

 private:
  static constexpr int kUnusedSide = 16;
  OsmesaApi api_;
  OSMesaContext context_;
  std::array<unsigned char, 4 * kUnusedSide * kUnusedSide> unused_{};
};

}  // namespace

Result<std::unique_ptr<GlBackend>> make_osmesa_backend() {
  void* library = open_osmesa();
  OsmesaApi api;
  if (!library || !find_symbol(library, "OSMesaCreateContextAttribs", api.create) ||
      !find_symbol(library, "OSMesaDestroyContext", api.destroy) ||
      !find_symbol(library, "OSMesaMakeCurrent", api.make_current) ||
      !find_symbol(library, "OSMesaGetProcAddress", api.function))
    return Issue{"render.no_opengl", "",
                 "libOSMesa was not found, so no pictures can be drawn; install the package libosmesa6."};
  const int wanted[] = {OSMESA_FORMAT,
                        OSMESA_RGBA,
                        OSMESA_PROFILE,
                        OSMESA_CORE_PROFILE,
                        OSMESA_CONTEXT_MAJOR_VERSION,
                        3,
                        OSMESA_CONTEXT_MINOR_VERSION,
                        3,
                        0,
                        0};
  OSMesaContext context = api.create(wanted, nullptr);
  if (!context) return Issue{"render.no_opengl", "", "libOSMesa cannot make an OpenGL 3.3 context."};
  return std::unique_ptr<GlBackend>(std::make_unique<OsmesaBackend>(api, context));
}

}  // namespace contort
