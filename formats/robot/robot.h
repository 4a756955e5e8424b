// A robot as a URDF or MJCF file describes it: a tree of bodies, the joints that move them, and the bodies that may
// touch. Vectors are in the file's axes: +Z up, +X forward, +Y to the left. Lengths are metres, angles radians.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "model/character/inertia.h"
#include "model/character/shape.h"

namespace contort {

// The limits of a robot's file. They are checked before memory is allocated.
inline constexpr std::size_t kMaxRobotBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxRobotBodies = 2048;
inline constexpr std::size_t kMaxRobotItems = 8192;  // joints, shapes, and pairs, each
inline constexpr std::size_t kMaxRobotNotes = 1000;

inline constexpr double kNoLimit = std::numeric_limits<double>::infinity();

enum class RobotJointKind { hinge, travel, ball };

struct RobotJoint {
  std::string name{};
  RobotJointKind kind = RobotJointKind::hinge;
  Vec3 anchor_m{0.0};        // in the body's frame
  Vec3 axis{0.0, 0.0, 1.0};  // unit, in the body's frame
  double low = -kNoLimit;    // rad or m; a ball has only an upper one, the greatest angle from rest
  double high = kNoLimit;
  double at_rest = 0.0;          // the joint's value in the file's pose
  double greatest_speed = 0.0;   // rad/s or m/s; 0: unknown
  double greatest_effort = 0.0;  // N m or N; 0: unknown
  std::string follows{};         // URDF's mimic: the joint that this one follows; "" for none
  double multiplier = 1.0;
  double offset = 0.0;
  bool operator==(const RobotJoint&) const = default;
};

struct RobotShape {
  ColliderShape shape{};  // in the body's frame; for a mesh, set after its file was read
  std::string mesh{};     // the mesh's file, as the robot's file names it; "" after it was read
  Rigid body_from_mesh{};
  Vec3 mesh_scale{1.0};
  unsigned groups = 1;    // MJCF's contype: two shapes touch if the groups of one meet the partners of the other
  unsigned partners = 1;  // MJCF's conaffinity
  bool operator==(const RobotShape&) const = default;
};

struct RobotBody {
  std::string name{};
  int parent = -1;                   // an earlier body; -1 for the first one, which is the root
  Rigid parent_from_body{};          // in the file's pose; for the root: in the world
  std::vector<RobotJoint> joints{};  // in their order; empty: the body is fixed to its parent
  BodyInertia inertia{};             // axes of the body's frame
  std::vector<RobotShape> shapes{};
  bool operator==(const RobotBody&) const = default;
};

struct RobotPair {
  std::string a;  // names of bodies
  std::string b;
  std::string reason;
  bool operator==(const RobotPair&) const = default;
};

struct RobotModel {
  std::string name;
  std::vector<RobotBody> bodies;  // parents first
  bool has_free_root = false;     // the file lets the root move; otherwise it is bolted to the ground
  std::vector<RobotPair> may_touch;
  std::string srdf{};              // path of the SRDF that was read; "" for none
  std::vector<std::string> notes;  // features that a character cannot express, and guesses
  bool is_skeleton = false;        // it is a skeleton of motion capture, not a robot
  bool operator==(const RobotModel&) const = default;
};

// Returns the index of a body; -1 if there is none.
int find_body(const RobotModel& robot, const std::string& name);

// Adds a note, up to kMaxRobotNotes.
void note(RobotModel& robot, std::string text);

// Adds one note about several things: "TEXT: a, b, c and 5 more." Nothing if there are none.
void note_all(RobotModel& robot, const std::string& text, const std::vector<std::string>& names);

}  // namespace contort
