#include "checks/joint_map.h"

#include "model/core/json_fields.h"

namespace contort {

constexpr double kGreatestValue = 1e6;

template <class V>
void fields(V& v, const FileJoint*) {
  using json_fields::Text;
  v.field("joint", &FileJoint::joint, {.text = Text::label},
          "slot/joint of the character; left out if the joint does not move there.");
  v.field("at_rest", &FileJoint::at_rest, {.low = -kGreatestValue, .high = kGreatestValue},
          "The file's value of the joint in the character's rest pose, rad or m.");
  v.field("follows", &FileJoint::follows, {.text = Text::label},
          "Joint of the file that this one follows: its value is multiplier * that of the other + offset.");
  v.field("multiplier", &FileJoint::multiplier, {.low = -kGreatestValue, .high = kGreatestValue}, "");
  v.field("offset", &FileJoint::offset, {.low = -kGreatestValue, .high = kGreatestValue}, "rad or m.");
}

template <class V>
void fields(V& v, const JointMap*) {
  using json_fields::Text;
  v.constant("format", "contort.map/1");
  v.field("joints", &JointMap::joints,
          {.max_count = 4096, .text = Text::label, .key_text = Text::label, .required = true},
          "Node of the animation's file to slot/joint of the character.");
  v.field("values", &JointMap::values, {.max_count = 4096, .key_text = Text::label},
          "Joints of the robot's file that the character was made from, for tables of their values.");
  v.field("root_rotation", &JointMap::root_rotation, {.low = -1.001, .high = 1.001},
          "Rotation at rest of the root's body in the robot's file, x y z w, for tables that say where the root is.");
}

Result<JointMap> parse_joint_map(std::string_view text) { return json_fields::read_document<JointMap>(text, "map"); }

std::string print_joint_map(const JointMap& map) { return json_fields::write_pretty(map); }

std::string joint_map_schema() { return json_fields::write_schema<JointMap>("Contort joint map"); }

}  // namespace contort
