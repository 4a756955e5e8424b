// Hinges of standing legs at the ends of their ranges. All joints of such a leg follow its foot and the hips, so a
// hinge cannot be stopped by itself: its end pushes, the soles stay, and everything else answers by its mass. A leg that
// has more joints than its foot needs bends elsewhere then.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/equation_of_motion.h"
#include "generator/dynamics/impact.h"

namespace contort {

class LegStops {
 public:
  // Hinges at an end after the last tick.
  std::span<const DofEnd> at_ends() const { return at_ends_; }
  void clear() { at_ends_.clear(); }

  // Finds the hinges that standing feet hold (`held`, by degree of freedom), and how far they may go: to the end of
  // their range, or to their angle in the target (by coordinate) if that is farther out.
  void find_hinges(const Character& character, const Multibody& body, std::span<const char> held,
                   std::span<const double> target);

  // Bounds the velocities of these hinges so that none goes farther in this tick. A hinge is left alone if the ground
  // would have to pull at the soles: `up_N` is the force with which it carries the figure. Needs the rows of the soles,
  // and find_mass at the placed pose.
  void stop(const SupportRows& support, int sole_count, double up_N, double tick_s, EquationOfMotion& equation);

 private:
  struct Hinge {
    int dof = 0;
    int coord = 0;
    double low = 0.0;
    double high = 0.0;
  };
  void push(int dof, double missing, const SupportRows& support, int sole_count, double up_N_s,
            EquationOfMotion& equation);

  std::vector<Hinge> hinges_;
  std::vector<DofEnd> at_ends_;
  std::vector<double> still_;   // by row of the support: soles keep their velocities
  std::vector<double> change_;  // by degree of freedom
  ResponseScratch response_;
  bool has_factors_ = false;  // in this tick
};

}  // namespace contort
