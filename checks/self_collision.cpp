// self_collision: signed distance of every judged pair of bodies, the least over their colliders. Most bodies are far
// apart in most frames: bounding balls, first of bodies and then of colliders, dismiss those, and only what is within
// the band is measured exactly: spheres and capsules first, all together, then boxes and hulls. Between two frames the
// same is done with how far bodies can have come (between_frames.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/between_frames.h"
#include "checks/check.h"
#include "checks/distance.h"
#include "checks/round_distances.h"

namespace contort {

namespace {

struct Ball {
  Vec3 center_m{0.0};
  double radius_m = 0.0;
};

// NaN is not "apart": it goes on to be measured, and found.
bool apart(const Vec3& a, const Vec3& b, double reach_m) {
  const Vec3 d = a - b;
  return glm::dot(d, d) > reach_m * reach_m;
}

bool is_round(const Solid& solid) { return solid.core == Solid::Core::point || solid.core == Solid::Core::segment; }

class Clearances {
 public:
  Clearances(const Character& character, double band_m)
      : character_(character),
        band_m_(band_m),
        colliders_(character.judged_colliders().begin(), character.judged_colliders().end()) {
    for (const Collider& collider : character.colliders()) own_.push_back(solid_of(collider));
    for (const Body& body : character.bodies()) own_balls_.push_back(ball_of(body));
    for (const JudgedPair& pair : character.judged_pairs()) pairs_.push_back(parted(pair));
    world_ = own_;
    balls_.resize(own_balls_.size());
  }

  Clearances(const Clearances&) = delete;  // pairs_ looks into colliders_

  void place(std::span<const Rigid> joints) {
    const std::span<const Body> bodies = character_.bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Rigid& world_from_body = joints[static_cast<std::size_t>(bodies[b].joint)];
      balls_[b] = world_from_body * own_balls_[b].center_m;
    }
    placed_at_ = joints;
    placed_.assign(bodies.size(), false);
    round_.clear();
    for (Pair& pair : pairs_) gather_round(pair);
    round_m_.resize(round_.size());
    round_distances(world_, round_, round_m_);
  }

  // Least signed distance over the colliders of a judged pair, or infinity where none is within the band.
  double of(std::size_t judged) const {
    const Pair& pair = pairs_[judged];
    double least = band_m_;  // only what is nearer than the nearest so far needs to be exact
    for (std::size_t i = pair.first_measured; i < pair.end_measured; ++i) {
      if (std::isnan(round_m_[i])) return round_m_[i];
      least = std::min(least, round_m_[i]);
    }
    if (pair.near)
      for (const ColliderPair& colliders : pair.others) {
        if (are_apart(colliders, least)) continue;
        const double distance = signed_distance(world_[at(colliders.a)], world_[at(colliders.b)], least);
        if (std::isnan(distance)) return distance;
        least = std::min(least, distance);
      }
    return least < band_m_ ? least : std::numeric_limits<double>::infinity();
  }

 private:
  struct Pair {
    std::size_t body_a, body_b;
    std::span<const ColliderPair> round, others;  // its colliders: spheres and capsules, and those with a box or a hull
    bool near = false;                            // in this frame
    std::size_t first_measured = 0, end_measured = 0;  // of round_m_
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  Pair parted(const JudgedPair& pair) {
    const std::span<ColliderPair> all = std::span(colliders_).subspan(at(pair.first_pair), at(pair.pair_count));
    const auto both_round = [&](const ColliderPair& one) {
      return is_round(own_[at(one.a)]) && is_round(own_[at(one.b)]);
    };
    const auto others = std::stable_partition(all.begin(), all.end(), both_round);
    return {at(pair.body_a), at(pair.body_b), {all.begin(), others}, {others, all.end()}};
  }

