// The description of a character's skin: the model that it was imported from. It is skins/NAME.json beside the files
// of character NAME, with the model next to it. Only pictures read it; a figure without it is drawn from its parts.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "model/core/math.h"
#include "model/core/result.h"

namespace contort {

struct SkinDesc {
  std::string model;  // a .glb of the same folder, by its plain name: a library never refers to files outside of its
                      // folder
  double metres_per_unit = 1.0;               // > 0
  Vec3 rotation_deg{0.0};                     // rotation vector that makes the model face +Z
  std::map<std::string, std::string> joints;  // node of the model -> slot/joint that carries it; one is "root"
  bool operator==(const SkinDesc&) const = default;
};

// Parses a text such as {"format": "contort.skin/1", "model": "knight.glb", "joints": {"Hips": "root", …}}. Codes
// json.*, skin.*.
Result<SkinDesc> parse_skin(std::string_view text);

std::string print_skin(const SkinDesc& skin);

std::string skin_schema();

}  // namespace contort
