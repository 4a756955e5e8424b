// The ground's side of dynamics: the net force that it must supply, where that acts (zero moment point, ZMP), whether
// standing soles can supply it, and how they share it.
//
// Soles that stand can only push. A figure tips about an edge of the convex hull of their corners, seen from above,
// when the moment of the ground's force about that edge changes its sign. For level ground that is the ZMP leaving the
// support polygon (M. Vukobratovic and B. Borovac, "Zero-Moment Point - thirty-five years of its life", 2004); as a
// moment about a line in space it holds for soles at different heights and tilts as well, and it is linear in the
// accelerations, without any division.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/feet.h"
#include "generator/dynamics/figure.h"

namespace contort {

// The wrench that the ground must supply: a force, and its moment about the root's origin (world axes). `forces` are
// the generalised ones of inverse dynamics.
SpatialForce ground_force(const DynamicsScratch& dynamics, std::span<const double> forces);

struct SupportEdge {
  Vec3 from_m{0.0};
  Vec3 along{0.0};  // its horizontal part has length 1
  // Moment about the edge: row . the six root entries of generalised forces, N m; > 0 inside. Divided by the vertical
  // force it is the ZMP's distance from the edge, m.
  std::array<double, kRootDofs> row{};
};

struct SupportArea {
  std::vector<SupportEdge> edges;  // counter-clockwise seen from above
  std::vector<Vec3> corners_m;     // memory
  std::vector<int> order;          // memory
};

// The support area of the bearing soles, at the placed pose. If only one bears, the area is limited by the strength of
// its ankle for this force; 0 ignores strength.
void find_support_area(const DynamicFigure& figure, const Feet& feet, double alone_N, const DynamicsScratch& dynamics,
                       SupportArea& area);

struct Balance {
  Vec3 zmp_m{0.0};        // on the horizontal plane through the corners' mean
  // Distance of the ZMP inside the area, < 0 outside; -infinity if the ground would have to pull.
  double margin_m = 0.0;
};

// The balance of a figure with this ground force. A vertical force below a fifth of the weight counts as pulling.
Balance balance_of(const SupportArea& area, const DynamicsScratch& dynamics, std::span<const double> forces,
                   double weight_N);

// The largest fraction in [0, 1] of the way from the forces of holding still to these forces at which the ZMP keeps a
// margin. Edges beyond which even holding still would tip are ignored, because nothing can be gained there.
double balanced_share(const SupportArea& area, std::span<const double> hold, std::span<const double> forces,
                      double margin_m);

// Divides a ground force among soles: minimises the sum of squared forces and of squared moments about the middles of
// the bearing areas; moments weigh a hundred times more, and still more about the weak axis of the ankle. Efforts of
// joints above the legs do not depend on the division.
class GroundShare {
 public:
  // `firmness` is given by sole of the figure; the cost of a sole's forces is divided by it.
  void prepare(const DynamicFigure& figure, const Feet& feet, std::span<const double> firmness,
               const DynamicsScratch& dynamics);

  // Fits the division to these forces: soles that bear less than an even share give less moment, in proportion, and as
  // far as the whole support area allows, each sole pushes with a force that acts inside its own bearing area and that
  // its ankle is strong enough for. Each pass divides again with other weights (iteratively reweighted least squares).
  void follow_load(const DynamicsScratch& dynamics, std::span<const double> forces);

  // Joint efforts for generalised forces: these forces minus those that the soles transmit; 0 for the root.
  void efforts(const DynamicsScratch& dynamics, std::span<const double> forces, std::span<double> out) const;
  // The same for one degree of freedom. The multipliers of these forces are cached for further calls.
  double effort(const DynamicsScratch& dynamics, std::span<const double> forces, int dof) const {
    return effort(dynamics, forces, multipliers(dynamics, forces), dof);
  }
  double effort(const DynamicsScratch& dynamics, std::span<const double> forces, const SpatialForce& multipliers,
                int dof) const;
  SpatialForce multipliers(const DynamicsScratch& dynamics, std::span<const double> forces) const;

  // One sole's share of a net force, about the root's origin; `standing` is an index as in prepare.
  SpatialForce share(std::size_t standing, const SpatialForce& net) const {
    return share_of(standing, multipliers(net));
  }

 private:
  struct Foot {
    const Sole* sole = nullptr;
    Vec3 center_m{0.0};  // of its bearing area, from the root's origin
    Vec3 middle_m{0.0};  // the same in the sole's frame
    Vec3 half_m{0.0};    // half of that area's extent, in the sole's axes
    Mat3 axes{1.0};      // the sole's, in the world
    double own_firmness = 1.0;
    Vec3 own_ease{0.0};     // with which it gives moments about its axes
    double firmness = 1.0;  // and ease for the present forces
    Vec3 ease{0.0};
    Mat3 moment_ease{0.0};  // the ease in the world's axes
  };
  void begin();
  static Vec3 moment_ease(const Sole& sole);
  std::pair<Vec3, Vec3> area_of(const Sole& sole, const Bearing& bearing);
  static std::pair<Vec3, Vec3> room_of(const Foot& foot, double force_N);
  bool press_inside(const SpatialForce& net);
  void factorise();
  SpatialForce multipliers(const SpatialForce& net) const;
  SpatialForce share_of(std::size_t standing, const SpatialForce& multipliers) const;
  std::vector<Foot> feet_;
  std::vector<Vec3> points_m_;  // scratch
  int dof_count_ = 0;
  std::vector<char> moves_;  // feet x degrees of freedom: true if it moves the sole
  std::array<double, 36> factors_{};
};

}  // namespace contort
