// Finds the smallest distance of two bodies between two frames. Joints are assumed to turn and travel evenly from one
// frame to the next. docs/reference/checks.md has the formulas.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "model/geometry/distance.h"

namespace contort {

class BetweenFrames {
 public:
  explicit BetweenFrames(const Character& character);

  struct Frame {
    std::span<const double> coords;
    std::span<const Rigid> world;  // world_from_joint
  };
  // The data that the frames point to must stay valid and in place.
  void set(const Frame& before, const Frame& now);

  // An upper bound on the path, in metres, of any point of one body as seen from the other body of a judged pair. NaN
  // if it is unknown.
  double path_m(std::size_t judged) const { return paths_m_[chains_[judged].a] + paths_m_[chains_[judged].b]; }

  // Writes path_m() of all judged pairs to `out`.
  void paths_m(std::span<double> out) const;

  // Returns true if the path length alone allows the pair to overlap by more than 1 mm more between the frames than
  // in either frame. The distances in the frames may be given too small, but not too large.
  bool may_overlap(std::size_t judged, double before_m, double now_m) const;

  // The smallest distance between the frames if the pair overlaps there by more than 1 mm more than in both frames;
  // otherwise the smaller distance of the two frames.
  double least_distance(std::size_t judged, double before_m, double now_m);

 private:
  struct Link {
    int joint;
    double reach_m;  // from its origin to the farthest point of the body that it moves, without travels in between
    bool slides;
    double path_m(double farthest_out_m) const { return slides ? 1.0 : reach_m + farthest_out_m; }  // for a step of 1
                                                                                                    // rad or 1 m
  };
  // The chain between a judged pair's bodies: the joint that carries both, and the links below it.
  struct Chains {
    int trunk;
    std::size_t a, b;  // indices into paths_m_: the sums over the links up to the trunk
  };
  // Bounds on the movement of a body's points relative to a joint that carries the body, between the two frames.
  struct Travel {
    double path_m = 0.0;   // upper bound of the path
    double curve_m = 0.0;  // upper bound of the second derivative
  };
  struct Places {  // places of two bodies, in the frame of the joint that carries both
    Rigid a, b;
  };
  // The figure at a moment between the frames; transforms are computed on demand.
  struct Pose {
    int interval = 0;
    double time = 0.0;
    std::vector<Rigid> root_from;  // joints
    std::vector<char> is_known;
  };
  struct Moment {
    double time;  // 0 to 1
    Solid a, b; // in the frame of the joint that carries both
    double distance_m;
    Vec3 way;  // the way_out of signed_distance
  };
  struct Search {
    JudgedPair pair;
    int trunk;  // the joint that carries both
    Travel a, b;
    Places before, now;
    double least_m;            // the least distance that was found so far
    ColliderPair colliders{};  // the colliders that are being examined
    void measure(Moment& moment) const;
    double enough_m() const;
    double sag_m(const Moment& from, const Moment& to) const;
    bool is_near(const Moment& from, const Moment& to) const;
    double path_m() const { return a.path_m + b.path_m; }
  };

  void add_links(const Body& body);
  std::size_t links_below(int trunk, int body) const;
  double step_of(const Joint& joint) const;
  void add_paths();
  Travel travel_below(int trunk, int body) const;
  int trunk_of(int body_a, int body_b) const;
  const Rigid& root_from(Pose& pose, int joint) const;
  Pose& pose_at(double time);
  Places places(const Search& search, const Frame& frame) const;
  Moment moment(const Search& search, double time, const Places& places) const;
  Moment middle_of(const Search& search, const Moment& from, const Moment& to);
  static Vec3 way_out_of_deeper(const Moment& from, const Moment& to);
  bool is_parted_along(const Search& search, const Vec3& n, const Moment& from, const Moment& to, int halvings);
  void search_colliders(Search& search, Vec3& direction);
  bool may_overlap(const Search& search) const;
  void halve(Search& search, const Moment& from, const Moment& to, int level);

  const Character& character_;
  std::vector<Solid> own_;                // the colliders in their joints' frames
  std::vector<Link> links_;               // body after body; each body's links go from its own joint to the joint next
                                          // to the root
  std::vector<std::size_t> first_links_;  // each body's first index into links_, and the end
  std::vector<Chains> chains_;            // for each judged pair
  Frame before_, now_;
  int interval_ = 0;           // counts the intervals
  std::vector<Pose> poses_;    // by moment in the interval
  std::vector<double> steps_;  // each joint's step between the frames, rad or m
  double farthest_out_m_ = 0.0;
  std::vector<Vec3> directions_;  // for each judged pair of colliders, in the frame of a's body: the direction that
                                  // separated b from a at their last measurement
  // For each body in turn: bounds on the path of its points relative to the joint that carries its first 0, 1, 2 …
  // links.
  std::vector<double> paths_m_;
};

}  // namespace contort
