// The registry of actions. Adding one is a row in action_list.inc, a rule in a .cpp of this folder, and a test; the
// command line, docs/actions.md, the fuzzer and the report take it from there.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "generator/actions/action_use.h"
#include "generator/character/character.h"
#include "generator/core/result.h"
#include "generator/motion/aim_ik.h"
#include "generator/motion/gait.h"
#include "generator/motion/motion.h"
#include "generator/world/environment.h"

namespace contort {

// Order of evaluation on one part: overwrite, then ik on top, then additive.
enum class Layer { overwrite, ik, additive };
std::string_view layer_name(Layer layer);

// A goal is reached at the end of the action's period; a course is a posture as a function of time (docs/timeline.md).
enum class Timing { goal, course };

// What one use of an action moves.
enum class Spread {
  own,   // the part that the spec names
  limb,  // and the parts that hang on it, one after another: arm and hand
  legs,  // it must be the root part: and all legs and feet
};

enum class ParamType {
  number,
  vector,
  choice,        // one of a few words: the rule sees its index
  object_point,  // the name of a point of an attached object that others carry: the rule sees the index of its socket
  own_point,     // the same of a point that the part carries: "grip", "muzzle"
};

// How the fuzzer chooses values; people may write any value within low and high.
enum class Domain {
  uniform,       // anywhere in [low, high]
  joint_range,   // within the limits of the joint that the parameter is named after
  within_reach,  // a point that the part's reach chain can just about reach
  around,        // a point some metres around the character
};

struct ParamDef {
  std::string name;  // ends in its unit: "azimuth_deg", "target_m"
  ParamType type = ParamType::number;
  double low = 0.0;
  double high = 0.0;
  ParamValue preset = 0.0;  // the value where a spec gives none
  std::vector<std::string> choices{};  // of a choice
  bool optional = false;    // no value at all is allowed: the rule sees NaN
  Domain domain = Domain::uniform;
  std::string help;
  bool operator==(const ParamDef&) const = default;
};

// What a rule has to say to those who wait for it, beside the posture (events of interrupts).
struct Feedback {
  bool contact = false;
  bool aim_reached = false;
  bool impact = false;
};

// Where an action stands at a frame, in time of its content.
struct ActionTime {
  double progress = 0.0;    // of its period, [0, 1]
  double time_s = 0.0;      // since its start
  double duration_s = 0.0;  // of its period
  double since_s = 0.0;     // since it took the part; later than its start where it was cut and went on
  double left_s = 0.0;      // from then to its end
};

// What an action that aims knows from the start.
struct AimPlan {
  AimChain chain;
  std::shared_ptr<const AimTable> table;
};

// What one use of an action that moves several parts remembers from frame to frame.
struct WholeBody {
  Gait gait;
  GaitFrame frame;
  int begun = -1;    // frame in which the root was taken
  int made_in = -1;  // frame of `frame`
  std::array<bool, kMaxLegs> lands{};
  std::array<double, kMaxAimCoords> first_aim{};  // of the chain
  std::array<double, kMaxAimCoords> aimed{};
};

// What a rule may look at. Joints of carriers are final for this frame. On the layers ik and additive the part's own
// entries of `world` stand where the posture puts them, and are scratch; on overwrite they mean nothing.
struct RuleInput {
  const Character& character;
  const Part& part;                // the one to move
  std::span<const double> params;  // in the order of ActionDef::params; a vector takes three
  std::span<Rigid> world;
  const ActionTime& time;
  const Rigid& world_from_start;  // where the character stood at first
  const Environment& environment;
  std::span<const Leg> legs;
  const AimPlan* aim;  // of actions with an own_point
  Vec3 easy_grip_m;    // of the named part, in the character's frame; arms only
  const Posture& from;  // where it took its part over; the part's own coordinates only
  int frame;
  int took_over;  // frame in which it took the part
  WholeBody& body;
  Feedback& feedback;
};

// The lattice on which the fuzzer draws and shrinks a parameter, by its unit: whole degrees, centimetres, 0.1 m/s,
// hundredths of a share.
double steps_per_unit(std::string_view param_name);

struct ActionDef {
  std::string_view name;
  Layer layer;
  Timing timing;
  Spread spread;
  std::string_view help;
  // The parameters on a given part; they may depend on its joints.
  std::vector<ParamDef> (*params)(const Character&, const Part&);
  // Whether the part has what the action needs.
  bool (*supports)(const Character&, const Part&);
  // Writes the part's coordinates (and, on the root part, the root) of the target posture into one that holds what is
  // beneath: the present posture for overwrite, the base for ik, everything below for additive.
  void (*rule)(const RuleInput&, Posture&);
};

std::span<const ActionDef> all_actions();
const ActionDef* find_action(std::string_view name);  // nullptr where there is none

// The part that carries this one; the root part for itself.
int carrier_of(const Character& character, int part);

// Points of attached objects that others than this part carry: "foregrip", "muzzle".
std::vector<std::string> object_points(const Character& character, const Part& part);

// Points that this part or one that hangs on it carries.
std::vector<std::string> own_points(const Character& character, const Part& part);

// The parts that one use moves, carriers first.
std::vector<int> parts_moved(const ActionDef& action, const Character& character, int named_part);

// Looks up and checks the parameters of one use. Codes spec.unknown_param, .wrong_type, .out_of_range, .unknown_point;
// pointers relative to the use ("/params/elbow_deg").
Result<std::vector<double>> bind_params(const ActionDef& action, const Character& character, const Part& part,
                                        const std::map<std::string, ParamValue>& values);

}  // namespace contort
