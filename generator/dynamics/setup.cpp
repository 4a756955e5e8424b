// Builds the dynamics of a stage from a description.
#include <algorithm>
#include <cmath>

#include "generator/dynamics/easy_acceleration.h"
#include "generator/dynamics/simulate.h"

namespace contort {

namespace {

constexpr double kTicksPerSecond = 120.0;

Issue unknown(const std::string& pointer, const std::string& name, const std::string& what) {
  return {"dynamics.unknown_name", pointer, "found \"" + name + "\", which is no " + what};
}

Result<Load> build_load(const LoadDesc& desc, const Character& character, const std::string& pointer) {
  if (character.find_part(desc.slot) < 0) return unknown(pointer + "/slot", desc.slot, "slot of " + character.name());
  const int found = character.find_socket(desc.slot + "/" + desc.socket);
  if (found < 0) return unknown(pointer + "/socket", desc.socket, "socket of the part in " + desc.slot);
  const Socket& socket = character.sockets()[static_cast<std::size_t>(found)];
  return box_load(socket.joint, socket.joint_from_socket * Rigid{kNoRotation, desc.position_m}, desc.size_m,
                  desc.mass_kg);
}

// The joint that moves a part: its first, or for a part that has no joints of its own the joint that carries its
// colliders or sockets.
int first_joint(const Character& character, const Part& part) {
  if (part.joint_count > 0) return part.first_joint;
  for (const Collider& collider : character.colliders())
    if (collider.name == part.slot || collider.name.starts_with(part.slot + "/")) return collider.joint;
  return 0;
}

Result<Impact> build_blow(const ImpactDesc& desc, const Character& character, const Quat& start,
                          const std::string& pointer) {
  const int part = character.find_part(desc.slot);
  if (part < 0) return unknown(pointer + "/slot", desc.slot, "slot of " + character.name());
  int joint = first_joint(character, character.parts()[static_cast<std::size_t>(part)]);
  if (!desc.joint.empty()) joint = character.find_joint(part, desc.joint);
  if (joint < 0) return unknown(pointer + "/joint", desc.joint, "joint of the part in " + desc.slot);
  return Impact{desc.frame, joint, desc.point_m, start * desc.impulse_N_s};
}

}  // namespace

Result<DynamicsSetup> build_dynamics(const DynamicsDesc& desc, const Character& character, std::span<const Leg> legs,
                                     double rate_hz, const Quat& start) {
  DynamicsSetup setup;
  setup.mode = desc.mode;
  setup.ticks_per_frame = desc.ticks_per_frame;
  if (desc.ticks_per_frame == 0)
    setup.ticks_per_frame = std::max(1, static_cast<int>(std::ceil(kTicksPerSecond / rate_hz - 1e-9)));
  std::vector<Load> loads;
  for (std::size_t i = 0; i < desc.loads.size(); ++i) {
    Result<Load> load = build_load(desc.loads[i], character, "/loads/" + std::to_string(i));
    if (!load) return load.issue();
    loads.push_back(*load);
  }
  for (std::size_t i = 0; i < desc.impacts.size(); ++i) {
    Result<Impact> blow = build_blow(desc.impacts[i], character, start, "/impacts/" + std::to_string(i));
    if (!blow) return blow.issue();
    if (blow->impulse_N_s != Vec3(0.0)) setup.impacts.push_back(*blow);  // one of nothing happens to nobody
  }
  setup.figure = build_figure(character, legs, loads);
  setup.easy = easy_accelerations(character, setup.figure);
  setup.touches = touch_points(character, setup.figure);
  return setup;
}

}  // namespace contort
