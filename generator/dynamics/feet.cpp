#include "generator/dynamics/feet.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kFlat_m = 0.01;      // corners of a sole that can stand again are nearer than this,
constexpr double kSettled_m_s = 0.5;  // and slower
constexpr double kPlannedNear_m = 0.02;
constexpr double kPlannedSlow_m_s = 0.2;
constexpr double kPlannedLevel = 0.97;  // cosine of 14 degrees

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

void Feet::begin(const DynamicFigure& figure) {
  figure_ = &figure;
  by_dof_.assign(at(figure.body.dof_count()), 0);
  clear();
}

bool Feet::stands(int sole) const { return std::ranges::find(soles_, sole) != soles_.end(); }

void Feet::land(int sole, const Rigid& world_from_sole) {
  const Sole& own = figure_->soles[at(sole)];
  soles_.push_back(sole);
  places_.push_back({own.link, own.link_from_sole, world_from_sole});
  mark();
}

void Feet::lift(int sole) {
  const auto found = std::ranges::find(soles_, sole);
  if (found == soles_.end()) return;
  places_.erase(places_.begin() + (found - soles_.begin()));
  soles_.erase(found);
  mark();
}

void Feet::clear() {
  soles_.clear();
  places_.clear();
  mark();
}

void Feet::mark() {
  std::ranges::fill(by_dof_, 0);
  for (const int sole : soles_)
    for (const int dof : figure_->soles[at(sole)].leg_dofs) by_dof_[at(dof)] = 1;
}

Rigid sole_place(const Sole& sole, const DynamicsScratch& dynamics) {
  const Placement& link = dynamics.world[at(sole.link)];
  return Rigid{glm::quat_cast(link.rotation), link.origin_m} * sole.link_from_sole;
}

Rigid footprint(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment) {
  Rigid place = sole_place(sole, dynamics);
  const Surface ground = environment.nearest_ground(place.p_m);
  place.p_m = ground.point_m;
  place.q = shortest_arc(place.q * Vec3(0, 1, 0), ground.normal) * place.q;
  return place;
}

bool lies_still(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment) {
  const Placement& link = dynamics.world[at(sole.link)];
  const SpatialMotion& v = dynamics.velocity[at(sole.link)];
  for (const Vec3& corner : sole.corners_m) {
    const Vec3 point = link.origin_m + link.rotation * corner;
    const Vec3 speed = v.linear + glm::cross(v.angular, point - dynamics.world[0].origin_m);
    if (std::fabs(environment.nearest_ground(point).distance_m) > kFlat_m) return false;
    if (glm::dot(speed, speed) > kSettled_m_s * kSettled_m_s) return false;
  }
  return true;
}

std::vector<std::uint8_t> planned_stances(const Character& character, const DynamicFigure& figure,
                                          const Environment& environment, const Motion& motion) {
  std::vector<std::uint8_t> stances(at(motion.frame_count), 0);
  std::vector<Rigid> world(character.joints().size());
  std::vector<Vec3> before(figure.soles.size());
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    for (std::size_t i = 0; i < figure.soles.size(); ++i) {
      const Rigid sole = world[at(figure.soles[i].link)] * figure.soles[i].link_from_sole;
      const Surface ground = environment.nearest_ground(sole.p_m);
      const Vec3 speed = f > 0 ? motion.rate_hz * (sole.p_m - before[i]) : Vec3(0.0);
      const bool slow = glm::dot(speed, speed) < kPlannedSlow_m_s * kPlannedSlow_m_s;
      const bool level = glm::dot(sole.q * Vec3(0, 1, 0), ground.normal) > kPlannedLevel;
      if (slow && level && std::fabs(ground.distance_m) < kPlannedNear_m)
        stances[at(f)] |= static_cast<std::uint8_t>(1U << i);
      before[i] = sole.p_m;
    }
  }
  return stances;
}

}  // namespace contort
