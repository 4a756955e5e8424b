#include "generator/dynamics/feet.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kFlat_m = 0.01;      // corners of a sole that can stand again are nearer than this,
constexpr double kSettled_m_s = 0.5;  // and slower
constexpr double kSoft_s = 0.15;      // a sole becomes firm within this
constexpr double kLeastFirm = 0.1;
constexpr double kAnkleShare = 0.9;  // of an ankle's strength that balance may take

bool bears_on(std::uint8_t corners, std::size_t corner) { return (corners >> corner & 1) != 0; }

// Points farther from the ankle than it is strong enough for come back to there, but not beyond all others.
void draw_back(const Sole& sole, double force_N, std::span<Vec3> points) {
  const Rigid sole_from_link = inverse(sole.link_from_sole);
  for (Vec3& point : points) point = sole_from_link * point;
  const double toes_m = kAnkleShare * sole.toes_N_m / force_N, heel_m = kAnkleShare * sole.heel_N_m / force_N;
  const double side_m = kAnkleShare * sole.tilt_N_m / force_N;
  for (const auto& [axis, behind_m, ahead_m] : {std::tuple(0, side_m, side_m), std::tuple(2, heel_m, toes_m)}) {
    const double middle_m = sole.ankle_m[axis];
    double low_m = 1e9, high_m = -1e9;
    for (const Vec3& point : points) low_m = std::min(low_m, point[axis]), high_m = std::max(high_m, point[axis]);
    const double from_m = std::clamp(middle_m - behind_m, low_m, high_m);
    const double to_m = std::clamp(middle_m + ahead_m, low_m, high_m);
    for (Vec3& point : points) point[axis] = std::clamp(point[axis], from_m, to_m);
  }
  for (Vec3& point : points) point = sole.link_from_sole * point;
}

}  // namespace

void add_bearing_points(const Sole& sole, const Bearing& bearing, double alone_N, std::vector<Vec3>& points) {
  const std::size_t first = points.size();
  const std::uint8_t corners = bearing.corners;
  for (std::size_t k = 0; k < 4; ++k) {
    if (!bears_on(corners, k)) continue;
    points.push_back(sole.corners_m[k]);
    for (const std::size_t other : {(k + 1) % 4, (k + 3) % 4}) {
      if (bears_on(corners, other)) continue;
      points.push_back(sole.corners_m[k] + bearing.depth * (sole.corners_m[other] - sole.corners_m[k]));
    }
  }
  if (alone_N > 0.0) draw_back(sole, alone_N, std::span(points).subspan(first));
}

void Feet::begin(const DynamicFigure& figure) {
  figure_ = &figure;
  by_dof_.assign(at(figure.body.dof_count()), 0);
  clear();
}

void Feet::put(int sole, const Bearing& bearing) {
  const bool same = bearings_[at(sole)].corners == bearing.corners;
  bearings_[at(sole)] = bearing;
  if (!same) mark();
}

void Feet::clear() {
  bearings_.assign(figure_->soles.size(), {});
  mark();
}

void Feet::mark() {
  std::ranges::fill(by_dof_, 0);
  soles_.clear();
  for (std::size_t i = 0; i < bearings_.size(); ++i) {
    if (bearings_[i].corners == 0) continue;
    soles_.push_back(static_cast<int>(i));
    for (const int dof : figure_->soles[i].leg_dofs) by_dof_[at(dof)] = 1;
  }
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

double firmness(std::span<const std::uint8_t> stances, int sole, int frame, double rate_hz) {
  const int soft = static_cast<int>(kSoft_s * rate_hz), last = static_cast<int>(stances.size()) - 1;
  int nearest = soft;  // frames to one in which it does not stand; before and after the motion it does
  for (int away = 0; away < nearest; ++away)
    for (const int f : {frame - away, frame + away})
      if (f >= 0 && f <= last && (stances[at(f)] >> sole & 1) == 0) nearest = away;
  return soft > 0 ? std::max(kLeastFirm, static_cast<double>(nearest) / soft) : 1.0;
}

}  // namespace contort
