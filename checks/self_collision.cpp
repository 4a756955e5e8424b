// self_collision: signed distance of every judged pair of bodies, the least over their colliders. Most bodies are far
// apart in most frames: bounding balls, first of bodies and then of colliders, dismiss those, and only what is within
// the band is measured exactly. Between two frames the same is done with how far bodies can have come
// (between_frames.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/between_frames.h"
#include "checks/check.h"
#include "checks/distance.h"

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

class Clearances {
 public:
  Clearances(const Character& character, double band_m) : character_(character), band_m_(band_m) {
    for (const Collider& collider : character.colliders()) own_.push_back(solid_of(collider));
    for (const Body& body : character.bodies()) own_balls_.push_back(ball_of(body));
    world_.resize(own_.size());
    balls_.resize(own_balls_.size());
  }

  void place(std::span<const Rigid> joints) {
    const std::span<const Body> bodies = character_.bodies();
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Rigid& world_from_body = joints[static_cast<std::size_t>(bodies[b].joint)];
      balls_[b] = world_from_body * own_balls_[b].center_m;
    }
    placed_at_ = joints;
    placed_.assign(bodies.size(), false);
  }

  // Least signed distance over the pair's colliders, or infinity where none is within the band.
  double of(const JudgedPair& pair) {
    const auto a = static_cast<std::size_t>(pair.body_a);
    const auto b = static_cast<std::size_t>(pair.body_b);
    const double reach = own_balls_[a].radius_m + own_balls_[b].radius_m + band_m_;
    const double none = std::numeric_limits<double>::infinity();
    if (apart(balls_[a], balls_[b], reach)) return none;
    place_body(a);
    place_body(b);
    double least = band_m_;  // only what is nearer than the nearest so far needs to be exact
    for (int i = pair.first_pair; i < pair.first_pair + pair.pair_count; ++i) {
      const double distance = of(character_.judged_colliders()[static_cast<std::size_t>(i)], least);
      if (std::isnan(distance)) return distance;
      least = std::min(least, distance);
    }
    return least < band_m_ ? least : none;
  }

 private:
  Ball ball_of(const Body& body) const {
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c) {
      const Solid& solid = own_[static_cast<std::size_t>(c)];
      low = glm::min(low, solid.center_m - Vec3(solid.bound_m));
      high = glm::max(high, solid.center_m + Vec3(solid.bound_m));
    }
    Ball ball{0.5 * (low + high), 0.0};
    for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c) {
      const Solid& solid = own_[static_cast<std::size_t>(c)];
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
      world_[static_cast<std::size_t>(c)] =
          moved(placed_at_[static_cast<std::size_t>(body.joint)], own_[static_cast<std::size_t>(c)]);
  }

  double of(const ColliderPair& pair, double enough_m) const {
    const Solid& a = world_[static_cast<std::size_t>(pair.a)];
    const Solid& b = world_[static_cast<std::size_t>(pair.b)];
    const double reach = a.bound_m + b.bound_m + enough_m;
    // No overlap can be deeper than that of the bounding balls.
    if (reach <= 0.0 || apart(a.center_m, b.center_m, reach)) return std::numeric_limits<double>::infinity();
    return signed_distance(a, b, enough_m);
  }

  const Character& character_;
  double band_m_;
  std::vector<Solid> own_;       // in their joints' frames
  std::vector<Ball> own_balls_;  // of bodies
  std::span<const Rigid> placed_at_;
  std::vector<Solid> world_;  // of the bodies that were needed in this frame
  std::vector<Vec3> balls_;   // centres of own_balls_ in the world
  std::vector<char> placed_;
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
      const double clearance_m = clearances.of(pairs[p]);
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
