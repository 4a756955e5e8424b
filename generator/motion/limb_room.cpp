#include "generator/motion/limb_room.h"

#include <algorithm>
#include <set>

#include "generator/motion/arm_swing.h"
#include "model/core/index.h"
#include "model/geometry/solid_points.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// The gaps that are wanted, where the figure at rest has as much. Hands hold objects.
constexpr double kSafe_m = 0.008;
constexpr double kSafeInHands_m = 0.001;
constexpr double kTouch_m = 0.001;
constexpr double kSink_m = 0.002;  // of feet that stand, on ground that is not quite level
constexpr double kSurely_m = 1e-9;  // more than the rounding of distances

int child_count(const Character& character, int part) {
  int count = 0;
  for (int p = 1; p < static_cast<int>(character.parts().size()); ++p) count += carrier_of(character, p) == part;
  return count;
}

}  // namespace

std::vector<Limb> limbs_of(const Character& character, std::span<const Leg> legs) {
  std::vector<Limb> limbs;
  std::vector<std::size_t> limb_of(character.parts().size());
  std::vector<std::set<std::size_t>> carriers;  // of a limb: the limbs that carry it
  for (int p = 1; p < static_cast<int>(character.parts().size()); ++p) {
    const int carrier = carrier_of(character, p);
    const bool goes_on = carrier != 0 && child_count(character, carrier) == 1;
    limb_of[at(p)] = goes_on ? limb_of[at(carrier)] : limbs.size();
    if (!goes_on) {
      limbs.push_back({});
      carriers.push_back(carrier == 0 ? std::set<std::size_t>{} : carriers[limb_of[at(carrier)]]);
      if (carrier != 0) carriers.back().insert(limb_of[at(carrier)]);
    }
    Limb& limb = limbs[limb_of[at(p)]];
    limb.parts.push_back(p);
    const Part& part = character.parts()[at(p)];
    for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j) {
      limb.joints.push_back(j);
      for (const std::size_t c : carriers[limb_of[at(p)]]) limbs[c].carried.push_back(j);
    }
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
      if (legs[leg].foot_part != p) continue;
      limb.legs.push_back(static_cast<int>(leg));
      for (const std::size_t c : carriers[limb_of[at(p)]]) limbs[c].legs.push_back(static_cast<int>(leg));
    }
  }
  return limbs;
}

void LimbRoom::begin(const Character& character, const Environment& environment, const StandingFeet& feet) {
  character_ = &character, environment_ = &environment, feet_ = &feet;
  std::ranges::fill(held_, HeldObject{});
  if (character_hash_ == character.hash() && !limbs_.empty()) return;
  character_hash_ = character.hash();
  begin_bodies();
  begin_pairs();
}

void LimbRoom::begin_bodies() {
  own_.clear(), core_m_.clear(), ball_center_m_.clear(), ball_radius_m_.clear();
  for (const Collider& collider : character_->colliders()) own_.push_back(solid_of(collider));
  for (const Solid& solid : own_) core_m_.push_back(core_points(solid));
  world_ = own_;
  for (const Body& body : character_->bodies()) {
    const std::span<const Solid> solids = std::span(own_).subspan(at(body.first_collider), at(body.collider_count));
    Vec3 low(kFar), high(-kFar);
    for (const Solid& solid : solids)
      low = glm::min(low, solid.center_m - solid.bound_m), high = glm::max(high, solid.center_m + solid.bound_m);
    const Vec3 center = 0.5 * (low + high);
    double radius = 0.0;
    for (const Solid& solid : solids) radius = std::max(radius, length(solid.center_m - center) + solid.bound_m);
    ball_center_m_.push_back(center), ball_radius_m_.push_back(radius);
  }
  ball_world_m_ = ball_center_m_, placed_at_.assign(ball_center_m_.size(), {});
  has_solids_.assign(ball_center_m_.size(), 0);
  ways_.assign(character_->judged_colliders().size(), Vec3(0.0));
}

// Returns true if a limb is this one or carried by it.
bool LimbRoom::is_moved_by(int limb, int other) const {
  if (other < 0) return false;
  const std::vector<int>& carried = limbs_[at(limb)].carried;
  return other == limb || std::ranges::find(carried, limbs_[at(other)].joints.front()) != carried.end();
}

