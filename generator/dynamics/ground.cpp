#include "generator/dynamics/ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "generator/dynamics/linear.h"
#include "generator/dynamics/support_hull.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kMomentPrice = 100.0;       // of a squared N m against a squared N
constexpr double kMostMomentPrice = 2000.0;  // where the ankle is weak
constexpr double kLeastShare = 0.2;          // of the weight that must press on the ground
constexpr double kLeastLoad = 0.05;          // of an even share of the weight, as which a sole counts at least
constexpr int kSharings = 12;  // greatest number of passes that bring the soles' forces inside their bearing areas,
constexpr double kInside = 0.98;                    // to this fraction of their extent,
constexpr double kSpare = 0.95;                     // and of the strength of their ankles,
constexpr double kOutside_N_m = 0.1;                // if a moment is this much too large
constexpr double kStep = 0.1;                       // least fraction of its ease that a sole keeps in a pass
constexpr double kLeastEase = 1e-3 / kMomentPrice;  // of any sole
constexpr double kYielding = 0.25;                  // of its firmness that a sole keeps in a pass in which it pulls
constexpr double kLeastFirmness = 1e-4;             // of a sole that pulls

// Row of the moment e . (n + (o - p) x f) in the root's entries of generalised forces: f in the world, n in its axes.
SupportEdge edge_between(const Vec3& from_m, const Vec3& to_m, const Placement& root) {
  SupportEdge edge{from_m, to_m - from_m, {}};
  edge.along /= std::sqrt(edge.along.x * edge.along.x + edge.along.z * edge.along.z);
  const Vec3 force = glm::cross(edge.along, root.origin_m - from_m);
  for (int k = 0; k < 3; ++k) {
    edge.row[at(k)] = force[k];
    edge.row[at(3 + k)] = glm::dot(edge.along, root.rotation[k]);
  }
  return edge;
}

}  // namespace

SpatialForce ground_force(const DynamicsScratch& dynamics, std::span<const double> forces) {
  return {dynamics.world[0].rotation * Vec3(forces[3], forces[4], forces[5]), Vec3(forces[0], forces[1], forces[2])};
}

void find_support_area(const DynamicFigure& figure, const Feet& feet, double alone_N, const DynamicsScratch& dynamics,
                       SupportArea& area) {
  area.corners_m.clear();
  for (const int s : feet.soles()) {
    const Sole& sole = figure.soles[at(s)];
    const Placement& link = dynamics.world[at(sole.link)];
    const std::size_t first = area.corners_m.size();
    add_bearing_points(sole, feet.bearing(s), feet.soles().size() == 1 ? alone_N : 0.0, area.corners_m);
    for (Vec3& corner : std::span(area.corners_m).subspan(first)) corner = link.origin_m + link.rotation * corner;
  }
  convex_hull(area.corners_m, area.order);
  area.edges.clear();
  for (std::size_t i = 0; i < area.order.size() && area.order.size() > 2; ++i) {
    const int next = area.order[(i + 1) % area.order.size()];
    area.edges.push_back(edge_between(area.corners_m[at(area.order[i])], area.corners_m[at(next)], dynamics.world[0]));
  }
}

Balance balance_of(const SupportArea& area, const DynamicsScratch& dynamics, std::span<const double> forces,
                   double weight_N) {
  const SpatialForce net = ground_force(dynamics, forces);
  Balance balance{dynamics.world[0].origin_m, -std::numeric_limits<double>::infinity()};
  if (!(net.force.y > kLeastShare * weight_N) || area.edges.empty()) return balance;
  double height_m = 0.0;
  for (const Vec3& corner : area.corners_m) height_m += corner.y / static_cast<double>(area.corners_m.size());
  // The ZMP is the point at that height where the force's moment has no horizontal part.
  const double down_m = height_m - balance.zmp_m.y;
  balance.zmp_m.x += (net.moment.z + down_m * net.force.x) / net.force.y;
  balance.zmp_m.z += (-net.moment.x + down_m * net.force.z) / net.force.y;
  balance.zmp_m.y = height_m;
  balance.margin_m = std::numeric_limits<double>::infinity();
  for (const SupportEdge& edge : area.edges)
    balance.margin_m = std::min(balance.margin_m, dot(edge.row, forces.first(kRootDofs)) / net.force.y);
  return balance;
}

