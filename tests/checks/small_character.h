// A small character for exemplars, made of values: a base with an arm on either side. An arm lifts (hinge), slides
// (prismatic) and has a wrist (ball); a box hangs on its slider. At rest the boxes' inner faces are 0.4 m apart.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "checks/check.h"
#include "checks/judge.h"
#include "model/character/library.h"
#include "model/motion/kinematics.h"

namespace contort::small {

inline PartDesc base_part() {
  PartDesc part;
  part.name = "small_base";
  part.kind = "base";
  part.colliders.push_back({"core", "", Box{{0, 0, 0}, {0.05, 0.05, 0.05}, {}}});
  part.sockets.push_back({"left", "", {0.3, 0, 0}, {}});
  part.sockets.push_back({"right", "", {-0.3, 0, 0}, {}});
  return part;
}

inline JointDesc joint_desc(const char* name, const char* parent, JointType type, const Vec3& axis) {
  JointDesc joint;
  joint.name = name;
  joint.parent = parent;
  joint.type = type;
  joint.axis = axis;
  return joint;
}

inline PartDesc arm_part() {
  PartDesc part;
  part.name = "small_arm";
  part.kind = "arm";
  JointDesc slide = joint_desc("slide", "", JointType::prismatic, {1, 0, 0});
  slide.low_m = -0.25, slide.high_m = 0.1, slide.max_speed_m_s = 2.0, slide.mass_kg = 1.0;
  JointDesc lift = joint_desc("lift", "slide", JointType::hinge, {0, 0, 1});
  lift.position_m = {0.2, 0, 0};
  lift.low_deg = -20, lift.high_deg = 50, lift.max_speed_deg_s = 300, lift.mass_kg = 1.0;
  JointDesc wrist = joint_desc("wrist", "lift", JointType::ball, {0, -1, 0});
  wrist.position_m = {0.2, 0, 0};
  wrist.low_deg = -40, wrist.high_deg = 60, wrist.swing_axis = {1, 0, 0};
  wrist.swing_deg = {35, 80}, wrist.swing_center_deg = {10, 5, -20}, wrist.max_speed_deg_s = 400;
  wrist.mass_kg = 1.0;
  part.joints = {slide, lift, wrist};
  part.colliders.push_back({"box", "slide", Box{{0, 0, 0}, {0.1, 0.1, 0.1}, {}}});
  part.sockets.push_back({"inside", "slide", {-0.1, 0, 0}, {}});
  part.sockets.push_back({"grip", "slide", {0, 0, 0}, {}});  // at rest at the base's socket
  return part;
}

inline Library library() {
  Library library;
  library.parts["small_base"] = base_part();
  library.parts["small_arm"] = arm_part();
  ObjectDesc peg;
  peg.name = "peg";
  peg.colliders.push_back({"tip", "", Sphere{{-0.05, 0, 0}, 0.05}});  // reaches 0.1 m inward from the box
  library.objects["peg"] = peg;
  CharacterDesc desc;
  desc.name = "small";
  desc.slots.push_back({"base", "base", Side::center, "", "", {"small_base"}});
  desc.slots.push_back({"arm_left", "arm", Side::left, "base", "left", {"small_arm"}});
  desc.slots.push_back({"arm_right", "arm", Side::right, "base", "right", {"small_arm"}});
  desc.objects = {"peg"};
  // The left box's inner side is 0.2 m left of the middle; 5 cm further left at most.
  desc.regions = {{"left_box", "arm_left/inside", Box{{-0.375, 0.1, 0}, {0.625, 1, 1}, {}}, false}};
  library.characters["small"] = desc;
  return library;
}

inline Character build(const Library& from = library(), const CharacterChoice& choice = {"small", {}, {}}) {
  Result<Character> character = build_character(choice, from);
  if (!character) ADD_FAILURE() << to_line(character.issue());
  return std::move(character).value();
}

inline Motion at_rest(const Character& character, int frames = 1, double rate_hz = 60.0) {
  Motion motion;
  motion.rate_hz = rate_hz;
  motion.frame_count = frames;
  motion.coord_count = character.coord_count();
  motion.root.assign(static_cast<std::size_t>(frames), character.rest_root());
  for (int f = 0; f < frames; ++f)
    motion.coords.insert(motion.coords.end(), character.rest_coords().begin(), character.rest_coords().end());
  return motion;
}

inline const Joint& joint_of(const Character& character, const std::string& name) {
  const int index = character.find_joint(name);
  EXPECT_GE(index, 0) << name;
  return character.joints()[static_cast<std::size_t>(std::max(index, 0))];
}

inline void set(Motion& motion, int frame, const Joint& joint, double value) {
  motion.row(frame)[static_cast<std::size_t>(joint.coord)] = value;
}
inline void set(Motion& motion, int frame, const Joint& joint, const Quat& q) {
  double* out = motion.row(frame).data() + joint.coord;
  out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
}

// Returns a motion at rest as if dynamics had made it: on its feet, without any effort.
inline Motion moved_by_dynamics(const Character& character, int frames = 1) {
  Motion motion = at_rest(character, frames);
  Response& response = motion.response;
  for (const Joint& joint : character.joints()) response.dof_count += freedom_count(joint.kind);
  response.target_coords = motion.coords, response.target_root = motion.root;
  const auto count = static_cast<std::size_t>(frames) * static_cast<std::size_t>(response.dof_count);
  response.efforts.assign(count, 0.0), response.control.assign(count, 0.0);
  response.stances.assign(static_cast<std::size_t>(frames), {Footing::standing, false, 3, 3, {}, 0.1});
  return motion;
}

// The first freedom of a joint.
inline std::size_t freedom_of(const Character& character, const Joint& joint) {
  int first = 0;
  for (const Joint& other : character.joints()) {
    if (&other == &joint) break;
    first += freedom_count(other.kind);
  }
  return static_cast<std::size_t>(first);
}

inline const CheckDef& check_named(const std::string& name) {
  for (const CheckDef& check : all_checks())
    if (check.name == name) return check;
  ADD_FAILURE() << "no check " << name;
  return all_checks().front();
}

// The least margin of one subject over the motion, before any fold to findings.
inline double margin_of(const std::string& check_name, const Character& character, const Motion& motion,
                        const std::string& subject) {
  const CheckDef& check = check_named(check_name);
  const std::size_t joints = character.joints().size();
  std::vector<Rigid> world(joints * static_cast<std::size_t>(motion.frame_count));
  for (int f = 0; f < motion.frame_count; ++f) {
    const auto at = static_cast<std::size_t>(f);
    forward_kinematics(character, motion.root[at], motion.row(f), std::span(world).subspan(at * joints, joints));
  }
  const CheckSettings settings;
  MarginFold fold(check.subject_count(character), settings.merge_gap_frames);
  const Environment level;
  check.measure({character, motion, world, settings, level, nullptr}, fold);
  for (int s = 0; s < check.subject_count(character); ++s)
    if (check.subject(character, s).name == subject) return fold.smallest()[static_cast<std::size_t>(s)];
  ADD_FAILURE() << check_name << " does not judge " << subject;
  return 0.0;
}

inline std::vector<std::string> subjects_of(const std::string& check_name, const Character& character) {
  const CheckDef& check = check_named(check_name);
  std::vector<std::string> names;
  for (int s = 0; s < check.subject_count(character); ++s) names.push_back(check.subject(character, s).name);
  return names;
}

}  // namespace contort::small