void LimbRoom::begin_pairs() {
  limbs_ = limbs_of(*character_, feet_->legs());
  held_.assign(limbs_.size(), {});
  limb_of_.assign(character_->parts().size(), -1), pairs_.assign(limbs_.size(), {});
  for (std::size_t l = 0; l < limbs_.size(); ++l)
    for (const int p : limbs_[l].parts) limb_of_[at(p)] = static_cast<int>(l);
  limb_of_body_.clear(), kind_.clear();
  for (int b = 0; b < static_cast<int>(character_->bodies().size()); ++b) limb_of_body_.push_back(limb_of_[part_of(b)]);
  for (int l = 0; l < static_cast<int>(limbs_.size()); ++l) kind_.push_back(first_of_kind(l));
  before_.resize(character_->joints().size());
  forward_kinematics(*character_, character_->rest_root(), character_->rest_coords(), before_);
  begin_look(-1, before_);
  for (const JudgedPair& judged : character_->judged_pairs()) {
    const int a = limb_of_body_[at(judged.body_a)], b = limb_of_body_[at(judged.body_b)];
    const bool is_in_hands = (is_object(judged.body_a) && has_grip(b)) || (is_object(judged.body_b) && has_grip(a));
    Pair pair{judged, ball_radius_m_[at(judged.body_a)] + ball_radius_m_[at(judged.body_b)]};
    pair.safe_m = std::min(is_in_hands ? kSafeInHands_m : kSafe_m, distance_m(pair, kRoomBand_m));
    for (int l = 0; l < static_cast<int>(limbs_.size()); ++l)
      if ((is_moved_by(l, a) || is_moved_by(l, b)) && (a != b || a == l)) pairs_[at(l)].push_back(pair);
  }
  swings_.clear();
  for (const Limb& limb : limbs_) swings_.push_back(is_free_arm(*character_, feet_->legs(), limb.parts.front()));
  begin_ground();
}

void LimbRoom::begin_ground() {
  const Environment level;
  bodies_.assign(limbs_.size(), {}), safe_over_ground_m_.clear();
  for (int b = 0; b < static_cast<int>(character_->bodies().size()); ++b) {
    const int limb = limb_of_[part_of(b)];
    for (int l = 0; l < static_cast<int>(limbs_.size()); ++l)
      if (l == limb || (is_moved_by(l, limb) && !is_leg(limb))) bodies_[at(l)].push_back(b);
    const double at_rest_m = over_ground_m(b, before_[at(character_->bodies()[at(b)].joint)], level, kRoomBand_m);
    safe_over_ground_m_.push_back(std::min(kSafe_m, at_rest_m - kSink_m));
  }
}

bool LimbRoom::is_object(int body) const { return character_->bodies()[at(body)].name.starts_with("object:"); }

bool LimbRoom::is_leg(int limb) const {
  const auto is_of_limb = [&](const Leg& leg) { return limb_of_[at(leg.part)] == limb; };
  return limb >= 0 && std::ranges::any_of(feet_->legs(), is_of_limb);
}

bool LimbRoom::has_grip(int limb) const {
  return limb >= 0 && std::ranges::any_of(character_->sockets(), [&](const Socket& socket) {
           return socket.name.ends_with("/grip") && limb_of_[at(character_->joint(socket.joint).part)] == limb;
         });
}

// Most bodies are where they were in the look before. Their solids are placed when they are first asked for. A body of
// another limb of the same kind is on its way from where it was before this frame.
void LimbRoom::begin_look(int limb, std::span<const Rigid> world, double twins) {
  const std::span<const Body> bodies = character_->bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Rigid &then = world[at(bodies[b].joint)], &before = before_[at(bodies[b].joint)];
    Rigid now = then;
    if (is_twin(limb, limb_of_body_[b]))
      now = twins == 0.0 || before == then ? before : part_way(before, then, twins);
    if (now == placed_at_[b]) continue;
    placed_at_[b] = now, has_solids_[b] = 0;
    ball_world_m_[b] = now * ball_center_m_[b];
  }
}

void LimbRoom::place_solids(int body) {
  if (has_solids_[at(body)] != 0) return;
  has_solids_[at(body)] = 1;
  const Body& own = character_->bodies()[at(body)];
  for (int c = own.first_collider; c < own.first_collider + own.collider_count; ++c)
    place(placed_at_[at(body)], own_[at(c)], world_[at(c)]);
}

// Infinite beyond the band. Both bodies are placed. Colliders that were apart along a direction mostly still are.
double LimbRoom::collider_distance_m(const JudgedPair& pair, double band_m) {
  double least = kFar;
  const std::span<const ColliderPair> judged = character_->judged_colliders();
  for (int c = pair.first_pair; c < pair.first_pair + pair.pair_count; ++c) {
    const Solid &a = world_[at(judged[at(c)].a)], &b = world_[at(judged[at(c)].b)];
    const double matters = std::min(band_m, least), most = a.bound_m + b.bound_m + matters;
    const Vec3 d = b.center_m - a.center_m;
    if (most > 0.0 && glm::dot(d, d) > most * most) continue;
    Vec3& way = ways_[at(c)];
    if (way != Vec3(0.0) && gap_along(a, b, way) > matters + kSurely_m) continue;
    least = std::min(least, signed_distance(a, b, matters, way));
  }
  return least > band_m ? kFar : least;
}

