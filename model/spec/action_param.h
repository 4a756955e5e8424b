// Parameters of actions, as a generator declares them. Specs, the fuzzer and help texts use them.
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
  joint_range,   // within the limits of the joint in the parameter's name
  within_reach,  // a point in or slightly beyond the reach of the part's chain
  around,        // a point some metres around the character
};

// The change of a value between the left and the right side of the character. Action files are written for the left
// side, as parts are, and their values are mirrored; values in specs never are.
enum class Mirrored {
  same,
  opposite,  // an angle to the left becomes one to the right
  point,     // x changes its sign
  rotation,  // a rotation vector: y and z change their signs
};

struct ParamDef {
  std::string name;  // ends in its unit: "azimuth_deg", "target_m"
  ParamType type = ParamType::number;
  double low = 0.0;
  double high = 0.0;
  ParamValue preset = 0.0;             // the value if a spec gives none
  std::vector<std::string> choices{};  // the words of a choice
  bool optional = false;               // a spec may leave it out, and the action then has no such value
  Domain domain = Domain::uniform;
  Mirrored mirrored = Mirrored::same;
  std::string help;
  std::vector<std::string> points{};  // for object_point and own_point: names that this part can use
  bool is_characteristic = false;     // the preset comes from a file and distinguishes the action from others
  std::vector<ParamValue> special{};  // values that are drawn in half of the cases, all with the same odds
  double steps = 0.0;                 // steps_of() this parameter; 0: they follow from its name
  std::vector<Vec3> box{};            // for a vector: the lowest and highest value of each component, if these differ
                                      // between components
  bool operator==(const ParamDef&) const = default;
};

// The lattice on which the fuzzer draws and shrinks a parameter, by its unit: whole degrees, centimetres, 0.1 m/s,
// hundredths of a fraction.
double steps_per_unit(std::string_view param_name);
double steps_of(const ParamDef& def);

}  // namespace contort
