#include "renders/raster/gl_backend.h"

namespace contort {

std::optional<GlSource> gl_source(std::string_view name) {
  if (name == "auto") return GlSource::any;
  if (name == "osmesa") return GlSource::osmesa;
  if (name == "egl") return GlSource::egl;
  return std::nullopt;
}

Result<std::unique_ptr<GlBackend>> make_gl_backend(GlSource source) {
  if (source == GlSource::egl) return make_egl_backend();
  Result<std::unique_ptr<GlBackend>> osmesa = make_osmesa_backend();
  if (osmesa || source == GlSource::osmesa) return osmesa;
  Result<std::unique_ptr<GlBackend>> egl = make_egl_backend();
  if (egl) return egl;
  return Issue{"render.no_opengl", "", osmesa.issue().text + " " + egl.issue().text};
}

}  // namespace contort