// Returns true if the balls that hold two bodies are no farther apart than the band.
bool LimbRoom::are_near(const Pair& pair, double band_m) const {
  const Vec3 apart = ball_world_m_[at(pair.bodies.body_b)] - ball_world_m_[at(pair.bodies.body_a)];
  const double reach = pair.radii_m + band_m;
  return !(reach < 0.0 || glm::dot(apart, apart) > reach * reach);
}

// Infinite beyond the band.
double LimbRoom::distance_m(const Pair& pair, double band_m) {
  if (!are_near(pair, band_m)) return kFar;
  place_solids(pair.bodies.body_a), place_solids(pair.bodies.body_b);
  return collider_distance_m(pair.bodies, band_m);
}

// Returns true if one body is a hand and the other one the object that it holds.
bool LimbRoom::is_held(const Pair& pair) const {
  return holds(pair.bodies.body_a, pair.bodies.body_b) || holds(pair.bodies.body_b, pair.bodies.body_a);
}

// Infinite, or any distance beyond it, beyond the band.
double LimbRoom::over_ground_m(int body, const Rigid& world_from_body, const Environment& environment,
                               double band_m) const {
  const Vec3 center = world_from_body * ball_center_m_[at(body)];
  const double radius_m = ball_radius_m_[at(body)];
  if (environment.is_surely_over_ground(center, radius_m, band_m)) return kFar;
  if (environment.nearest_ground(center).distance_m > radius_m + kRoomBand_m) return kFar;
  double least = kFar;
  const Body& own = character_->bodies()[at(body)];
  for (int c = own.first_collider; c < own.first_collider + own.collider_count; ++c)
    for (const Vec3& core : core_m_[at(c)]) {
      const Vec3 point = world_from_body * core;
      if (environment.is_surely_over_ground(point, own_[at(c)].radius_m, std::min(least, band_m))) continue;
      least = std::min(least, environment.nearest_ground(point).distance_m - own_[at(c)].radius_m);
    }
  return least;
}

// By the points that span its colliders; infinite beyond the band. A hand or foot may lie on an obstacle.
double LimbRoom::off_obstacles_m(int body, const Rigid& world_from_body, double band_m) const {
  if (environment_->obstacles().empty()) return kFar;
  const Vec3 center = world_from_body * ball_center_m_[at(body)];
  const double matters_m = std::min(kRoomBand_m, band_m + kSurely_m);
  if (environment_->nearest_obstacle(center).distance_m > ball_radius_m_[at(body)] + matters_m) return kFar;
  double least = kFar;
  const Body& own = character_->bodies()[at(body)];
  for (int c = own.first_collider; c < own.first_collider + own.collider_count; ++c)
    for (const Vec3& point : core_m_[at(c)])
      least = std::min(least, environment_->nearest_obstacle(world_from_body * point).distance_m - own_[at(c)].radius_m);
  return least;
}

bool LimbRoom::is_twin(int limb, int other) const {
  return limb >= 0 && other >= 0 && other != limb && kind_[at(other)] == kind_[at(limb)];
}

double LimbRoom::twins_way_m(std::size_t part, std::span<const Rigid> world) const {
  double most = 0.0;
  for (std::size_t b = 0; b < limb_of_body_.size(); ++b) {
    const std::size_t joint = at(character_->bodies()[b].joint);
    if (!is_twin(limb_of_[part], limb_of_body_[b]) || world[joint] == before_[joint]) continue;
    most = std::max(most, length(world[joint] * ball_center_m_[b] - before_[joint] * ball_center_m_[b]));
  }
  return most;
}

std::size_t LimbRoom::part_of(int body) const {
  return at(character_->joint(character_->bodies()[at(body)].joint).part);
}

int LimbRoom::first_of_kind(int limb) const {
  const auto kind_of = [&](int l) { return character_->parts()[at(limbs_[at(l)].parts.front())].kind; };
  int first = 0;
  while (kind_of(first) != kind_of(limb)) ++first;
  return first;
}

// The distance from which on the pair leaves no less room than this.
double LimbRoom::Pair::band_below(double room_m) const { return std::min(kRoomBand_m, room_m + safe_m + kSurely_m); }

