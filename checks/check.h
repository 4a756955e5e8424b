// A check measures signed margins: > 0 safe, 0 at the limit, < 0 violated; NaN counts as violated. One fold turns them
// into findings, and nothing else does. Adding a check is one row in check_list.inc, one measuring function, two
// exemplars in the tests (just inside, just outside) and a line in docs/reference/checks.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/character/character.h"
#include "model/motion/execution.h"
#include "model/motion/intent.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// The data that a check needs in addition to a character and a motion of it. If the data are missing, the check
// reports that it could not judge.
enum class Needs : std::uint8_t {
  motion,            // nothing else
  height,            // the height of the root above the ground
  path,              // the path of the root in the world
  intent,            // the generator's intent
  kinematic_intent,  // the generator's intent, for a motion that dynamics did not change
  response,          // the data that dynamics recorded
  clip,              // a clip as it is in its file, instead of a motion
  couplings,         // joints that must follow others
  foreign,           // the data of a generator that is a program of its own
};

// The kind of a failure, for grouping (docs/reference/causes.md).
enum class CheckKind : std::uint8_t {
  broken,    // no motion, or NaN and infinite values
  speed,     // too fast, too abrupt
  range,     // a joint or point beyond its limits
  contact,   // the figure touches itself
  ground,    // the figure sinks into the ground, or slides on it
  obstacle,  // the figure passes through an obstacle
  goal,      // a target is missed
  queue,     // sequences do not follow each other as they should, or leave an offset behind
  dynamics,  // effort, balance, recovery
};
std::span<const std::string_view> check_kind_names();  // in the order of the enum

// The kind of a check by name. Crashes, timeouts and memory have no row in the manifest; they are `broken`.
CheckKind kind_of_check(std::string_view check);

struct ClipInput;  // clip_check.h
struct ClipCheckResult;

struct CheckInput {
  const Character& character;
  const Motion& motion;
  std::span<const Rigid>
      world;  // world_from_joint, frame-major: frame * joint_count + joint; may be empty, see CheckDef
  const CheckSettings& settings;
  const Environment& environment;
  const Intent* intent = nullptr;  // the generator's intent; null if it gives none
  RootPath path = RootPath::told;
  const ForeignFacts* foreign = nullptr;  // only from a generator that is a program of its own
  std::span<const Coupling> couplings{};  // joints that must follow others

  bool may_jump_into(int frame) const { return foreign != nullptr && foreign->may_jump_into(frame); }
  bool may_root_jump_into(int frame) const { return foreign != nullptr && foreign->may_root_jump_into(frame); }

  std::span<const Rigid> world_at(int frame) const {
    const std::size_t joints = character.joints().size();
    return world.subspan(static_cast<std::size_t>(frame) * joints, joints);
  }
};

struct Subject {
  std::string name;       // "arm_left/elbow max"
  std::string_view unit;  // unit of its margins
};

struct CheckDef {
  std::string_view name;  // "joint_range"
  CheckKind kind;
  double scale;           // margin / scale compares checks: 0.1 rad out of range is "as bad as" 2 cm deep
  double resolution;      // margins down to -resolution are rounding, not violations
  bool needs_world;       // reads CheckInput::world, which is computed only if some check needs it
  Needs needs;
  std::string_view nothing;  // the reason if its needs are met and it still judged nothing
  std::string_view help;
  // The judged subjects, numbered from 0. Checks of clips have no such subjects and measure nothing.
  int (*subject_count)(const Character&);
  Subject (*subject)(const Character&, int);
  // Reports the margin of every subject in every frame that the check judges. It may leave out margins that change no
  // result (fold.h).
  void (*measure)(const CheckInput&, MarginFold&);
  ClipCheckResult (*in_clip)(const ClipInput&) = nullptr;  // only for checks that judge clips as they are in their
                                                           // files
};

// A check that judged, with its number of subjects. The name refers to the manifest's text.
struct JudgedCheck {
  std::string_view check;
  int subjects = 0;
  bool operator==(const JudgedCheck&) const = default;
};

// A check that could not judge, with the reason, such as "the motion has no dynamics".
struct NotJudged {
  std::string_view check;
  std::string_view reason;
  bool operator==(const NotJudged&) const = default;
};

std::span<const CheckDef> all_checks();

// Returns the reason why a check cannot judge a motion; empty if it can.
std::string_view reason_not_to_judge(const CheckDef& check, const CheckInput& input);

// Returns the check of this name, which must exist.
const CheckDef& find_check(std::string_view name);

}  // namespace contort
