// The way back to standing for a target that its legs or the ground cannot bear, such as a leg that is held out too far
// or a trunk that leans back in a crouch. Lifts of feet that are no steps become smaller, each as a whole, so that the
// foot moves nearer to the ground between the places where it leaves and lands. If all soles bear and the figure stays
// in place, the root turns upright and rises, and joints between it and the legs straighten.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/dynamics/foot_lifts.h"

namespace contort {

class Retreat {
 public:
  // All arguments except for the motion must outlive this object.
  Retreat(const Character& character, const ContactPlan& plan, std::span<const Leg> legs, const Motion& motion);

  // Goes a part of the way in all lifts and stretches of standing that contain, or are near, one of these frames
  // (`impossible`, by frame). Changes the root; lifted feet follow from sole(). Returns false if no way is left.
  bool go(std::span<const char> impossible, Motion& motion);

  // The sole of a frame, as planned or nearer to the ground.
  Rigid sole(int frame, int sole) const;

  // Bit i: sole i is in a lift that may still become smaller.
  std::uint8_t lifted(int frame) const;

 private:
  struct Lift {
    FootLift of;
    double size = 1.0;  // fraction of the planned height
  };
  bool is_begun_step(const FootLift& lift) const;
  bool lower(std::span<const char> impossible);
  bool stand_up(std::span<const char> impossible, Motion& motion) const;
  void stand_up(int frame, double share, Motion& motion) const;
  bool all_bear(int frame) const;
  double ground_m(int frame) const;

  const Character& character_;
  const ContactPlan& plan_;
  std::span<const Leg> legs_;
  int reach_ = 1;             // number of frames that count as near
  std::vector<int> carriers_;  // joints between the root and the legs
  std::vector<char> stays_;   // by frame: true if the figure does not travel
  std::vector<Lift> lifts_;
};

}  // namespace contort