double LimbRoom::apart_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range) {
  const int limb = limb_of_[part];
  double least = range.high_m;
  begin_look(limb, world, range.twins);
  std::vector<Pair>& pairs = pairs_[at(limb)];
  for (std::size_t i = 0; i < pairs.size() && !(least < range.low_m); ++i) {
    const double band_m = pairs[i].band_below(least);
    if (!are_near(pairs[i], band_m) || is_held(pairs[i])) continue;
    const double room_m = distance_m(pairs[i], band_m) - std::min(range.gap_m, pairs[i].safe_m);
    if (!(room_m < least)) continue;
    least = room_m;
    std::swap(pairs[i], pairs.front());  // the nearest pair is mostly the nearest in the next look, too
  }
  return least;
}

double LimbRoom::room_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range) {
  const int limb = limb_of_[part];
  double least = apart_m(part, world, range);
  for (const int b : bodies_[at(limb)]) {
    if (least < range.low_m) return least;
    const Rigid& world_from_body = world[at(character_->bodies()[at(b)].joint)];
    const double safe_m = safe_over_ground_m_[at(b)];
    least = std::min(least, over_ground_m(b, world_from_body, *environment_, least + safe_m) - safe_m);
    least = std::min(least, off_obstacles_m(b, world_from_body, least));
  }
  for (const int leg : limbs_[at(limb)].legs) {
    const bool is_its_own = limbs_[at(limb)].is_its_own(feet_->legs()[at(leg)]);
    if (!is_its_own && !feet_->is_planted(at(leg))) continue;
    // A foot of its own is lifted just as far as it must be: that it has no more to spare is no reason to go nearer to
    // bodies.
    const double spare_m = feet_->room_m(at(leg), world);
    if (!is_its_own || spare_m < -kTooNear_m) least = std::min(least, spare_m);
  }
  return least;
}

double LimbRoom::room_beside_m(std::size_t part, const HeldObject& held, std::span<const Rigid> world) {
  double least = kRoomBand_m;
  begin_look(-1, world);
  for (const Pair& pair : pairs_[at(limb_of_[part])])
    if (!is_of(held, pair)) least = std::min(least, distance_m(pair, pair.band_below(least)) - pair.safe_m);
  return least;
}

double LimbRoom::over_plane_m(int joint, const Vec3& point_m, const Vec3& normal, std::span<const Rigid> world) const {
  double least = kFar;
  for (const Body& body : character_->bodies())
    if (body.joint == joint)
      for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c)
        for (const Vec3& point : core_m_[at(c)])
          least = std::min(least, dot(world[at(joint)] * point - point_m, normal) - own_[at(c)].radius_m);
  return least;
}

bool LimbRoom::swings(int limb) const { return limb >= 0 && swings_[at(limb)] != 0; }

bool LimbRoom::touches(std::size_t part, std::span<const Rigid> world) {
  begin_look(-1, world);
  return std::ranges::any_of(pairs_[at(limb_of_[part])], [&](const Pair& pair) {
    const int a = limb_of_body_[at(pair.bodies.body_a)], b = limb_of_body_[at(pair.bodies.body_b)];
    const double touch_m = std::min(kTouch_m, pair.safe_m);
    return !swings(a) && !swings(b) && !is_held(pair) && distance_m(pair, touch_m + kSurely_m) < touch_m;
  });
}

// Returns true if `body` belongs to the hand that holds the body `object`.
bool LimbRoom::is_of(const HeldObject& held, int body, int object) const {
  if (held.body < 0 || held.body != object) return false;
  int joint = character_->bodies()[at(body)].joint;
  while (joint > held.joint) joint = character_->joint(joint).parent;
  return joint == held.joint;
}

bool LimbRoom::is_of(const HeldObject& held, const Pair& pair) const {
  return is_of(held, pair.bodies.body_a, pair.bodies.body_b) || is_of(held, pair.bodies.body_b, pair.bodies.body_a);
}

bool LimbRoom::holds(int body, int object) const {
  const int limb = limb_of_body_[at(body)];
  return limb >= 0 && is_of(held_[at(limb)], body, object);
}

bool LimbRoom::is_at(const HeldObject& held, std::size_t part, std::span<const Rigid> world) {
  constexpr double kAt_m = 0.002;
  begin_look(limb_of_[part], world);
  return std::ranges::any_of(pairs_[at(limb_of_[part])], [&](const Pair& pair) {
    return is_of(held, pair) && distance_m(pair, kAt_m + kSurely_m) < kAt_m;
  });
}

}  // namespace contort
