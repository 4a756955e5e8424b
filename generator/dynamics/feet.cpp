#include "generator/dynamics/feet.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kFlat_m = 0.01;      // corners of a sole that can stand again are nearer than this,
constexpr double kSettled_m_s = 0.5;  // and slower
constexpr double kPlannedNear_m = 0.02;
constexpr double kPlannedSlide_m_s = 0.1;  // feet of recorded motion do slide
constexpr double kPlannedRise_m_s = 0.03;  // but one that rises has been lifted: to hold it would fight its own leg
constexpr double kSoft_s = 0.15;           // a sole becomes firm within this
constexpr double kLeastFirm = 0.1;
constexpr double kPlannedLevel = 0.97;  // cosine of 14 degrees

// Whether a sole of a target that moves so can stand, m/s.
bool is_slow(const Vec3& speed, const Vec3& normal) {
  const double rise = glm::dot(speed, normal);
  const double slide2 = glm::dot(speed, speed) - rise * rise;
  return std::fabs(rise) < kPlannedRise_m_s && slide2 < kPlannedSlide_m_s * kPlannedSlide_m_s;
}

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
  return Rigid{glm::quat_cast(Mat3(link.rotation)), link.origin_m} * sole.link_from_sole;
}

Rigid footprint(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment) {
  Rigid place = sole_place(sole, dynamics);
  const Surface ground = environment.nearest_ground(place.p_m);
  place.p_m = ground.point_m;
  place.q = shortest_arc(place.q * Vec3(0, 1, 0), ground.normal) * place.q;
  return place;
}

double gap_m(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment) {
  return environment.nearest_ground(sole_place(sole, dynamics).p_m).distance_m;
}

bool lies_still(const Sole& sole, const DynamicsScratch& dynamics, const Environment& environment) {
  const Placement& link = dynamics.world[at(sole.link)];
  const SpatialMotion& v = dynamics.velocity[at(sole.link)];
  for (const Vec3& corner : sole.corners_m) {
    const Vec3 point = link.origin_m + link.rotation * corner;
    const Vec3 speed = point_velocity(v, point - dynamics.world[0].origin_m);
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
      const bool level = glm::dot(sole.q * Vec3(0, 1, 0), ground.normal) > kPlannedLevel;
      if (is_slow(speed, ground.normal) && level && std::fabs(ground.distance_m) < kPlannedNear_m)
        stances[at(f)] |= static_cast<std::uint8_t>(1U << i);
      before[i] = sole.p_m;
    }
  }
  return stances;
}

double firmness(std::span<const std::uint8_t> stances, int sole, int frame, double rate_hz) {
  const int soft = static_cast<int>(kSoft_s * rate_hz), last = static_cast<int>(stances.size()) - 1;
  int nearest = soft;  // frames to one in which it does not stand; before and after the motion it does
  for (int away = 0; away < nearest; ++away)
    for (const int f : {frame - away, frame + away})
      if (f >= 0 && f <= last && (stances[at(f)] >> sole & 1) == 0) nearest = away;
  return soft > 0 ? std::max(kLeastFirm, static_cast<double>(nearest) / soft) : 1.0;
}

void soften(const DynamicFigure& figure, std::span<const std::uint8_t> stances, int frame, double rate_hz,
            std::span<double> firmness_squared, std::span<double> ease) {
  for (std::size_t i = 0; i < figure.soles.size(); ++i) {
    const double firm = firmness(stances, static_cast<int>(i), frame, rate_hz);
    firmness_squared[i] = firm * firm;
    for (const int dof : figure.soles[i].leg_dofs) ease[at(dof)] = 1.0 / (firm * firm);
  }
}

}  // namespace contort
