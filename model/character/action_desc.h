// Descriptions of a user's own actions from files: key poses, variants of built-in actions, and scripts.
// docs/reference/own_actions.md explains them; generator/actions makes Actions of them for their parts.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "model/core/math.h"

namespace contort {

// Angles in degrees, lengths in metres, as the parameter's name says.
using ParamValue = std::variant<double, Vec3, std::string>;

enum class KeyEase {
  smooth,  // minimum jerk
  linear,
  step,  // holds the previous pose, then jumps at the key
  sine,  // half a cosine: reverses without a pause
};

struct KeyPoseDesc {
  double at = 1.0;  // fraction of the action's period, (0, 1]
  KeyEase ease = KeyEase::smooth;          // easing from the previous key to this one
  std::map<std::string, ParamValue> pose;  // "elbow_deg": 90, with the parameters of `pose`
  bool operator==(const KeyPoseDesc&) const = default;
};

// A number that a spec may give to a script.
struct ScriptParamDesc {
  std::string name;
  std::string help;
  double low = 0.0;
  double high = 0.0;
  double preset = 0.0;
  bool operator==(const ScriptParamDesc&) const = default;
};

// An action file. It has one of `keys`, `of` and `script`; a script may also compute parameters of `of`. It applies to
// the parts that it names, or to all parts of the kinds that it names.
struct ActionDesc {
  std::string name;
  std::string help;
  std::vector<std::string> parts;
  std::vector<std::string> kinds;
  std::vector<KeyPoseDesc> keys;             // in the order of `at`
  std::string of;                            // a built-in action
  std::map<std::string, ParamValue> params;  // values of parameters of `of`; a spec may give others
  std::vector<std::string> script;           // lines of Lua
  std::vector<std::string> sets;             // the values that the script computes: parameters of `pose`, or of `of`
  std::vector<ScriptParamDesc> parameters;   // the parameters of the script
  bool adds = false;                         // the script's joints are added to the present posture
  bool operator==(const ActionDesc&) const = default;
};

}  // namespace contort
