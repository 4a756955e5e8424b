// Converts a robot's bodies to the joints of a character. Bodies that are fixed to each other become one, and the
// origin of each joint's frame lies on the joint's axis. Vectors are in a character's axes: +Y up, +Z forward, +X to
// the left.
#pragma once

#include <string>
#include <vector>

#include "formats/robot/robot.h"
#include "import/robot.h"
#include "model/character/desc.h"

namespace contort {

struct LinkageShape {
  std::string body;  // name of the body in the file
  ColliderShape shape;
  unsigned groups = 1;
  unsigned partners = 1;
  bool is_guessed = false;  // made from the body's inertia, because its mesh was not read
};

// Bodies that move as one: the joints between them and their carrier, and everything that is fixed to the last joint.
struct RobotLink {
  std::string body{};               // name in the file of the first body
  int parent = -1;                  // an earlier link; -1 for the root
  std::vector<JointDesc> joints{};  // without names and parents; none for the root
  std::vector<int> reports{};       // for each joint its index in Linkage::reports
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
