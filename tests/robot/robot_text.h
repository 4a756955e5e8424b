// Robots that the tests write, as the text of URDF and MJCF files.
#pragma once

#include <rapidcheck.h>

#include <cstdint>
#include <cstdio>
#include <random>
#include <string>

#include "import/robot.h"
#include "model/character/library.h"

namespace contort::fixtures {

inline std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Draws from one seed. A robot takes hundreds of draws, each of which would be much slower with RapidCheck.
struct Draw {
  std::mt19937_64 engine{*rc::gen::arbitrary<std::uint32_t>()};
  int whole(int low, int high) { return low + static_cast<int>(engine() % static_cast<std::uint64_t>(high - low + 1)); }
  double between(double low, double high) { return low + (high - low) * whole(0, 1000) / 1000.0; }
  std::string vector(double low, double high) {
    const double x = between(low, high), y = between(low, high), z = between(low, high);
    return number(x) + " " + number(y) + " " + number(z);
  }
};

// Two links and one joint; `joint` has the attributes and elements of the joint.
inline std::string two_links(const std::string& type, const std::string& inside) {
  return "<robot name=\"r\"><link name=\"a\"><inertial><mass value=\"2\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" "
         "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link><link name=\"b\"><inertial><mass value=\"1\"/><inertia "
         "ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><collision><geometry><sphere "
         "radius=\"0.1\"/></geometry></collision></link><joint name=\"j\" type=\"" +
         type + "\"><parent link=\"a\"/><child link=\"b\"/>" + inside + "</joint></robot>";
}

inline std::string in_mujoco(const std::string& world, const std::string& before = "", const std::string& after = "") {
  return "<mujoco>" + before + "<worldbody>" + world + "</worldbody>" + after + "</mujoco>";
}

// The character that the import's files make.
inline Result<Character> character_of(const ImportedRobot& robot) {
  Library library;
  for (const PartDesc& part : robot.parts) library.parts[part.name] = part;
  library.characters[robot.character.name] = robot.character;
  return build_character({robot.character.name, {}, {}}, library);
}

}  // namespace contort::fixtures
