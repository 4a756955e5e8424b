// Rigid bodies without control: accelerations under given forces, and velocities after an impact, with soles that hold
// on to the ground. Both are M x + J^T lambda = right, J x = wanted.
#pragma once

#include <span>
#include <vector>

#include "generator/dynamics/figure.h"
#include "generator/dynamics/support.h"

namespace contort {

struct ResponseScratch {
  std::vector<double> rows;     // J
  std::vector<double> columns;  // M^-1 J^T, a row for each of J's
  std::vector<double> matrix;   // J M^-1 J^T
  // Lambda: forces or impulses of the ground, six for each foot (linear at the sole, then angular).
  std::vector<double> push;
};

// x = M^-1 (x + J^T lambda) with J x = wanted; `factors` of M. Without rows x = M^-1 x.
void respond(const Multibody& body, std::span<const double> factors, const SupportRows& support,
             std::span<const double> wanted, ResponseScratch& scratch, std::span<double> x);

// An instantaneous impulse on a point of a link.
struct Impact {
  int frame = 0;
  int link = 0;
  Vec3 point_m{0.0};      // in the link's frame
  Vec3 impulse_N_s{0.0};  // in the world
};

// Adds an impact as a generalised impulse, at the placed pose.
void add_impulse(const Multibody& body, const DynamicsScratch& dynamics, const Impact& impact,
                 std::span<double> impulse);

// Moves a change of velocity towards that of a stiff figure, as far as a joint would exceed its greatest speed
// (`fastest` by degree of freedom; the root's is ignored): people brace. Both changes keep the momentum of the impact,
// and so do all between them.
void brace(std::span<const double> velocity, std::span<const double> stiff, std::span<const double> fastest,
           std::span<double> change);

}  // namespace contort
