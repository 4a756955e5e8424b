// Measures signed distances of the judged pairs of bodies in one frame after another, each as exactly as the caller
// needs it.
//
// A pair's distance is the smallest over its colliders. Pairs that are far apart are dismissed by bounding spheres,
// first of bodies and then of colliders. The remaining spheres and capsules are measured together
// (round_distances.h), then boxes and hulls. Most of those are dismissed by the direction that separated them when
// they were last measured.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "model/character/character.h"
#include "model/geometry/distance.h"

namespace contort {

// A judged pair that is to be measured.
struct DuePair {
  std::size_t judged = 0;
  double matters_m = 0.0;  // the distance must be exact if it is below this
  double reach_m = 0.0;    // >= matters_m; a pair that is farther apart need not be measured
};

class Clearances {
 public:
  explicit Clearances(const Character& character);

  // Begins the next frame. `world` holds world_from_joint and must stay in place.
  void place(std::span<const Rigid> world);

  // A lower bound on a pair's distance in this frame: the gap between its bodies along the direction of their last
  // measurement (distance.h). NaN if they were never measured.
  double gap_m(std::size_t judged) const;

  // Measures the pairs that are due in this frame.
  void measure(std::span<const DuePair> due);
  // The distance of a measured pair, if it is below what matters; otherwise a value between what matters and the
  // distance. NaN if a transform of a body is not finite.
  double distance_m(const DuePair& due);

 private:
  struct Ball {
    Vec3 center_m{0.0};
    double radius_m = 0.0;
  };
  struct Pair {
    std::size_t body_a, body_b;
    double radii_m;                                   // sum of the radii of their bounding spheres
    std::size_t first_round, first_other, end_other;  // indices into colliders_: pairs of spheres and capsules, then
                                                      // pairs with a box or a hull
    // The state of the last measurement:
    bool is_near = false;
    double apart_m = 0.0;                                // distance of its bounding spheres, or the reach
    std::size_t first_measured = 0, end_measured = 0;    // indices into round_m_
    Vec3 way{std::numeric_limits<double>::quiet_NaN()};  // the direction out of a for b, in a's frame
    double way_extent_m = 0.0;                           // extent of a along this direction
  };

  Pair parted(const JudgedPair& pair);
  Ball ball_of(const Body& body) const;
  const Rigid& place_of(std::size_t body) const;
  Vec3 ball_center(std::size_t body) const { return place_of(body) * own_balls_[body].center_m; }
  void place_body(std::size_t body);
  bool are_apart(const ColliderPair& pair, double enough_m) const;
  void gather_round(Pair& pair, double reach_m);
  double extent_of(std::size_t body, const Vec3& n) const;
  void set_way(Pair& pair, const Vec3& way);
  void set_way_of_round(Pair& pair, const ColliderPair& nearest);
  double distance_of_other(std::size_t i, const Pair& pair, double enough_m, double band_m);

  const Character& character_;
  std::vector<ColliderPair> colliders_;  // pair after pair, in the character's order, but pairs of round colliders
                                         // first
  std::vector<Vec3> ways_;               // for colliders_ that were measured alone: the way out, in the frame of a's
                                         // body
  std::vector<Pair> pairs_;              // in the order of judged_pairs()
  std::vector<Solid> own_;               // colliders in their joints' frames
  std::vector<Ball> own_balls_;          // bounding spheres of bodies
  std::span<const Rigid> placed_at_;
  std::vector<Solid> world_;  // colliders of the bodies that were needed in this frame
  std::vector<char> placed_;
  std::vector<ColliderPair> round_;  // round pairs that are near in this frame
  std::vector<double> round_m_;      // their signed distances
};

}  // namespace contort
