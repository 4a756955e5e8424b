// The way of each joint through a motion: joints go after the postures that actions want, within the speeds that their
// descriptions allow, and gather and lose speed in a tenth of a second. A posture that can be had at once is passed on as
// it is, bit by bit.
#pragma once

#include <span>
#include <vector>

#include "model/character/character.h"

namespace contort {

// Frames come in order; each part is followed, passed or cut in each frame, with the part's own coordinates in a row of
// the character's. Memory is reused.
class JointPath {
 public:
  // Every joint is at rest. The character must outlive this object.
  void begin(const Character& character, std::span<const double> coords, double rate_hz);

  // `coords` hold the wanted posture, and then the one that the joints get to in this frame. True if one of them is
  // still on its way.
  bool follow(std::size_t part, std::span<double> coords);

  // The part is where it is wanted, and goes on at that speed, or the greatest allowed.
  void pass(std::size_t part, std::span<const double> coords);

  // After follow(): the part went elsewhere, as these coordinates say, and is behind.
  void correct(std::size_t part, std::span<const double> coords);
  // The same for a part that was shown elsewhere in the frame before, too: its joints have the speeds that were seen.
  void correct(std::size_t part, std::span<const double> shown_before, std::span<const double> coords);

  // The part is where it is wanted, and at rest: no way led there.
  void cut(std::size_t part, std::span<const double> coords);

 private:
  // The state of one joint. Speeds are per frame, rad or m, as rotation vectors in the joint's own frame; x of a hinge
  // or travel.
  struct State {
    Vec3 speed{0.0};
    bool is_behind = false;
  };

  bool rests(int j, double wanted) const;
  bool follow_joint(int j, double* coords);
  void put(std::size_t part, std::span<const double> coords);

  const Character* character_ = nullptr;
  double frame_s_ = 0.0;
  std::vector<double> now_;     // coordinates, in the frame before
  std::vector<double> wanted_;  // in the frame before
  std::vector<State> joints_;
};

}  // namespace contort
