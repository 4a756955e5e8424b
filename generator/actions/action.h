// The registry of actions. Adding one is a row in action_list.inc, a rule in a .cpp of this folder, and a test; the
// command line, docs/actions.md, the fuzzer and the report take it from there.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "generator/actions/action_use.h"
#include "generator/character/character.h"
#include "generator/core/result.h"

namespace contort {

// Order of evaluation on one part: overwrite, then ik on top, then additive.
enum class Layer { overwrite, ik, additive };
std::string_view layer_name(Layer layer);

enum class ParamType { number, vector };

// How the fuzzer chooses values; people may write any value within low and high.
enum class Domain {
  uniform,       // anywhere in [low, high]
  joint_range,   // within the limits of the joint that the parameter is named after
  within_reach,  // a point that the part's reach chain can just about reach
};

struct ParamDef {
  std::string name;  // ends in its unit: "azimuth_deg", "target_m"
  ParamType type = ParamType::number;
  double low = 0.0;
  double high = 0.0;
  ParamValue preset = 0.0;  // the value where a spec gives none
  bool optional = false;    // no value at all is allowed: the rule sees NaN
  Domain domain = Domain::uniform;
  std::string help;
  bool operator==(const ParamDef&) const = default;
};

// What a rule may look at. Joints of carriers are final for this frame. On the layer ik the part's own entries of
// `world` stand where the posture in the row puts them, and are scratch; on other layers they mean nothing.
struct RuleInput {
  const Character& character;
  const Part& part;
  std::span<const double> params;  // in the order of ActionDef::params; a vector takes three
  std::span<Rigid> world;
};

struct ActionDef {
  std::string_view name;
  Layer layer;
  std::string_view help;
  // The parameters on a given part; they may depend on its joints.
  std::vector<ParamDef> (*params)(const Character&, const Part&);
  // Whether the part has what the action needs.
  bool (*supports)(const Part&);
  // Writes the part's coordinates of the target posture into a row that holds the present posture.
  void (*rule)(const RuleInput&, std::span<double> row);
};

std::span<const ActionDef> all_actions();
const ActionDef* find_action(std::string_view name);  // nullptr where there is none

// Looks up and checks the parameters of one use. Codes spec.unknown_param, .wrong_type, .out_of_range;
// pointers relative to the use ("/params/elbow_deg").
Result<std::vector<double>> bind_params(const ActionDef& action, const Character& character, const Part& part,
                                        const std::map<std::string, ParamValue>& values);

}  // namespace contort