double balanced_share(const SupportArea& area, std::span<const double> hold, std::span<const double> forces,
                      double margin_m) {
  double share = 1.0;
  for (const SupportEdge& edge : area.edges) {
    const auto inside = [&](std::span<const double> f) { return dot(edge.row, f.first(kRootDofs)) - margin_m * f[1]; };
    const double now = inside(forces), still = inside(hold);
    if (now < 0.0 && still > 0.0) share = std::min(share, still / (still - now));
  }
  return share;
}

// The bearing area: its middle and half its extent, in the sole's frame.
std::pair<Vec3, Vec3> GroundShare::area_of(const Sole& sole, const Bearing& bearing) {
  points_m_.clear();
  add_bearing_points(sole, bearing, 0.0, points_m_);
  const Rigid sole_from_link = inverse(sole.link_from_sole);
  Vec3 middle(0.0), half(0.0);
  for (Vec3& point : points_m_) {
    point = sole_from_link * point;
    middle += point / static_cast<double>(points_m_.size());
  }
  for (const Vec3& point : points_m_) half = glm::max(half, glm::abs(point - middle));
  return {middle, half};
}

// The ease with which a sole gives moments about its axes: less about the axis about which its ankle is weaker.
Vec3 GroundShare::moment_ease(const Sole& sole) {
  const double weaker = std::max(1.0, std::max(sole.toes_N_m, sole.heel_N_m) / std::max(sole.tilt_N_m, 1e-6));
  const double tilt_price = std::min(kMomentPrice * weaker * weaker, kMostMomentPrice);
  return {1.0 / kMomentPrice, 1.0 / kMomentPrice, 1.0 / tilt_price};
}

// Multipliers (moment mu, force phi) with f_i = firm (phi + mu x d_i) and n_i = firm E mu (E: moment_ease) meet sum f =
// F, sum n + d x f = N.
void GroundShare::prepare(const DynamicFigure& figure, const Feet& feet, std::span<const double> firmness,
                          const DynamicsScratch& dynamics) {
  const std::span<const int> standing = feet.soles();
  feet_.clear();
  dof_count_ = figure.body.dof_count();
  moves_.assign(standing.size() * at(dof_count_), 0);
  for (const int s : standing) {
    const Sole& sole = figure.soles[at(s)];
    const auto [middle_m, half_m] = area_of(sole, feet.bearing(s));
    const Rigid place = sole_place(sole, dynamics);
    for (const int dof : sole.chain_dofs) moves_[feet_.size() * at(dof_count_) + at(dof)] = 1;
    feet_.push_back({&sole, place * middle_m - dynamics.world[0].origin_m, middle_m, half_m, glm::mat3_cast(place.q),
                     firmness[at(s)], moment_ease(sole)});
  }
  begin();
}

void GroundShare::begin() {
  for (Foot& foot : feet_) foot.firmness = foot.own_firmness, foot.ease = foot.own_ease;
  factorise();
}

void GroundShare::factorise() {
  factors_.fill(0.0);
  const auto entry = [&](int i, int j) -> double& { return factors_[at(6 * i + j)]; };
  for (Foot& foot : feet_) {
    const Vec3 d = foot.center_m, e = foot.firmness * d, ease = foot.ease;
    foot.moment_ease =
        foot.axes * Mat3(ease.x, 0.0, 0.0, 0.0, ease.y, 0.0, 0.0, 0.0, ease.z) * glm::transpose(foot.axes);
    for (int i = 0; i < 3; ++i) {
      entry(3 + i, 3 + i) += foot.firmness;
      for (int j = 0; j < 3; ++j)
        entry(i, j) += foot.firmness * foot.moment_ease[j][i] + (i == j ? glm::dot(d, e) : 0.0) - d[i] * e[j];
    }
    // d x phi
    entry(3, 1) += e.z, entry(3, 2) -= e.y, entry(4, 0) -= e.z, entry(4, 2) += e.x, entry(5, 0) += e.y,
        entry(5, 1) -= e.x;
  }
  if (!feet_.empty()) factorise_symmetric(factors_, 6);
}

// A sole on which nothing presses can give no moment either.
void GroundShare::follow_load(const DynamicsScratch& dynamics, std::span<const double> forces) {
  if (feet_.size() < 2) return;
  begin();
  const SpatialForce net = ground_force(dynamics, forces), common = multipliers(net);
  if (!(net.force.y > 0.0)) return;
  const double even_N = net.force.y / static_cast<double>(feet_.size());
  std::array<double, kMaxLegs> loads{};
  for (std::size_t i = 0; i < feet_.size(); ++i) loads[i] = share_of(i, common).force.y / even_N;
  for (std::size_t i = 0; i < feet_.size(); ++i) feet_[i].ease *= std::clamp(loads[i], kLeastLoad, 1.0);
  factorise();
  for (int pass = 0; pass < kSharings && press_inside(net); ++pass) factorise();
}

