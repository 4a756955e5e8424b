// Parameters of actions, as a generator declares them, for specs, for the fuzzer and for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/character/action_desc.h"

namespace contort {

enum class ParamType {
  number,
  vector,
  choice,        // one of a few words
  object_point,  // the name of a point of an attached object that others carry
  own_point,     // the name of a point that the part carries: "grip", "muzzle"
};

// The fuzzer chooses values by their domain; people may write any value within low and high.
enum class Domain {
  uniform,       // anywhere in [low, high]
  joint_range,   // within the limits of the joint that the parameter is named after
  within_reach,  // a point that the part's reach chain can just about reach
  around,        // a point some metres around the character
};

// A value may have another sign or meaning on the other side of the character. Specs say what they mean; the files of
// actions are written for the left side, as parts are.
enum class Mirrored {
  same,
  opposite,  // an angle to the left is one to the right
  point,     // x changes its sign
  rotation,  // a rotation vector: y and z do
};

struct ParamDef {
  std::string name;  // ends in its unit: "azimuth_deg", "target_m"
  ParamType type = ParamType::number;
  double low = 0.0;
  double high = 0.0;
  ParamValue preset = 0.0;             // the value where a spec gives none
  std::vector<std::string> choices{};  // of a choice
  bool optional = false;               // a spec may leave it out, and the action then has no such value
  Domain domain = Domain::uniform;
  Mirrored mirrored = Mirrored::same;
  std::string help;
  std::vector<std::string> points{};  // of object_point and own_point: the names that this part can use
  bool is_characteristic = false;     // a file gave the preset: it is part of what makes the action that action
  std::vector<ParamValue> special{};  // values that are drawn in half of the cases, each as often as the others
  double steps = 0.0;                 // steps_of() this parameter, where its name does not tell them
  std::vector<Vec3> box{};            // of a vector: its lowest and highest components, where they differ
  bool operator==(const ParamDef&) const = default;
};

// The lattice on which the fuzzer draws and shrinks a parameter, by its unit: whole degrees, centimetres, 0.1 m/s,
// hundredths of a share.
double steps_per_unit(std::string_view param_name);
double steps_of(const ParamDef& def);

}  // namespace contort
