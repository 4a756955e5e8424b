// Rules that users write in Lua, in action files (docs/reference/own_actions.md): a script computes joints of a part,
// or parameters of a built-in action, from time, parameters and surroundings.
//
// A script is run from its first line to its last in every frame, and keeps nothing from one run to the next, so its
// result depends only on its input. It has no files, no clock and no random numbers, and the functions that it may call
// have the same bits everywhere. A run may take kMaxScriptSteps instructions and kMaxScriptBytes of memory.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/core/result.h"
#include "model/motion/motion.h"
#include "model/spec/action_param.h"
#include "model/world/environment.h"

struct lua_State;

namespace contort {

struct ActionDef;

inline constexpr int kMaxScriptSteps = 20'000;
inline constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 20;

// A script for one part: its inputs and results. Its own row holds all numbers that it sets, a vector as three.
struct ScriptPlan {
  enum class Kind { number, vector, hinge, ball, travel };
  struct Value {
    std::string name;  // "elbow_deg"
    Kind kind = Kind::number;
    int source = 0;  // index among the action's parameters, or of the joint's coordinate in a posture
    // Index in the row of values that the script sets; for a value that it only reads, equal to `source`.
    int first = 0;
    double low = 0.0;
    double high = 0.0;
    Mirrored mirrored = Mirrored::same;  // on the right side; same on the left
    int size() const { return kind == Kind::vector || kind == Kind::ball ? 3 : 1; }
  };
  std::string source;
  std::vector<Value> reads;  // parameters that it does not set
  std::vector<Value> sets;
  int row_size = 0;
  bool adds = false;  // its values are added to the joints' present values
};

// The data that a script may read in addition to parameters.
struct ScriptInput {
  double time_s = 0.0;
  double period_s = 0.0;
  double progress = 0.0;
  const Environment* environment = nullptr;
  Rigid world_from_character;  // on the ground under the root, +Z forward, as targets of `reach`
};

// Runs scripts. One for each thread.
class ScriptHost {
 public:
  ScriptHost();
  ~ScriptHost();
  ScriptHost(ScriptHost&&) noexcept;
  ScriptHost& operator=(ScriptHost&&) noexcept;

  // Checks that the lines compile. Code action.bad_script.
  static Result<Done> check(const std::vector<std::string>& lines);

  // Removes all compiled scripts.
  void begin();

  // Runs a script: `row` holds the values before and after. Codes action.bad_script (it does not compile) and
  // action.script_failed (it stopped while it ran, or set a value that is out of range), with pointers "/script/LINE".
  Result<Done> run(const ScriptPlan& plan, std::span<const double> params, const ScriptInput& in,
                   std::span<double> row);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The lines as one text.
std::string script_text(const std::vector<std::string>& lines);

// The rule of scripts that set joints: ik, or additive, a course, the part alone.
const ActionDef& script_def(bool adds);

// Returns a built-in action as a course: a script computes the place of the part in the present frame, not at the end
// of the action.
const ActionDef& course_of(const ActionDef& def);

// Returns true if a script may compute parameters of the action in each frame. Walks plan their steps, and aims their
// motion, from the parameters that they have when they begin, so they cannot. For `pose` and `extend` it is not needed,
// because a script can set joints directly.
bool takes_computed_params(const ActionDef& def, const Character& character, const Part& part);

// Only for an action whose script can run on the part (can_do in own_actions.cpp).
ScriptPlan plan_script(const ActionDesc& action, const Character& character, const Part& part);

// Fills the script's row before it runs: the joints of the posture (0 if the script adds), or the parameters.
void start_row(const ScriptPlan& plan, std::span<const double> params, const Posture& posture, std::span<double> row);

// Copies the values that a script has set into a row of the action's parameters.
void put_params(const ScriptPlan& plan, std::span<const double> row, std::span<double> params);

// Tries the script on the part at rest, at the begin, middle and end of the action, on level ground, with the presets
// of its parameters.
Result<Done> try_script(const ActionDesc& action, const Character& character, const Part& part);

}  // namespace contort
