// The registry of actions. Adding one is a row in action_list.inc, a rule in a .cpp of this folder, and a test; the
// command line, docs/reference/actions.md, the fuzzer and the report take it from there.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "generator/actions/key_poses.h"
#include "generator/actions/script.h"
#include "generator/motion/aim_ik.h"
#include "generator/motion/gait.h"
#include "generator/motion/limb_room.h"
#include "generator/motion/stand_on.h"
#include "model/character/character.h"
#include "model/core/result.h"
#include "model/generator.h"
#include "model/motion/intent.h"
#include "model/motion/motion.h"
#include "model/spec/action_use.h"
#include "model/world/environment.h"

namespace contort {

// The parts that one use of an action moves.
enum class Spread {
  own,   // the part that the spec names
  limb,  // that part and the parts that it carries in a chain, such as arm and hand; a torso, which carries several
         // parts, moves alone
  legs,  // the root part, which the spec must name, and all legs and feet
};

// The event that an action may cause on the parts that it moves.
enum class Tells {
  nothing,
  contact,      // of feet, or of the part that the spec names
  aim_reached,  // of the part that the spec names
  impact, // of the part that the spec names
};

// The report of a rule in addition to the posture; events of interrupts depend on it.
struct Feedback {
  bool contact = false;
  bool aim_reached = false;
  bool impact = false;
  double shortfall = 0.0;  // the unmet part of the request, in the request's unit (m, rad, m/s, fraction); 0: met
  bool at_range_end = false;  // a joint would have to leave its range
  bool is_slower = false;     // joints cannot move as fast as requested
  bool failed = false;        // the script of the action stopped
};

// The progress of an action at a frame, in time of its content.
struct ActionTime {
  double progress = 0.0;    // fraction of its period, [0, 1]
  double time_s = 0.0;      // since its start
  double duration_s = 0.0;  // length of its period
  double since_s = 0.0;     // since it took the part; after an interrupt this is later than its start
  double left_s = 0.0;      // from taking the part to its end
  double takes_s = 0.0;     // from its start to its end, as it is played
  double comes_in_s = 0.0;  // time in which it blends in and fades out by its use, as it is played; 0: automatic
  double fades_s = 0.0;
  double frame_s = 0.0;     // duration of a frame of the motion; a frame plays duration_s / takes_s times as much
                            // content
  double fades_by_s = 0.0;  // from its start to the end of its period, by which it has faded, as it is played
};

// The other hand that must hold the aimed object.
struct SecondHand {
  int arm = -1;            // its part; -1: the object is aimed with one hand
  int point = -1;          // the socket that it holds
  double reach_m = 0.0;    // from its shoulder to its grip, stretched
  double easy_rad = 0.0;   // the azimuth of the target from the chest at which both hands reach comfortably
  bool operator==(const SecondHand&) const = default;
};

// The data of an aiming action that are fixed from its start.
struct AimPlan {
  AimChain chain;
  std::shared_ptr<const AimTable> table;
  int chest = -1;      // the face of the torso that carries the part and can turn to help it; -1: no torso does
  bool helps = false;  // a torso that helps: it turns about the vertical, and does not lean
  SecondHand second;
};

// If the azimuth of a target from the chest is greater, the torso turns, as people do (docs/internals/aim.md).
inline constexpr double kEasyAim_rad = 60.0 * kRadPerDeg;

// With two hands on the object, people stand with the shoulder of the front hand forward, and aim across the chest.
inline constexpr double kBladed_rad = 30.0 * kRadPerDeg;
inline constexpr double kEasyOfTwoHands_rad = 15.0 * kRadPerDeg;  // the allowed deviation from that

// The azimuth of a point from the direction of a socket's +Z, about its +Y; [-pi, pi].
double azimuth_rad(const Rigid& world_from_socket, const Vec3& point_world_m);

// The state that one use of an action that moves several parts keeps from frame to frame.
struct WholeBody {
  Gait gait;
  GaitFrame frame;
  int begun = -1;    // frame in which the root was taken
  int made_in = -1;  // frame of `frame`
  std::array<bool, kMaxLegs> lands{};
  std::array<Rigid, kMaxLegs> seen_soles{};   // places of the feet when it begins, in the world
  std::array<Rigid, kMaxLegs> first_soles{};  // places at which the course wants the feet when it begins
  double swivel_rad = 0.0;  // rotation of a limb about the line to its target, if the request leaves it open
  Vec3 raised_by_m{0.0};     // offset from the easy place of a grip to the place where it has room to touch a wall
  double touch_gap_m = 0.0;  // distance from that wall
  int way_chosen_in = -1;                     // frame in which the action took the part
  Vec3 detour_rad{0.0};                       // detour round bodies on the way to the target (limb_way.h)
  double wanted_swivel_rad = 0.0;             // swivel to which it turns while its target moves
  bool chooses_swivel = false;                // the swivel is chosen again, because bodies are too near at the target
                                              // posture
  Vec3 swivel_chosen_for_m{0.0};  // the target at that time, from the limb's shoulder, in its carrier's frame
  Quat faced = kNoRotation;                   // direction of the root when a course first began, in the world
  std::array<double, kMaxAimCoords> aimed{};  // coordinates of the chain, in the previous frame
  bool has_help = false;                      // a torso or legs are turning for this aim
  bool had_help = false;                      // the same in the previous frame
  Pace pace;                                  // fraction of the requested gait that the legs can make
  GaitParams gait_params;                     // parameters of the gait at this pace
  bool comes_at_once = false;                 // the course begins where the figure stands, so it needs no blend
  double lasts_s = 0.0;                       // duration of the walk, s of content; then the figure stands
  bool is_slower = false;                     // it walks more slowly than requested, or turns less
  Vec3 over_feet_m{0.0};                      // offset of lowered hips that balances the figure's mass over its feet
  double deepest_bend = 1.0;                  // fraction of the way down that the legs allow, [0, 1]
  double since_s = 0.0;                       // time of `frame`, s of content since the root was taken
  std::optional<GaitFrame> lowest;            // lowest frame of a bend
};

// The data that a rule may read. Joints of carriers are final for this frame. On the layers ik and additive the part's
// own entries of `world` are its placement in the posture, and are scratch; on overwrite they are undefined.
struct RuleInput {
  const Character& character;
  const Part& part;                // the part that the rule moves
  std::span<const double> params;  // in the order of ActionDef::params; a vector takes three
  std::span<Rigid> world;
  TrialSpace scratch;
  const ActionTime& time;
  const Rigid& world_from_start;  // place of the character at its start
  const Environment& environment;
  std::span<const Leg> legs;
  const Rigid& stands_at;  // a turn about +Y and a place on the plane y = 0: the place to which legs have carried it
  const Rigid& base_stands_at;  // the same, where `world` has the root of the base on which the action plays
  const AimPlan* aim;  // only for actions with an own_point
  const KeyPlan* keys;  // only for key poses from a file
  const ScriptPlan* script;  // only for a script that sets joints; `params` is then its row
  Vec3 easy_grip_m;    // comfortable grip place of the named part, in the character's frame; arms only
  const Posture& from;  // the posture when it took its part: only the part's coordinates; for an aim, its limb's
  int frame;
  int took_over;  // frame in which it took the part
  double came_in;  // fraction to which a course has blended in, [0, 1]; courses of legs blend by themselves
  WholeBody& body;
  Feedback& feedback;
  LimbRoom& room;  // measures the distances of bodies
  bool has_mass;   // dynamics will move it: the motion is a target, which strength and balance must allow
};

struct ActionDef {
  std::string_view name;
  Layer layer;
  Timing timing;
  Spread spread;
  Promise promise;
  Tells tells;
  std::string_view help;
  // The parameters on a given part; they may depend on its joints.
  std::vector<ParamDef> (*params)(const Character&, const Part&);
  // Returns true if the part has everything that the action needs.
  bool (*supports)(const Character&, const Part&);
  // Writes the part's coordinates (and, on the root part, the root) of the target posture into a posture that holds the
  // layers beneath: the present posture for overwrite, the base for ik, everything below for additive.
  void (*rule)(const RuleInput&, Posture&);
};

// The built-in actions.
std::span<const ActionDef> all_actions();
const ActionDef* find_action(std::string_view name);  // nullptr if there is none

// An action of a part: a built-in one, or one from a file (action_desc.h), which uses the rule of a built-in one. Valid
// as long as the character is.
struct Action {
  std::string_view name;
  std::string_view help;
  const ActionDef* def = nullptr;
  const ActionDesc* desc = nullptr;  // for an action from a file; otherwise null
};

// The rule of a file's action; nullptr if `of` names none.
const ActionDef* def_of(const ActionDesc& desc);

// The actions in the order of the registry, then of the files. Of several with one name, the one for this part by name
// counts; if there is none, the one for its kind; otherwise the built-in one.
std::vector<Action> actions_of(const Character& character, const Part& part);

// The action of that name, if the part can do it.
std::optional<Action> find_action(const Character& character, const Part& part, std::string_view name);

// Returns true for names of built-in actions and of the character's files.
bool is_action_name(const Character& character, std::string_view name);

// The parameters of an action on a part. The file's values are their presets, mirrored on the right side.
std::vector<ParamDef> params_of(const Action& action, const Character& character, const Part& part);

ParamValue mirrored(Mirrored how, const ParamValue& value);

// Checks that each part that an action file names, and some part of each kind that it names, can perform the action.
// Scripts are tried once. Codes action.unknown_action, .unsupported, .unknown_part, .stock_part, .duplicate_name,
// .fits_nothing, .unknown_param, .wrong_type, .out_of_range, .bad_script, .script_failed, with pointers into the file.
Result<Done> check_actions(const Library& library);

// Points of attached objects that other parts than this one carry: "foregrip", "muzzle".
std::vector<std::string> object_points(const Character& character, const Part& part);

// Points that this part, or a part attached to it, carries.
std::vector<std::string> own_points(const Character& character, const Part& part);

// Returns true if a part carries several parts, as a torso does. Such a part does not form one limb with them.
bool is_trunk(const Character& character, int part);

// The parts that one use moves, carriers first.
std::vector<int> parts_moved(const ActionDef& action, const Character& character, int named_part);

// Returns true if a number, vector or choice is allowed. Codes spec.wrong_type, .out_of_range.
Result<Done> check_value(const ParamDef& def, const ParamValue& value);

// Looks up and checks the parameters of one use. Codes spec.unknown_param, .wrong_type, .out_of_range, .unknown_point;
// pointers relative to the use ("/params/elbow_deg").
Result<std::vector<double>> bind_params(const Action& action, const Character& character, const Part& part,
                                        const std::map<std::string, ParamValue>& values);

}  // namespace contort
