// The contacts of a figure's soles with the ground: which stand, how firmly, and what they ask of accelerations.
#pragma once

#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/feet.h"

namespace contort {

// Follows a plan, in which bit i of a frame says whether sole i stands. Soles are numbered as the figure's.
class FootContacts {
 public:
  // No sole stands at first. The figure and the environment must outlive it.
  void begin(const DynamicFigure& figure, const Environment& environment, std::vector<std::uint8_t> plan,
             double rate_hz);

  // The plan's frame from now on.
  void begin_frame(int frame);

  std::uint8_t planned(int frame) const { return plan_[static_cast<std::size_t>(frame)]; }
  bool has_soles() const { return !figure_->soles.empty(); }

  // Lifts and lands soles as the plan says; one that still is 3 cm or more above the ground lands later, unless it must
  // land at once. Answers whether any sole came or went. Needs a placed pose.
  bool follow_plan(const DynamicsScratch& dynamics, bool at_once);

  // Lands the planned soles that lie flat and still; answers whether any sole stands. Needs find_bias.
  bool land_flat(const DynamicsScratch& dynamics);

  void release() { feet_.clear(); }

  // Finds what standing soles ask, with the equation's bias.
  void find_rows(EquationOfMotion& equation);
  // With the rows: the nearest accelerations that keep the soles, and the nearest velocities that do not move them.
  void keep(std::span<double> acceleration) { project_on_support(ease_, support_, acceleration); }
  void stop(std::span<double> velocity) { stop_feet(ease_, support_, velocity); }

  const Feet& feet() const { return feet_; }
  SupportRows& support() { return support_; }
  std::span<const double> firmness() const { return firmness_; }  // by sole, squared: soften in feet.h

 private:
  bool is_planned(int sole) const { return (planned(frame_) >> sole & 1) != 0; }
  int sole_count() const { return static_cast<int>(figure_->soles.size()); }
  const Sole& sole(int index) const { return figure_->soles[static_cast<std::size_t>(index)]; }
  void land(int index, const DynamicsScratch& dynamics);

  const DynamicFigure* figure_ = nullptr;
  const Environment* environment_ = nullptr;
  std::vector<std::uint8_t> plan_;
  double rate_hz_ = 60.0;
  int frame_ = 0;
  Feet feet_;
  SupportRows support_;
  std::vector<double> firmness_;
  std::vector<double> ease_;  // by freedom: how easily it gives way (support.h)
};

}  // namespace contort