// How far from the middle of its bearing area, in the sole's axes, a force of this size may act: inside that area, and
// where the ankle is strong enough for it.
std::pair<Vec3, Vec3> GroundShare::room_of(const Foot& foot, double force_N) {
  const Sole& sole = *foot.sole;
  const Vec3 ankle = sole.ankle_m - foot.middle_m;
  const Vec3 behind = kSpare / force_N * Vec3(sole.tilt_N_m, 0.0, sole.heel_N_m);
  const Vec3 ahead = kSpare / force_N * Vec3(sole.tilt_N_m, 0.0, sole.toes_N_m);
  return {glm::min(glm::max(-foot.half_m, ankle - behind), 0.0), glm::max(glm::min(foot.half_m, ankle + ahead), 0.0)};
}

// Makes soles that would have to pull less firm, and lets those whose force would act outside of their room give less
// of that moment. Returns whether there are any.
bool GroundShare::press_inside(const SpatialForce& net) {
  const SpatialForce common = multipliers(net);
  bool any = false;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    Foot& foot = feet_[i];
    const SpatialForce own = share_of(i, common);
    const Vec3 force = glm::transpose(foot.axes) * own.force;
    const Vec3 moment = glm::transpose(foot.axes) * (own.moment - glm::cross(foot.center_m, own.force));
    if (force.y < 0.0 && foot.firmness > kLeastFirmness) foot.firmness *= kYielding, any = true;
    const double pressing_N = std::max(force.y, 1e-6);
    const auto [low_m, high_m] = room_of(foot, pressing_N);
    for (const auto& [axis, along, moment_N_m] : {std::tuple(0, 2, -moment.x), std::tuple(2, 0, moment.z)}) {
      const double most = pressing_N * (moment_N_m > 0.0 ? high_m[along] : -low_m[along]);
      const double given = std::abs(moment_N_m);
      if (given <= most + kOutside_N_m || foot.ease[axis] <= kLeastEase) continue;
      const double step = kInside * most / given;
      foot.ease[axis] = std::max(foot.ease[axis] * std::max(step * step, kStep), kLeastEase);
      any = true;
    }
  }
  return any;
}

SpatialForce GroundShare::multipliers(const SpatialForce& net) const {
  double x[6];
  for (int k = 0; k < 3; ++k) x[k] = net.moment[k], x[3 + k] = net.force[k];
  solve_factorised(factors_, 6, x);
  return {Vec3(x[0], x[1], x[2]), Vec3(x[3], x[4], x[5])};
}

SpatialForce GroundShare::multipliers(const DynamicsScratch& dynamics, std::span<const double> forces) const {
  return feet_.empty() ? SpatialForce{} : multipliers(ground_force(dynamics, forces));
}

SpatialForce GroundShare::share_of(std::size_t standing, const SpatialForce& m) const {
  const Vec3& d = feet_[standing].center_m;
  const double firm = feet_[standing].firmness;
  const Vec3 force = firm * (m.force + glm::cross(m.moment, d));
  return {firm * (feet_[standing].moment_ease * m.moment.narrow()) + glm::cross(d, force), force};
}

void GroundShare::efforts(const DynamicsScratch& dynamics, std::span<const double> forces,
                          std::span<double> out) const {
  std::copy(forces.begin(), forces.end(), out.begin());
  std::fill_n(out.begin(), kRootDofs, 0.0);
  const SpatialForce common = multipliers(dynamics, forces);
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const SpatialForce own = share_of(i, common);
    for (const int dof : feet_[i].sole->chain_dofs)
      out[at(dof)] -= dot(dynamics.freedoms[at(dof)], own);
  }
}

double GroundShare::effort(const DynamicsScratch& dynamics, std::span<const double> forces,
                           const SpatialForce& multipliers, int dof) const {
  double effort = forces[at(dof)];
  for (std::size_t i = 0; i < feet_.size(); ++i)
    if (moves_[i * at(dof_count_) + at(dof)] != 0) effort -= dot(dynamics.freedoms[at(dof)], share_of(i, multipliers));
  return effort;
}

}  // namespace contort
