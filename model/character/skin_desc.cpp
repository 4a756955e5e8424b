#include "model/character/skin_desc.h"

#include <algorithm>

#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

template <class V>
void fields(V& v, const SkinDesc*) {
  using json_fields::Text;
  v.constant("format", "contort.skin/1");
  v.field("model", &SkinDesc::model, {.text = Text::label, .required = true},
          "Name of a .glb file in the same folder.");
  v.field("metres_per_unit", &SkinDesc::metres_per_unit, {.low = 1e-9, .high = 1e9},
          "Metres in one unit of the model's lengths.");
  v.field("rotation_deg", &SkinDesc::rotation_deg, {.low = -360, .high = 360},
          "Rotation vector that makes the model face +Z.");
  v.field("joints", &SkinDesc::joints,
          {.max_count = 4096, .text = Text::label, .key_text = Text::label, .required = true},
          "Node of the model to slot/joint of the character, or to root.");
}

Result<SkinDesc> parse_skin(std::string_view text) {
  Result<SkinDesc> skin = json_fields::read_document<SkinDesc>(text, "skin");
  if (!skin) return skin;
  const std::string& model = skin->model;
  if (!is_file_name(model) || model.find(':') != std::string::npos || model.starts_with('.') ||
      !model.ends_with(".glb"))
    return Issue{"skin.outside", "/model",
                 "found " + json_fields::quoted(model) + ", allowed are plain names of .glb files of the same folder"};
  const bool has_root =
      std::any_of(skin->joints.begin(), skin->joints.end(), [](const auto& entry) { return entry.second == "root"; });
  if (!has_root) return Issue{"skin.no_root", "/joints", "no node stands for the root"};
  return skin;
}

std::string print_skin(const SkinDesc& skin) { return json_fields::write_pretty(skin); }

std::string skin_schema() { return json_fields::write_schema<SkinDesc>("Contort skin"); }

}  // namespace contort
