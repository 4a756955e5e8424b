#include "renders/strip_views.h"

#include <filesystem>

#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "renders/page_call.h"

namespace contort {

using json_fields::Json;

std::string strip_views_json(const std::vector<StripTile>& tiles) {
  const auto vector = [](const Vec3& v) { return Json{v.x, v.y, v.z}; };
  Json json = {{"format", "contort.strip/1"}, {"tiles", Json::array()}};
  for (const StripTile& tile : tiles)
    json["tiles"].push_back({{"frame", tile.frame},
                             {"eye", vector(tile.camera.eye_m)},
                             {"target", vector(tile.camera.center_m)},
                             {"tan_half_height", tile.camera.tan_half_height},
                             {"box", {tile.x, tile.y, tile.width, tile.height}}});
  return without_markup(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Result<Done> write_strip_views(const std::string& png, const std::vector<StripTile>& tiles) {
  const std::filesystem::path path(png);
  const std::string script = page_call("contortStrip", path.stem().string(), strip_views_json(tiles));
  return write_file(std::filesystem::path(path).replace_extension(".js").string(), script);
}

}  // namespace contort
