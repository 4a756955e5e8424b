// The path of each joint through a motion. Joints follow the postures that actions want, within the speeds that their
// descriptions allow, and gain and lose speed in a tenth of a second. A posture that can be reached at once is passed
// on unchanged, bit by bit.
#pragma once

#include <span>
#include <vector>

#include "model/character/character.h"

namespace contort {

// Joints that are struck have no limits by accelerations at ease.
enum class Haste { at_ease, struck };

// Frames come in order; each part is followed, passed or cut in each frame, with the part's own coordinates in a row of
// the character's. Memory is reused.
class JointPath {
 public:
  // Begins with every joint at rest. The character must outlive this object. `easy`: the greatest acceleration of each
  // joint, rad/s^2 or m/s^2, in addition to the limit by its greatest speed; or empty.
  void begin(const Character& character, std::span<const double> coords, double rate_hz,
             std::span<const double> easy = {});

  // `coords` has the wanted posture, and afterwards the one that the joints reach in this frame. Returns true if a
  // joint has not arrived yet.
  bool follow(std::size_t part, std::span<double> coords, Haste haste = Haste::at_ease);

  // The part has its wanted posture, and continues at its present speed, up to the greatest allowed one.
  void pass(std::size_t part, std::span<const double> coords);

  // After follow(): the part went elsewhere, to these coordinates, and has not arrived.
  void correct(std::size_t part, std::span<const double> coords);
  // After follow(): the part was elsewhere in the previous frame too, so its joints have the observed speeds.
  void correct(std::size_t part, std::span<const double> shown_before, std::span<const double> coords);

  // The part jumps to its wanted posture, and is at rest there.
  void cut(std::size_t part, std::span<const double> coords);

 private:
  // The state of one joint. Speeds are per frame, rad or m, as rotation vectors in the joint's own frame; x of a hinge
  // or travel.
  struct State {
    Vec3 speed{0.0};
    bool is_behind = false;
    bool is_corrected = false;  // it may have more than its comfortable speed
  };

  struct Limits;
  Limits limits_of(int j, bool is_behind) const;
  bool rests(int j, double wanted) const;
  bool follow_joint(int j, double* coords);
  void put(std::size_t part, std::span<const double> coords);

  const Character* character_ = nullptr;
  double frame_s_ = 0.0;
  Haste haste_ = Haste::at_ease;
  std::vector<double> most_change_;  // by joint, per frame; empty: by the greatest speed
  std::vector<double> now_;     // coordinates in the previous frame
  std::vector<double> wanted_;  // wanted coordinates in the previous frame
  std::vector<State> joints_;
};

}  // namespace contort
