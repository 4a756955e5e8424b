// ground_penetration: how far each body is above the ground. The deepest point of a collider is a corner or end of its
// core, minus its radius. This is exact on planes and slopes. On steps and height fields the distance is taken along
// the normal under a point, and a ridge between two corners can reach deeper.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "checks/check.h"
#include "checks/feet_findings.h"
#include "checks/fixed_limits.h"
#include "model/geometry/solid_points.h"

namespace contort {

namespace {

// Computes the height over level ground by a formula that needs only the upward components of a transform. `up` is the
// row of the rotation for these. Hulls are transformed completely.
double lowest_m(const Rigid& world_from_body, const Vec3& up, const Solid& own, Solid& placed) {
  const double center_m = (world_from_body * own.center_m).y;
  switch (own.core) {
    case Solid::Core::point: return center_m - own.radius_m;
    case Solid::Core::segment:
      return center_m - (own.half_length_m * std::fabs((world_from_body.q * own.axis).y) + own.radius_m);
    case Solid::Core::box: {
      const Vec3 rise(glm::dot(up, own.axes[0]), glm::dot(up, own.axes[1]), glm::dot(up, own.axes[2]));
      return center_m - (glm::dot(glm::abs(rise), own.half_m) + own.radius_m);
    }
    case Solid::Core::hull: break;
  }
  place(world_from_body, own, placed);
  return placed.center_m.y - extent_along(placed, Vec3(0.0, -1.0, 0.0));
}

// The height above the ground; `least_m` if no point is nearer.
double height_above(const Environment& environment, const Solid& solid, double least_m) {
  for (const Vec3& point : core_points(solid)) {
    if (environment.is_surely_over_ground(point, solid.radius_m, least_m)) continue;
    const double distance_m = environment.nearest_ground(point).distance_m - solid.radius_m;
    if (!(distance_m >= least_m)) least_m = distance_m;  // NaN stays
  }
  return least_m;
}

}  // namespace

int ground_penetration_subject_count(const Character& character) { return static_cast<int>(character.bodies().size()); }

Subject ground_penetration_subject(const Character& character, int subject) {
  return {character.bodies()[static_cast<std::size_t>(subject)].name, "m"};
}

namespace {

// Measures the heights of bodies over the ground, frame by frame.
class Heights {
 public:
  explicit Heights(const CheckInput& in) : in_(in), level_m_(in.environment.height_at(0.0, 0.0)) {
    for (const Collider& collider : in.character.colliders()) own_.push_back(solid_of(collider));
    placed_ = own_;
  }

  double of(const Body& body, const Rigid& world_from_body) {
    const Mat3 axes = glm::mat3_cast(world_from_body.q);
    const Vec3 up(axes[0].y, axes[1].y, axes[2].y);
    double least_m = std::numeric_limits<double>::infinity();
    for (int c = 0; c < body.collider_count; ++c) {
      const auto i = static_cast<std::size_t>(body.first_collider + c);
      const double height_m = of_collider(i, world_from_body, up, least_m);
      if (!(height_m >= least_m)) least_m = height_m;
    }
    return least_m;
  }

 private:
  double of_collider(std::size_t i, const Rigid& world_from_body, const Vec3& up, double least_m) {
    if (in_.environment.is_level()) return lowest_m(world_from_body, up, own_[i], placed_[i]) - level_m_;
    place(world_from_body, own_[i], placed_[i]);
    return height_above(in_.environment, placed_[i], least_m);
  }

  const CheckInput& in_;
  double level_m_;
  std::vector<Solid> own_;
  std::vector<Solid> placed_;
};

}  // namespace

void ground_penetration_measure(const CheckInput& in, MarginFold& fold) {
  Heights heights(in);
  const std::span<const Body> bodies = in.character.bodies();
  std::vector<double> margins(bodies.size());
  for (int frame = 0; frame < in.motion.frame_count; ++frame)
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const auto joint = static_cast<std::size_t>(bodies[b].joint);
      const Rigid& now = in.world_at(frame)[joint];
      const bool rests = frame > 0 && now == in.world_at(frame - 1)[joint];
      if (!rests) margins[b] = heights.of(bodies[b], now) + kSink_m;
      fold.report(static_cast<int>(b), frame, margins[b]);
    }
}

ClipCheckResult ground_penetration_in_clip(const ClipInput& in) { return judge_feet_in_clip(in, FootCheck::sink); }

}  // namespace contort
