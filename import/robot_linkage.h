// A robot's bodies as the joints of a character: bodies that are fixed to each other become one, and each joint's frame
// is where its motion happens. Vectors are in a character's axes: +Y up, +Z forward, +X to the left.
#pragma once

#include <string>
#include <vector>

#include "formats/robot/robot.h"
#include "import/robot.h"
#include "model/character/desc.h"

namespace contort {

struct LinkageShape {
  std::string body;  // of the file
  ColliderShape shape;
  unsigned groups = 1;
  unsigned partners = 1;
  bool is_guessed = false;  // from the body's inertia, as its mesh was not read
};

// Bodies that move as one: the joints between it and its carrier, and what is fixed to the last one.
struct RobotLink {
  std::string body{};               // of the file, the first one
  int parent = -1;                  // an earlier link; -1 for the root
  std::vector<JointDesc> joints{};  // without names and parents; none for the root
  std::vector<int> reports{};       // of each joint, into Linkage::reports
  BodyInertia inertia{};
  std::vector<LinkageShape> shapes{};
};

struct Linkage {
  std::vector<RobotLink> links;  // parents first; the root is the first
  std::vector<int> link_of_body;
  std::vector<RobotJointReport> reports;
  std::vector<std::string> notes;
};

Linkage linkage_of(const RobotModel& robot);

}  // namespace contort
