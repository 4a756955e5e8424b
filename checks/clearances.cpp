#include "checks/clearances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/index.h"
#include "model/geometry/round_distances.h"

namespace contort {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// NaN counts as not apart, so that it is measured and reported.
bool apart(const Vec3& a, const Vec3& b, double reach_m) {
  const Vec3 d = a - b;
  return glm::dot(d, d) > reach_m * reach_m;
}

}  // namespace

Clearances::Clearances(const Character& character)
    : character_(character), colliders_(character.judged_colliders().begin(), character.judged_colliders().end()) {
  for (const Collider& collider : character.colliders()) own_.push_back(solid_of(collider));
  for (const Body& body : character.bodies()) own_balls_.push_back(ball_of(body));
  for (const JudgedPair& pair : character.judged_pairs()) pairs_.push_back(parted(pair));
  world_ = own_;
  placed_.resize(own_balls_.size());
  ways_.resize(colliders_.size(), Vec3(0.0));
}

Clearances::Pair Clearances::parted(const JudgedPair& pair) {
  const std::span<ColliderPair> all = std::span(colliders_).subspan(at(pair.first_pair), at(pair.pair_count));
  const auto both_round = [&](const ColliderPair& one) {
    return own_[at(one.a)].is_round() && own_[at(one.b)].is_round();
  };
  const auto others = std::stable_partition(all.begin(), all.end(), both_round);
  const std::size_t a = at(pair.body_a), b = at(pair.body_b), first = at(pair.first_pair);
  const std::size_t first_other = first + static_cast<std::size_t>(others - all.begin());
  return {a, b, own_balls_[a].radius_m + own_balls_[b].radius_m, first, first_other, first + all.size()};
}

Clearances::Ball Clearances::ball_of(const Body& body) const {
  const std::span<const Solid> solids = std::span(own_).subspan(at(body.first_collider), at(body.collider_count));
  Vec3 low(kUnbounded), high(-kUnbounded);
  for (const Solid& solid : solids) {
    low = glm::min(low, solid.center_m - Vec3(solid.bound_m));
    high = glm::max(high, solid.center_m + Vec3(solid.bound_m));
  }
  Ball ball{0.5 * (low + high), 0.0};
  for (const Solid& solid : solids) {
    const Vec3 d = solid.center_m - ball.center_m;
    ball.radius_m = std::max(ball.radius_m, std::sqrt(glm::dot(d, d)) + solid.bound_m);
  }
  return ball;
}

void Clearances::place(std::span<const Rigid> world) {
  placed_at_ = world;
  placed_.assign(placed_.size(), false);
}

const Rigid& Clearances::place_of(std::size_t body) const { return placed_at_[at(character_.bodies()[body].joint)]; }

void Clearances::place_body(std::size_t body) {
  if (placed_[body]) return;
  placed_[body] = true;
  const auto& [name, joint, first, count] = character_.bodies()[body];
  for (std::size_t c = at(first); c < at(first + count); ++c) contort::place(placed_at_[at(joint)], own_[c], world_[c]);
}

bool Clearances::are_apart(const ColliderPair& pair, double enough_m) const {
  const Solid &a = world_[at(pair.a)], &b = world_[at(pair.b)];
  const double reach = a.bound_m + b.bound_m + enough_m;
  // No overlap is deeper than that of the bounding spheres.
  return reach <= 0.0 || apart(a.center_m, b.center_m, reach);
}

// The extent of a body along n, measured from its joint and in the joint's frame.
double Clearances::extent_of(std::size_t body, const Vec3& n) const {
  const auto& [name, joint, first, count] = character_.bodies()[body];
  double extent_m = -kUnbounded;
  for (const Solid& solid : std::span(own_).subspan(at(first), at(count)))
    extent_m = std::max(extent_m, glm::dot(solid.center_m, n) + extent_along(solid, n));
  return extent_m;
}

double Clearances::gap_m(std::size_t judged) const {
  const Pair& pair = pairs_[judged];
  const Rigid &a = place_of(pair.body_a), &b = place_of(pair.body_b);
  const Vec3 n = a.q * pair.way;
  return glm::dot(b.p_m - a.p_m, n) - pair.way_extent_m - extent_of(pair.body_b, glm::conjugate(b.q) * -n);
}

void Clearances::set_way(Pair& pair, const Vec3& way) {
  if (way == Vec3(0.0)) return;
  pair.way = way, pair.way_extent_m = extent_of(pair.body_a, way);
}

void Clearances::set_way_of_round(Pair& pair, const ColliderPair& nearest) {
  Vec3 way;
  signed_distance(world_[at(nearest.a)], world_[at(nearest.b)], kUnbounded, way);
  set_way(pair, glm::conjugate(place_of(pair.body_a).q) * way);
}

void Clearances::gather_round(Pair& pair, double reach_m) {
  pair.first_measured = pair.end_measured = round_.size();
  const Vec3 between = ball_center(pair.body_a) - ball_center(pair.body_b);
  pair.apart_m = std::sqrt(glm::dot(between, between)) - pair.radii_m;
  pair.is_near = !(pair.apart_m > reach_m);  // NaN counts as near
  if (!pair.is_near) return;
  pair.apart_m = reach_m;
  place_body(pair.body_a);
  place_body(pair.body_b);
  for (std::size_t i = pair.first_round; i < pair.first_other; ++i)
    if (!are_apart(colliders_[i], reach_m)) round_.push_back(colliders_[i]);
  pair.end_measured = round_.size();
}

void Clearances::measure(std::span<const DuePair> due) {
  round_.clear();
  for (const DuePair& each : due) gather_round(pairs_[each.judged], each.reach_m);
  round_m_.resize(round_.size());
  round_distances(world_, round_, round_m_);
}

// Returns the gap along the direction of the last measurement, if it is at least `enough_m`. Otherwise it returns the
// distance, which is exact if it is below `band_m`.
double Clearances::distance_of_other(std::size_t i, const Pair& pair, double enough_m, double band_m) {
  const Solid &a = world_[at(colliders_[i].a)], &b = world_[at(colliders_[i].b)];
  const Quat& turn = place_of(pair.body_a).q;
  if (ways_[i] != Vec3(0.0))
    if (const double gap_m = gap_along(a, b, turn * ways_[i]); gap_m >= enough_m) return gap_m;
  Vec3 way;
  const double distance_m = signed_distance(a, b, band_m, way);
  ways_[i] = glm::conjugate(turn) * way;
  return distance_m;
}

double Clearances::distance_m(const DuePair& due) {
  Pair& pair = pairs_[due.judged];
  double least = pair.apart_m;  // only colliders nearer than this need an exact distance
  const ColliderPair* nearest = nullptr;
  for (std::size_t i = pair.first_measured; i < pair.end_measured; ++i) {
    if (std::isnan(round_m_[i])) return kNaN;
    if (round_m_[i] < least) least = round_m_[i], nearest = &round_[i];
  }
  if (nearest != nullptr) set_way_of_round(pair, *nearest);
  if (!pair.is_near) return least;
  for (std::size_t i = pair.first_other; i < pair.end_other; ++i) {
    if (are_apart(colliders_[i], least)) continue;
    const double distance = distance_of_other(i, pair, std::min(least, due.matters_m), least);
    if (std::isnan(distance)) return kNaN;
    if (distance < least) least = distance, set_way(pair, ways_[i]);
  }
  return least;
}

}  // namespace contort
