// The dynamics of a Spec: the control mode, loads, and impacts.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/math.h"

namespace contort {

enum class Mode {
  kinematic,  // the motion is that of the actions
  tracking,   // a simulated figure follows that motion, each joint separately; standing feet stay in place
  dynamic,    // like tracking, but the figure yields to loads and impacts, keeps its balance, and has limited strength
};
std::span<const std::string_view> mode_names();  // in the order of the enum

// A box that a part carries. The target motion ignores it.
struct LoadDesc {
  std::string slot;
  std::string socket;           // a socket of that slot's part
  Vec3 position_m{0.0};         // the box's centre, in the socket's frame
  Vec3 size_m{0.3, 0.4, 0.15};  // along the socket's axes
  double mass_kg = 5.0;         // evenly distributed in the box
  bool operator==(const LoadDesc&) const = default;
};

// An impact: an instantaneous impulse at a point of a part.
struct ImpactDesc {
  int frame = 0;  // it acts at the beginning of this frame
  std::string slot;
  std::string joint;      // joint of that slot's part; "": its first joint, or the joint to which the part is fixed
  Vec3 point_m{0.0};      // in the joint's frame
  Vec3 impulse_N_s{0.0};  // along the axes of the start (StartDesc)
  bool operator==(const ImpactDesc&) const = default;
};

struct DynamicsDesc {
  Mode mode = Mode::kinematic;
  int ticks_per_frame = 0;  // control steps per frame; 0: as many as give 120 per second
  std::vector<LoadDesc> loads;
  std::vector<ImpactDesc> impacts;
  bool operator==(const DynamicsDesc&) const = default;
};

}  // namespace contort
