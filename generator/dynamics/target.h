// A target motion as a function of time, also between its frames, for tracking control. Poses pass through those of the
// frames; rates are the poses' own derivatives, continuous over the frames.
#pragma once

#include <vector>

#include "generator/dynamics/multibody.h"
#include "generator/dynamics/tracking.h"
#include "model/motion/motion.h"

namespace contort {

class TargetMotion {
 public:
  // Keeps no reference to the motion, which must have at least one frame.
  TargetMotion(const Multibody& body, const Motion& motion);

  double rate_hz() const { return rate_hz_; }
  int last_frame() const { return frame_count_ - 1; }

  // A joint's coordinates and rates (rad/s, m/s; for a ball along the axes of its body) at a time in frames. Before the
  // first frame and after the last it stands still.
  void joint_at(const Link& link, double frame, double* coords, double* rates) const;

  // The root, with its generalised velocity: linear along world axes, then angular along its own axes.
  void root_at(double frame, Rigid& world_from_root, double* velocity) const;

  // The accelerations of a joint's rates, interpolated between those of the frames, which come from neighbouring
  // frames.
  void joint_acceleration_at(const Link& link, double frame, double* acceleration) const;

  // The root's generalised acceleration at a time in frames, interpolated in the same way.
  void root_acceleration_at(double frame, double* acceleration) const;

  // The root's position along an axis, and its rotation, as links for the functions above.
  Link root_travel(int axis) const;
  Link root_turn() const;

  // The frames to which control of a link steers (tracking.h). For a ball, those of the components of its rotation
  // relative to rest.
  const std::vector<int>& knots(int link) const { return knots_[static_cast<std::size_t>(link)]; }

  // Gives all these links the knots of all of them: legs that stand on the ground form one chain.
  void share_knots(const std::vector<int>& links);

 private:
  struct Between {
    int frame = 0;  // the previous frame
    int next = 0;
    double share = 0.0;  // fraction of the way to the next frame, [0, 1)
    double per_s = 0.0;  // frames per second; 0 if it stands still
  };
  Between between(double frame) const;
  const double* row(int frame) const { return &coords_[static_cast<std::size_t>(frame * coord_count_)]; }
  int inward(int frame) const;
  double slope(int frame, int coord) const;
  void root_bend(int frame, double* bends) const;
  double bend(int frame, int coord) const;
  Vec3 turn_bend(int frame, int coord) const;
  Vec3 turn_slope(int frame, int coord) const;
  std::vector<int> knots_of(const Link& link) const;
  void ball_at(int coord, const Between& at, double* coords, double* rates) const;

  double rate_hz_ = 60.0;
  int frame_count_ = 0;
  int coord_count_ = 0;  // with seven of the root at the end of a row: position, then rotation
  std::vector<double> coords_;
  std::vector<std::vector<int>> knots_;
};

}  // namespace contort
