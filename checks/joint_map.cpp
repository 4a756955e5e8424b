#include "checks/joint_map.h"

#include "model/core/json_fields.h"

namespace contort {

template <class V>
void fields(V& v, const JointMap*) {
  using json_fields::Text;
  v.constant("format", "contort.map/1");
  v.field("joints", &JointMap::joints,
          {.max_count = 4096, .text = Text::label, .key_text = Text::label, .required = true},
          "Node of the animation's file to slot/joint of the character.");
}

Result<JointMap> parse_joint_map(std::string_view text) { return json_fields::read_document<JointMap>(text, "map"); }

std::string print_joint_map(const JointMap& map) { return json_fields::write_pretty(map); }

std::string joint_map_schema() { return json_fields::write_schema<JointMap>("Contort joint map"); }

}  // namespace contort
