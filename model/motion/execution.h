// An Execution is the result of a generator for a request, with all data that checks may use.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/character/character.h"
#include "model/motion/foreign.h"
#include "model/motion/intent.h"
#include "model/motion/motion.h"
#include "model/world/environment.h"

namespace contort {

// The known part of the root's path.
enum class RootPath : std::uint8_t {
  told,         // all of it
  on_the_spot,  // only its height; the figure walks on the spot, as in clips of games, where an engine moves the figure
  unknown,      // nothing, because the file has no path: the root stays at its rest place
};

// A joint that must follow another one, such as by URDF's mimic: its coordinate is multiplier * the leader's coordinate
// + offset. Both have one coordinate.
struct Coupling {
  int joint = 0;
  int leader = 0;
  double multiplier = 1.0;
  double offset = 0.0;  // rad or m
  bool is_of_rotation = false;  // the joint's angle was read from a rotation, so whole turns are unknown
  bool operator==(const Coupling&) const = default;
};

struct Execution {
  std::shared_ptr<const Character> character;  // never null once there is a motion
  Environment environment;                     // level ground at height 0 by default
  Motion motion;
  std::optional<Intent> intent;  // empty if the generator gives no intent
  RootPath path = RootPath::told;
  std::optional<ForeignFacts> foreign{};  // only from a generator that is a program of its own
  std::vector<Coupling> couplings{};

  const Intent* said() const { return intent ? &*intent : nullptr; }
};

}  // namespace contort
