// What two bodies do between two frames, where joints turn and travel evenly from the one to the other. docs/checks.md
// has the formula behind it.
#pragma once

#include <span>
#include <vector>

#include "checks/distance.h"

namespace contort {

class BetweenFrames {
 public:
  explicit BetweenFrames(const Character& character);

  struct Frame {
    std::span<const double> coords;
    std::span<const Rigid> world;  // world_from_joint
  };
  // What the frames point to has to stay where it is.
  void set(const Frame& before, const Frame& now);

  // Whether the pair may overlap by over a millimetre more in between than in both frames, going by its travels alone.
  // The frames' distances may be given too small, not too large.
  bool may_overlap(const JudgedPair& pair, double before_m, double now_m) const;

  // The least distance in between, where the pair overlaps there by over a millimetre more than in both frames;
  // otherwise that of the frames.
  double least_distance(const JudgedPair& pair, double before_m, double now_m);

 private:
  struct Link {
    int joint;
    double reach_m;  // from its origin to the farthest point of the body that it moves, but for travels in between
  };
  // How the points of a body move against a joint that carries it, all between two frames.
  struct Travel {
    double path_m = 0.0;   // no longer
    double curve_m = 0.0;  // second derivative, no greater
  };
  struct Places {  // of two bodies, as seen from the joint that carries both
    Rigid a, b;
  };
  struct Moment {
    double time;  // 0 to 1
    Solid a, b;   // as seen from the joint that carries both
    double distance_m;
  };
  struct Search {
    JudgedPair pair;
    int trunk;  // the joint that carries both
    Travel a, b;
    Places before, now;
    double least_m;            // that was found so far
    ColliderPair colliders{};  // that are looked at
    void measure(Moment& moment) const;
    double enough_m() const;
    double sag_m(const Moment& from, const Moment& to) const;
    bool is_proved_by(const Vec3& n, const Moment& from, const Moment& to) const;
    bool is_proved(const Moment& from, const Moment& to) const;
    double path_m() const { return a.path_m + b.path_m; }
  };

  void add_links(const Body& body);
  double step_of(const Joint& joint) const;
  Travel travel_below(int trunk, int body) const;
  int trunk_of(int body_a, int body_b) const;
  Rigid trunk_from(int trunk, int joint, double time) const;
  Places places(const Search& search, const Frame& frame) const;
  Moment moment(const Search& search, double time, const Places& places) const;
  void search_colliders(Search& search, Vec3& direction) const;
  bool may_overlap(const Search& search) const;
  void halve(Search& search, const Moment& from, const Moment& to, int level) const;

  const Character& character_;
  std::vector<Solid> own_;                // of colliders, in their joints' frames
  std::vector<std::vector<Link>> links_;  // of bodies, from the body's joint down to the root's first
  Frame before_, now_;
  std::vector<double> steps_;  // of joints, between the frames: rad or m
  double farthest_out_m_ = 0.0;
  std::vector<Vec3> directions_;  // of judged colliders, as seen from a's body: what parted b from a when last measured
  std::vector<double> travels_m_;  // of bodies: no point of it moves farther against the root
};

}  // namespace contort
