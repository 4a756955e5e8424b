#include "generator/motion/limb_room.h"

#include <algorithm>
#include <array>
#include <limits>

#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kBand_m = 0.08;   // pairs that are farther apart have room enough
constexpr double kSafe_m = 0.008;  // the gap that is wanted, where the figure at rest has as much

int child_count(const Character& character, int part) {
  int count = 0;
  for (int p = 1; p < static_cast<int>(character.parts().size()); ++p) count += carrier_of(character, p) == part;
  return count;
}

}  // namespace

std::vector<Limb> limbs_of(const Character& character) {
  std::vector<Limb> limbs;
  std::vector<std::size_t> limb_of(character.parts().size());
  for (int p = 1; p < static_cast<int>(character.parts().size()); ++p) {
    const int carrier = carrier_of(character, p);
    const bool goes_on = carrier != 0 && child_count(character, carrier) == 1;
    limb_of[at(p)] = goes_on ? limb_of[at(carrier)] : limbs.size();
    if (!goes_on) limbs.push_back({});
    Limb& limb = limbs[limb_of[at(p)]];
    limb.parts.push_back(p);
    const Part& part = character.parts()[at(p)];
    for (int j = part.first_joint; j < part.first_joint + part.joint_count; ++j) limb.joints.push_back(j);
  }
  return limbs;
}

void LimbRoom::begin(const Character& character) {
  character_ = &character;
  if (character_hash_ == character.hash() && !limbs_.empty()) return;
  character_hash_ = character.hash();
  begin_bodies();
  begin_pairs();
}

void LimbRoom::begin_bodies() {
  own_.clear(), ball_center_m_.clear(), ball_radius_m_.clear();
  for (const Collider& collider : character_->colliders()) own_.push_back(solid_of(collider));
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
}

void LimbRoom::begin_pairs() {
  limbs_ = limbs_of(*character_);
  limb_of_.assign(character_->parts().size(), -1), pairs_.assign(limbs_.size(), {}), safe_m_.clear();
  for (std::size_t l = 0; l < limbs_.size(); ++l)
    for (const int p : limbs_[l].parts) limb_of_[at(p)] = static_cast<int>(l);
  std::vector<Rigid> rest(character_->joints().size());
  forward_kinematics(*character_, character_->rest_root(), character_->rest_coords(), rest);
  for (std::size_t p = 0; p < character_->judged_pairs().size(); ++p) {
    const JudgedPair& pair = character_->judged_pairs()[p];
    const int a = limb_of_[part_of(pair.body_a)], b = limb_of_[part_of(pair.body_b)], index = static_cast<int>(p);
    if (a >= 0) pairs_[at(a)].push_back(index);
    if (b >= 0 && b != a) pairs_[at(b)].push_back(index);
    safe_m_.push_back(std::min(kSafe_m, distance_m(index, rest, kBand_m)));
  }
}

void LimbRoom::place_body(int body, std::span<const Rigid> world) {
  const Body& own = character_->bodies()[at(body)];
  for (int c = own.first_collider; c < own.first_collider + own.collider_count; ++c)
    place(world[at(own.joint)], own_[at(c)], world_[at(c)]);
}

// Infinite beyond the band. Both bodies are placed.
double LimbRoom::collider_distance_m(const JudgedPair& pair, double band_m) const {
  double least = kFar;
  for (int c = pair.first_pair; c < pair.first_pair + pair.pair_count; ++c) {
    const ColliderPair& colliders = character_->judged_colliders()[at(c)];
    const Solid &a = world_[at(colliders.a)], &b = world_[at(colliders.b)];
    const double matters = std::min(band_m, least), most = a.bound_m + b.bound_m + matters;
    const Vec3 d = b.center_m - a.center_m;
    if (most > 0.0 && glm::dot(d, d) > most * most) continue;
    least = std::min(least, signed_distance(a, b, matters));
  }
  return least > band_m ? kFar : least;
}

// Infinite beyond the band.
double LimbRoom::distance_m(int pair, std::span<const Rigid> world, double band_m) {
  const JudgedPair& judged = character_->judged_pairs()[at(pair)];
  const auto center = [&](int body) {
    return world[at(character_->bodies()[at(body)].joint)] * ball_center_m_[at(body)];
  };
  const Vec3 apart = center(judged.body_b) - center(judged.body_a);
  const double reach = ball_radius_m_[at(judged.body_a)] + ball_radius_m_[at(judged.body_b)] + band_m;
  if (glm::dot(apart, apart) > reach * reach) return kFar;
  place_body(judged.body_a, world), place_body(judged.body_b, world);
  return collider_distance_m(judged, band_m);
}

std::size_t LimbRoom::part_of(int body) const {
  return at(character_->joint(character_->bodies()[at(body)].joint).part);
}

const std::string& LimbRoom::kind_of(int limb) const {
  return character_->parts()[at(limbs_[at(limb)].parts.front())].kind;
}

bool LimbRoom::is_judged(int pair, int limb) const {
  const JudgedPair& judged = character_->judged_pairs()[at(pair)];
  return std::ranges::all_of(std::array{part_of(judged.body_a), part_of(judged.body_b)}, [&](std::size_t part) {
    const int other = limb_of_[part];
    return other == limb || (placed_[part] != 0 && (other < 0 || kind_of(other) != kind_of(limb)));
  });
}

double LimbRoom::room_m(std::size_t part, std::span<const Rigid> world) {
  const int limb = limb_of_[part];
  double least = kBand_m;
  for (const int p : pairs_[at(limb)])
    if (is_judged(p, limb)) least = std::min(least, distance_m(p, world, kBand_m) - safe_m_[at(p)]);
  return least;
}

}  // namespace contort
