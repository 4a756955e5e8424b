// Chains that aim, and directions that they can aim in: shared by tests and bench.
#pragma once

#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "generator/motion/aim_chain.h"
#include "generator/motion/aim_table.h"
#include "generator/motion/joint_clamp.h"
#include "model/character/character.h"
#include "model/motion/kinematics.h"

namespace contort::fixtures {

struct AimScene {
  std::string name;
  Character character;
  AimChain chain;
};

struct AimSceneRow {
  const char* name;
  const char* character;
  const char* arm;  // part of the right arm; "" is the default
  bool rifle;
  const char* slot;
  const char* socket;
};

// GoogleTest prints parameters with it; without it, their bytes, which hold addresses.
inline void PrintTo(const AimSceneRow& row, std::ostream* out) { *out << row.name; }

inline constexpr AimSceneRow kAimScenes[] = {
    {"human_grip", "human", "", false, "arm_right", "hand_right/grip"},
    {"human_grip_rifle", "human", "", true, "arm_right", "hand_right/grip"},
    {"human_muzzle", "human", "", true, "arm_right", "object:rifle/muzzle"},
    {"mech_slim_grip", "mech", "mech_arm_slim", false, "arm_right", "arm_right/grip"},
    {"mech_slim_grip_rifle", "mech", "mech_arm_slim", true, "arm_right", "arm_right/grip"},
    {"mech_slim_muzzle", "mech", "mech_arm_slim", true, "arm_right", "object:rifle/muzzle"},
    {"mech_shield_grip", "mech", "mech_arm_shield", false, "arm_right", "arm_right/grip"},
    {"mech_shield_grip_rifle", "mech", "mech_arm_shield", true, "arm_right", "arm_right/grip"},
    {"mech_shield_muzzle", "mech", "mech_arm_shield", true, "arm_right", "object:rifle/muzzle"},
    {"mech_extend_grip", "mech", "mech_arm_extend", false, "arm_right", "arm_right/grip"},
    {"mech_extend_grip_rifle", "mech", "mech_arm_extend", true, "arm_right", "arm_right/grip"},
    {"mech_extend_muzzle", "mech", "mech_arm_extend", true, "arm_right", "object:rifle/muzzle"},
    {"human_torso", "human", "", false, "torso", "torso/chest"},
    {"human_head", "human", "", false, "head", "head/face"},
    {"quadruped_head", "quadruped", "", false, "head", "head/face"},
    {"quadruped_tail", "quadruped", "", false, "tail", "tail/tip"},
    {"quadruped_trunk", "quadruped", "", false, "trunk", "trunk/chest"},
};

inline CharacterChoice aim_choice(const AimSceneRow& row) {
  CharacterChoice choice;
  choice.name = row.character;
  if (*row.arm != '\0') choice.parts["arm_right"] = row.arm;
  const std::string socket = row.character == std::string("human") ? "hand_right" : "arm_right";
  if (row.rifle) choice.attachments.push_back({"rifle", socket, "grip"});
  return choice;
}

// A scene without joints where something is wrong with its row.
inline AimScene aim_scene(const AimSceneRow& row) {
  Result<Character> character = build_character(aim_choice(row), stock_library());
  if (!character) return {row.name + (": " + to_line(character.issue())), {}, {}};
  AimScene scene{row.name, std::move(character).value(), {}};
  const int part = scene.character.find_part(row.slot);
  const int socket = scene.character.find_socket(row.socket);
  if (part >= 0 && socket >= 0) scene.chain = aim_chain_for(scene.character, part, socket);
  return scene;
}

inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
}

// Anywhere within the joint's range.
inline void draw_joint(const Joint& joint, std::mt19937_64& random, double* q) {
  if (joint.kind != JointKind::ball) {
    q[0] = uniform(random, joint.low, joint.high);
    return;
  }
  SwingTwist at;
  do {
    at = {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, joint.low, joint.high)};
  } while (at.a_rad * at.a_rad + at.b_rad * at.b_rad > 1.0);
  at.a_rad *= joint.swing_a_rad;
  at.b_rad *= joint.swing_b_rad;
  set_swing_twist(joint, at, q);
  clamp_to_range(joint, q);
}

inline std::vector<double> draw_posture(const AimGeometry& geometry, std::mt19937_64& random) {
  std::vector<double> coords(static_cast<std::size_t>(geometry.coord_count), 0.0);
  for (const Joint& joint : geometry.joints)
    if (joint.kind != JointKind::prismatic) draw_joint(joint, random, coords.data() + joint.coord);
  return coords;
}

// Aims that postures in range have: where the socket is and faces, in the chain's base. Drawn so that the directions
// are uniform over all cells that any of 100,000 random postures faces, the rim of the reachable cone included.
inline std::vector<Rigid> reachable_aims(const AimGeometry& geometry, int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<Rigid>> cells(kAimCells);
  for (int i = 0; i < 100000; ++i) {
    const Rigid at = base_from_socket(geometry, draw_posture(geometry, random));
    cells[static_cast<std::size_t>(aim_cell(at.q * Vec3(0, 0, 1)))].push_back(at);
  }
  std::erase_if(cells, [](const std::vector<Rigid>& cell) { return cell.empty(); });
  std::vector<Rigid> aims;
  for (int i = 0; i < count; ++i) {
    const std::vector<Rigid>& cell = cells[random() % cells.size()];
    aims.push_back(cell[random() % cell.size()]);
  }
  return aims;
}

// The character at rest, upright.
struct AimPose {
  explicit AimPose(const Character& character)
      : row(character.rest_coords().begin(), character.rest_coords().end()), world(character.joints().size()) {
    forward_kinematics(character, character.rest_root(), row, world);
  }
  std::vector<double> row;
  std::vector<Rigid> world;
};

inline const Rigid& world_from_base(const AimScene& scene, const AimPose& pose) {
  const Joint& first = scene.character.joints()[static_cast<std::size_t>(scene.chain.joints.front())];
  return pose.world[static_cast<std::size_t>(first.parent)];
}

}  // namespace contort::fixtures
