// A check measures signed margins: > 0 safe, 0 at the limit, < 0 violated; NaN counts as violated. One fold turns them
// into findings, and nothing else does. Adding a check is one row in check_list.inc, one measuring function, and two
// exemplars in the tests (just inside, just outside).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/character/character.h"
#include "model/motion/intent.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

struct CheckInput {
  const Character& character;
  const Motion& motion;
  std::span<const Rigid>
      world;  // world_from_joint, frame-major: frame * joint_count + joint; may be empty, see CheckDef
  const CheckSettings& settings;
  const Environment& environment;
  const Intent* intent = nullptr;  // what the generator says that it meant; null where it says nothing

  std::span<const Rigid> world_at(int frame) const {
    const std::size_t joints = character.joints().size();
    return world.subspan(static_cast<std::size_t>(frame) * joints, joints);
  }
};

struct Subject {
  std::string name;       // "arm_left/elbow max"
  std::string_view unit;  // of its margins
};

struct CheckDef {
  std::string_view name;  // "joint_range"
  double scale;           // margin / scale compares checks: 0.1 rad out of range is "as bad as" 2 cm deep
  double resolution;      // margins down to -resolution are rounding, not violations
  bool needs_world;       // reads CheckInput::world; where no check does, nobody computes it
  std::string_view help;
  // What is judged, numbered from 0.
  int (*subject_count)(const Character&);
  Subject (*subject)(const Character&, int);
  // Reports every subject in every frame that it judges; it may leave out margins that change nothing (fold.h).
  void (*measure)(const CheckInput&, MarginFold&);
};

std::span<const CheckDef> all_checks();

// The row of this name; there must be one.
const CheckDef& find_check(std::string_view name);

}  // namespace contort
