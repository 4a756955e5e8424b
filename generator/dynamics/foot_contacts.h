// The contacts of a figure's soles with the ground: the guided paths of soles, the corners on which they bear, and the
// resulting conditions on accelerations.
#pragma once

#include "generator/dynamics/contact_plan.h"
#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/feet.h"
#include "generator/dynamics/impact.h"

namespace contort {

// Guides soles along a plan: all of them or, after release, none.
class FootContacts {
 public:
  // No sole is guided at first. The figure, the environment and the plan must outlive it.
  void begin(const DynamicFigure& figure, const Environment& environment, const ContactPlan& plan, double rate_hz,
             double tick_s);

  // Sets the present frame of the plan.
  void begin_frame(int frame);

  std::uint8_t planned(int frame) const { return stances_[static_cast<std::size_t>(frame)]; }
  bool has_soles() const { return !figure_->soles.empty(); }
  int sole_count() const { return static_cast<int>(figure_->soles.size()); }
  bool is_led() const { return is_led_; }
  // Returns true if all soles stand flat in the plan, now and for a quarter of a second. Then the legs determine the
  // root; otherwise the root and the soles determine the legs.
  bool is_planted() const { return planted_[static_cast<std::size_t>(frame_)] != 0; }

  // Guides all soles from here on, along the plan's paths. Needs a placed pose.
  void lead_all() { is_led_ = has_soles(); }
  // Sets the guided places of the soles at a time in frames, and the corners on which they bear. Corners that are still
  // above the ground bear later. Needs a placed pose.
  void follow_plan(double frame, const DynamicsScratch& dynamics);

  // Guides the soles again, beginning with planned ones that lie flat and still, from their present places. Returns
  // true if there is any. Needs find_bias.
  bool land_flat(double frame, const DynamicsScratch& dynamics);

  void release();

  // The mean horizontal distance of standing soles from the plan's places, m.
  Vec3 shift_m() const;

  // Finds the conditions of guided soles, with the equation's bias. `tracked`: the accelerations that joints want. Of
  // the hinges that stopped at an end, those that would go on outward stay there.
  void find_rows(EquationOfMotion& equation, std::span<const double> tracked, std::span<const DofEnd> ends = {});
  // The sole in the air whose leg has this degree of freedom; -1 for others.
  int swinging(int dof) const;
  void ask_less(int sole, double share, std::span<const double> acceleration);
  // Moves accelerations to the nearest ones that guide the soles. Needs the rows.
  void keep(std::span<double> acceleration) { project_on_support(ease_, support_, acceleration); }
  // Stops all soles by impulses of the ground. Needs the rows, find_mass and find_factors.
  void stop(EquationOfMotion& equation);

  const Feet& feet() const { return feet_; }
  SupportRows& support() { return support_; }
  std::span<const double> ease() const { return ease_; }
  // Is true, by degree of freedom, for those of guided legs.
  std::span<const char> led_by_dof() const { return led_by_dof_; }
  std::span<const double> firmness() const { return firmness_; }    // by sole, squared: firmness in feet.h

 private:
  bool is_planned(int sole) const { return (planned(frame_) >> sole & 1) != 0; }
  const Sole& sole(int index) const { return figure_->soles[static_cast<std::size_t>(index)]; }
  void find_rows_with(const EquationOfMotion& equation, std::span<const int> still_dofs);
  void find_planted();
  Bearing bearing(int index, const DynamicsScratch& dynamics) const;
  LedSole led_at(int index, double frame) const;

  const DynamicFigure* figure_ = nullptr;
  const Environment* environment_ = nullptr;
  const ContactPlan* plan_ = nullptr;
  double rate_hz_ = 60.0;
  double tick_s_ = 1.0 / 120.0;
  int frame_ = 0;
  bool is_led_ = false;
  Feet feet_;
  std::vector<std::uint8_t> stances_;  // by frame
  std::vector<char> planted_;          // by frame
  std::vector<Rigid> offsets_;         // by sole: transform from the plan's places to those of this figure
  std::vector<LedSole> led_;
  std::vector<double> passive_, moved_;  // scratch of ask_less
  std::vector<double> middle_;           // velocities of the present, for find_rows
  std::vector<double> probe_;            // scratch of find_rows
  std::vector<int> still_;               // degrees of freedom that are not accelerated
  SupportRows support_;
  ResponseScratch response_;
  std::vector<double> change_;  // scratch of stop
  std::vector<double> firmness_;
  std::vector<double> ease_;  // by degree of freedom: how easily it gives way (support.h)
  std::vector<char> led_by_dof_;
};

}  // namespace contort
