// Key poses of an action file: each joint moves from its posture at the action's start through the keys that name it.
#pragma once

#include <vector>

#include "model/character/character.h"

namespace contort {

struct ActionDef;

// The keys of one part, in its coordinates.
struct KeyPlan {
  struct Node {
    double at = 1.0;  // fraction of the period
    KeyEase ease = KeyEase::smooth;
    double value = 0.0;          // hinge: rad, prismatic: m
    Quat turn = kNoRotation;     // ball
  };
  struct Path {
    int joint = 0;
    std::vector<Node> nodes;  // in the order of `at`
  };
  std::vector<Path> paths;
};

// The rule of all key poses: a course on the overwrite layer that moves one part and has no parameters.
const ActionDef& key_pose_def();

// Only for a part that can perform the action (find_action).
KeyPlan plan_keys(const ActionDesc& action, const Character& character, const Part& part);

}  // namespace contort
