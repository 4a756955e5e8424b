// Random characters: a base and a limb of up to fourteen joints of all kinds.
#pragma once

#include <random>
#include <string>

#include "model/character/library.h"
#include "tests/character/stock.h"
#include "tests/dynamics/states.h"

namespace contort::fixtures {

inline JointDesc random_joint(int index, std::mt19937_64& random) {
  JointDesc joint;
  joint.name = "j" + std::to_string(index);
  if (index > 0 && between(random, 0, 1) < 0.9)
    joint.parent = "j" + std::to_string(random() % static_cast<unsigned>(index));
  const double kind = between(random, 0, 1);
  joint.type = kind < 0.5 ? JointType::hinge : kind < 0.75 ? JointType::ball : JointType::prismatic;
  joint.axis = unit_or(any_vec(random, 1.0), Vec3(0, 1, 0));
  if (joint.type == JointType::ball) joint.swing_axis = perpendicular(joint.axis);
  if (joint.type == JointType::prismatic) joint.low_m = -0.2, joint.high_m = 0.2;
  joint.position_m = any_vec(random, 0.4), joint.rotation_deg = any_vec(random, 90.0);
  joint.mass_kg = between(random, 0.3, 5.0), joint.center_of_mass_m = any_vec(random, 0.2);
  // Two moments can never be less than the third.
  const double x = between(random, 0.01, 0.1), y = between(random, 0.01, 0.1), z = between(random, 0.01, 0.1);
  joint.inertia_kg_m2 = {y + z, x + z, x + y};
  return joint;
}

inline Character random_tree(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Library library;
  PartDesc base;
  base.name = "base", base.kind = "base";
  base.fixed_mass_kg = 4.0, base.fixed_inertia_kg_m2 = Vec3(0.05, 0.06, 0.07);
  base.fixed_center_of_mass_m = any_vec(random, 0.1);
  base.sockets = {{"dock", "", any_vec(random, 0.3), any_vec(random, 60.0)}};
  PartDesc limb;
  limb.name = "limb", limb.kind = "limb";
  const int count = 1 + static_cast<int>(random() % 14);
  for (int i = 0; i < count; ++i) limb.joints.push_back(random_joint(i, random));
  library.parts = {{"base", base}, {"limb", limb}};
  CharacterDesc desc;
  desc.name = "tree";
  desc.slots = {{"base", "base", Side::center, "", "", {"base"}},
                {"limb", "limb", Side::right, "base", "dock", {"limb"}}};
  library.characters["tree"] = desc;
  return fixtures::built({"tree", {}, {}}, library);
}

}  // namespace contort::fixtures
