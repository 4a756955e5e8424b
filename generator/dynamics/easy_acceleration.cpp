#include "generator/dynamics/easy_acceleration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/dynamics/dynamics.h"
#include "generator/dynamics/support_hull.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kOfStrength = 0.2;    // of what gravity leaves of it
constexpr double kLeastFree = 0.25;    // of the strength, whatever gravity takes
constexpr double kOfSupport = 0.2;     // of the way to the edge of the soles
constexpr double kOfLegs = 0.2;        // of the strength of legs that stand,
constexpr double kLifts_m_s2 = 3.7;    // but a foot is lifted at this at least
constexpr double kFoot_m = 0.2;        // joints that are nearer to a sole move only a foot
constexpr double kToSpeed_s = 0.1;     // from rest to the greatest speed: light joints could do it within a tick
constexpr double kSways_rad_s2 = 4.0;  // a trunk that is slower than this takes the hips along as a counterweight

// A figure at rest, as far as the accelerations of its joints go.
class RestingFigure {
 public:
  RestingFigure(const Character& character, const DynamicFigure& figure) : figure_(figure), body_(figure.body) {
    place(body_, character.rest_root(), character.rest_coords(), scratch_);
    matrix_.assign(at(body_.dof_count() * body_.dof_count()), 0.0);
    mass_matrix(body_, scratch_, matrix_);
    Vec3 moment(0.0);
    for (std::size_t i = 0; i < body_.links().size(); ++i)
      moment += body_.links()[i].mass_kg * (scratch_.world[i].origin_m.narrow() +
                                            Mat3(scratch_.world[i].rotation) * body_.links()[i].center_of_mass_m);
    com_m_ = moment / body_.mass_kg();
    find_support();
  }

  double easy_acceleration(const Link& link) {
    double least = kInfinite;
    for (int dof = link.dof; dof < link.dof + link.dof_count; ++dof)
      least = std::min(
          {least, kOfStrength * strong(dof), std::max(kOfSupport * steady(dof), kSways_rad_s2), borne(link, dof)});
    return least;
  }

 private:
  double entry(int row, int column) const { return matrix_[at(row * body_.dof_count() + column)]; }

  // The force that a unit acceleration takes, per unit: N of a rotation, kg of a travel. Its size times g is the
  // greatest moment of gravity.
  Vec3 force(int dof) const { return {entry(dof, 0), entry(dof, 1), entry(dof, 2)}; }

  Vec3 torque(int dof) const {
    return Mat3(scratch_.world[0].rotation) * Vec3(entry(dof, 3), entry(dof, 4), entry(dof, 5));
  }

  double strong(int dof) const {
    const double strength = std::min(-figure_.strength_low[at(dof)], figure_.strength_high[at(dof)]);
    const double free = std::max(strength - kGravity_m_s2 * length(force(dof)), kLeastFree * strength);
    return entry(dof, dof) > 0.0 ? free / entry(dof, dof) : kInfinite;
  }

  double steady(int dof) const {
    const Vec3 root_m = scratch_.world[0].origin_m.narrow();
    const Vec3 moment = torque(dof) + glm::cross(root_m - Vec3(com_m_.x, ground_m_, com_m_.z), force(dof));
    const double across = std::sqrt(moment.x * moment.x + moment.z * moment.z);
    return across > 0.0 ? edge_m_ * body_.mass_kg() * kGravity_m_s2 / across : kInfinite;
  }

  // By legs that stand while another one moves: what turns the hips turns them against these legs.
  double borne(const Link& link, int dof) const {
    const auto moves = [&](const Sole& sole) { return std::ranges::find(sole.leg_dofs, dof) != sole.leg_dofs.end(); };
    const auto own = std::ranges::find_if(figure_.soles, moves);
    if (own == figure_.soles.end()) return kInfinite;
    const auto joint = at(static_cast<int>(&link - body_.links().data()));
    const double lever_m = length(scratch_.world[at(own->link)].origin_m - scratch_.world[joint].origin_m);
    if (lever_m < kFoot_m) return kInfinite;
    double least = kInfinite;
    for (const Sole& sole : figure_.soles)
      if (!moves(sole))
        for (const int k : sole.leg_dofs) least = std::min(least, kOfLegs * strength_against(dof, k));
    return std::max(least, kLifts_m_s2 / lever_m);
  }

  // The acceleration of a freedom that takes all strength of one of a leg that bears the figure.
  double strength_against(int dof, int bearing_dof) const {
    const SpatialMotion& freedom = scratch_.freedoms[at(bearing_dof)];
    const Vec3 travel = freedom.linear.narrow(), turn = freedom.angular.narrow();
    const double effort = std::fabs(glm::dot(travel, force(dof)) + glm::dot(turn, torque(dof)));
    const double strength = std::min(-figure_.strength_low[at(bearing_dof)], figure_.strength_high[at(bearing_dof)]);
    return effort > 0.0 ? strength / effort : kInfinite;
  }

  void find_support() {
    std::vector<Vec3> corners;
    for (const Sole& sole : figure_.soles)
      for (const Vec3& corner : sole.corners_m) {
        const Placement& link = scratch_.world[at(sole.link)];
        corners.push_back(link.origin_m.narrow() + Mat3(link.rotation) * corner);
        ground_m_ = std::min(ground_m_, corners.back().y);
      }
    if (corners.empty()) return void(edge_m_ = kInfinite);
    std::vector<int> hull;
    convex_hull(corners, hull);
    edge_m_ = kInfinite;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec3 a = corners[at(hull[i])], way = corners[at(hull[(i + 1) % hull.size()])] - a, off = com_m_ - a;
      edge_m_ = std::min(edge_m_, std::fabs(way.z * off.x - way.x * off.z) / std::sqrt(way.x * way.x + way.z * way.z));
    }
  }

  const DynamicFigure& figure_;
  const Multibody& body_;
  DynamicsScratch scratch_;
  std::vector<double> matrix_;
  Vec3 com_m_{0.0};
  double ground_m_ = kInfinite;
  double edge_m_ = 0.0;
};

}  // namespace

std::vector<double> easy_accelerations(const Character& character, const DynamicFigure& figure) {
  RestingFigure resting(character, figure);
  std::vector<double> out;
  for (std::size_t i = 0; i < character.joints().size(); ++i) {
    const Link& link = figure.body.links()[i];
    const double swift = character.joints()[i].max_speed / kToSpeed_s;
    out.push_back(link.kind == JointKind::root ? kInfinite : std::min(swift, resting.easy_acceleration(link)));
  }
  return out;
}

}  // namespace contort
