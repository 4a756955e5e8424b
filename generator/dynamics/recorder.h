// Records dynamics in a motion, frame by frame: of several ticks it keeps the greatest efforts and the worst balance.
#pragma once

#include <span>

#include "generator/dynamics/ground.h"
#include "generator/dynamics/tracker.h"
#include "model/motion/motion.h"

namespace contort {

class Recorder {
 public:
  // Keeps a reference to the motion. Its poses are the target until frames are overwritten.
  void begin(Motion& motion, int dof_count);

  // Records the frame's pose, and the soles that stand in the target (Stance::planned).
  void begin_frame(int frame, const FigureState& state, std::uint8_t planned);
  void end_frame(std::span<const int> standing);

  void efforts(std::span<const double> efforts);
  void control(std::span<const double> added, double share);  // `share` is the tick's fraction of the frame
  void balance(const Balance& balance);
  void footing(Footing footing);
  void overpowered() { stance().overpowered = true; }
  void impact(const ImpactMark& mark) { motion_->response.impacts.push_back(mark); }

 private:
  Stance& stance() { return motion_->response.stances[static_cast<std::size_t>(frame_)]; }
  std::span<double> row(std::vector<double>& values) const;
  Motion* motion_ = nullptr;
  int frame_ = 0;
  bool balanced_ = false;  // true if this frame has a margin
};

}  // namespace contort
