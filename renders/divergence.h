// Finds the frames in which two motions visibly differ, joint by joint, in frames of the same number.
#pragma once

#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/core/result.h"
#include "model/motion/motion.h"

namespace contort {

inline constexpr double kSamePlace_m = 0.001;

// The differences of two motions. Joints are compared by name: the position of a joint, and of the points that span its
// colliders, so that a hand that only rotates is found too. Two positions that are not finite count as equal.
struct Divergence {
  struct At {
    int frame = -1;
    std::string joint;     // the joint that is farthest from its place in the other motion
    double apart_m = 0.0;  // greater than the tolerance; NaN if one of the two positions is not finite
  };
  At first, worst;                  // the first and the greatest difference in frames that both have; frame -1: none
  int last_frame = -1;              // the last frame that differs
  int frames = 0;                   // number of frames that both motions have
  int frames_a = 0, frames_b = 0;   // number of frames of each motion
  int joints = 0;                   // number of joints that both characters have
  std::vector<std::string> only_a;  // joints that the other one lacks
  std::vector<std::string> only_b;

  bool same_length() const { return frames_a == frames_b; }
  bool none() const { return first.frame < 0 && same_length() && only_a.empty() && only_b.empty(); }
};

struct Performance {
  const Character& character;
  const Motion& motion;  // a motion of this character
};

// Compares two motions. Positions no farther apart than `tolerance_m` >= 0 are equal. Code compare.other_rate if the
// frame rates differ.
Result<Divergence> find_divergence(const Performance& a, const Performance& b, double tolerance_m);

// Returns one line for people, such as "first difference at frame 37 (0.617 s): arm_left/elbow is 12.3 mm apart; …".
std::string divergence_text(const Divergence& divergence, double tolerance_m, double rate_hz);

// Returns the differences as a JSON object, with null for missing values.
std::string divergence_json(const Divergence& divergence, double tolerance_m, double rate_hz);

}  // namespace contort