  void gather_round(Pair& pair) {
    const double reach = own_balls_[pair.body_a].radius_m + own_balls_[pair.body_b].radius_m + band_m_;
    pair.near = !apart(balls_[pair.body_a], balls_[pair.body_b], reach);
    pair.first_measured = pair.end_measured = round_.size();
    if (!pair.near) return;
    place_body(pair.body_a);
    place_body(pair.body_b);
    for (const ColliderPair& colliders : pair.round)
      if (!are_apart(colliders, band_m_)) round_.push_back(colliders);
    pair.end_measured = round_.size();
  }

  Ball ball_of(const Body& body) const {
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c) {
      const Solid& solid = own_[at(c)];
      low = glm::min(low, solid.center_m - Vec3(solid.bound_m));
      high = glm::max(high, solid.center_m + Vec3(solid.bound_m));
    }
    Ball ball{0.5 * (low + high), 0.0};
    for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c) {
      const Solid& solid = own_[at(c)];
      const Vec3 d = solid.center_m - ball.center_m;
      ball.radius_m = std::max(ball.radius_m, std::sqrt(glm::dot(d, d)) + solid.bound_m);
    }
    return ball;
  }

  void place_body(std::size_t b) {
    if (placed_[b]) return;
    placed_[b] = true;
    const Body& body = character_.bodies()[b];
    for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c)
      contort::place(placed_at_[static_cast<std::size_t>(body.joint)], own_[at(c)], world_[at(c)]);
  }

  bool are_apart(const ColliderPair& pair, double enough_m) const {
    const Solid& a = world_[at(pair.a)];
    const Solid& b = world_[at(pair.b)];
    const double reach = a.bound_m + b.bound_m + enough_m;
    return reach <= 0.0 || apart(a.center_m, b.center_m, reach);  // no overlap is deeper than that of the balls
  }

  const Character& character_;
  double band_m_;
  std::vector<ColliderPair> colliders_;
  std::vector<Pair> pairs_;      // as judged_pairs()
  std::vector<Solid> own_;       // in their joints' frames
  std::vector<Ball> own_balls_;  // of bodies
  std::span<const Rigid> placed_at_;
  std::vector<Solid> world_;  // of the bodies that were needed in this frame
  std::vector<Vec3> balls_;   // centres of own_balls_ in the world
  std::vector<char> placed_;
  std::vector<ColliderPair> round_;  // what is near in this frame
  std::vector<double> round_m_;      // their signed distances
};

}  // namespace

int self_collision_subject_count(const Character& character) {
  return static_cast<int>(character.judged_pairs().size());
}

Subject self_collision_subject(const Character& character, int subject) {
  const JudgedPair& pair = character.judged_pairs()[static_cast<std::size_t>(subject)];
  const std::string& a = character.bodies()[static_cast<std::size_t>(pair.body_a)].name;
  const std::string& b = character.bodies()[static_cast<std::size_t>(pair.body_b)].name;
  return {a < b ? a + " ~ " + b : b + " ~ " + a, "m"};
}

void self_collision_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const JudgedPair> pairs = in.character.judged_pairs();
  const double band_m = in.settings.collision_band_m;
  Clearances clearances(in.character, band_m);
  BetweenFrames between(in.character);
  std::vector<double> before_m(pairs.size(), std::numeric_limits<double>::quiet_NaN());
  for (int frame = 0; frame < in.motion.frame_count; ++frame) {
    clearances.place(in.world_at(frame));
    if (frame > 0)
      between.set({in.motion.row(frame - 1), in.world_at(frame - 1)}, {in.motion.row(frame), in.world_at(frame)});
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const double clearance_m = clearances.of(p);
      const double now_m = std::min(clearance_m, band_m);
      double margin_m = clearance_m;
      if (between.may_overlap(pairs[p], before_m[p], now_m)) {
        const double least_m = between.least_distance(pairs[p], before_m[p], now_m);
        if (least_m < std::min(before_m[p], now_m)) margin_m = least_m;
      }
      fold.report(static_cast<int>(p), frame, margin_m);
      before_m[p] = now_m;
    }
  }
}

}  // namespace contort
