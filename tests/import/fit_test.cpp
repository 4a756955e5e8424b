#include "import/fit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "model/core/math.h"

namespace contort {
namespace {

double drawn(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000.0; }
Vec3 drawn_vector(double most) {
  const double x = drawn(-most, most), y = drawn(-most, most), z = drawn(-most, most);
  return {x, y, z};
}
Vec3 drawn_direction() { return unit_or(drawn_vector(1.0), Vec3(0, 1, 0)); }

// Points on a capsule, evenly enough.
std::vector<Vec3> surface_of(const Capsule& c) {
  const Vec3 u = unit_or(c.b_m - c.a_m, Vec3(0, 1, 0)), v = perpendicular(u), w = glm::cross(u, v);
  const double straight = length(c.b_m - c.a_m), all = straight + 2.0 * c.radius_m;
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i)
    for (int k = 0; k < 24; ++k) {
      const double along = -c.radius_m + all * (i + 0.5) / 60.0;
      const double beyond = along < 0.0 ? along : std::max(along - straight, 0.0);
      const double radius = std::sqrt(c.radius_m * c.radius_m - beyond * beyond);
      const Vec3 out = std::cos(2.0 * kPi * k / 24.0) * v + std::sin(2.0 * kPi * k / 24.0) * w;
      points.push_back(c.a_m + along * u + radius * out);
    }
  return points;
}

double distance(const Capsule& c, const Vec3& p) {
  const Vec3 along = c.b_m - c.a_m;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(p - c.a_m, along) / square, 0.0, 1.0) : 0.0;
  return length(p - c.a_m - t * along) - c.radius_m;
}

RC_GTEST_PROP(FitCapsules, FindACapsuleThatIsThere, ()) {
  const double radius = drawn(0.02, 0.2), straight = drawn(1.0, 6.0) * radius;
  const Vec3 a = drawn_vector(1.0), u = drawn_direction();
  const std::vector<Vec3> points = surface_of({a, a + straight * u, radius});
  const std::vector<Capsule> found = fit_capsules(points, u, 1e-3);
  RC_ASSERT(found.size() <= 2U);
  for (const Capsule& capsule : found) RC_ASSERT(std::fabs(capsule.radius_m / radius - 1.0) < 0.1);
  for (const Vec3& p : points) {
    double nearest = 1e9;
    for (const Capsule& capsule : found) nearest = std::min(nearest, std::fabs(distance(capsule, p)));
    RC_ASSERT(nearest < 0.25 * radius);  // 4 % of the points, at the ends, do not count
  }
}

TEST(FitCapsules, AFlatBoardIsFilledSideBySide) {
  std::vector<Vec3> points;
  for (int x = -10; x <= 10; ++x)
    for (int y = -10; y <= 10; ++y)
      for (const double z : {-0.02, 0.02}) points.push_back({0.01 * x, 0.02 * y, z});
  const std::vector<Capsule> found = fit_capsules(points, Vec3(0, 1, 0), 1e-3);
  ASSERT_EQ(found.size(), 4U);
  for (const Capsule& capsule : found) {
    EXPECT_NEAR(capsule.radius_m, 0.025, 0.006);
    EXPECT_NEAR(std::fabs(capsule.b_m.y - capsule.a_m.y), 0.4 - 2 * capsule.radius_m, 0.03);
  }
}

TEST(FitCapsules, OnePointAndOneLineAreStillSolid) {
  const std::vector<Capsule> dot = fit_capsules({Vec3(1, 2, 3)}, Vec3(0, 1, 0), 0.01);
  ASSERT_EQ(dot.size(), 1U);
  EXPECT_EQ(dot[0], (Capsule{{1, 2, 3}, {1, 2, 3}, 0.01}));
  for (const Capsule& c : fit_capsules({Vec3(0, 0, 0), Vec3(0, 1, 0)}, Vec3(0, 1, 0), 0.01))
    EXPECT_GE(c.radius_m, 0.01);
  EXPECT_TRUE(fit_capsules({}, Vec3(0, 1, 0), 0.01).empty());
}

RC_GTEST_PROP(Eigen, VectorsAreEigenvectorsInFallingOrder, ()) {
  Mat3 m(0.0);
  for (int i = 0; i < 4; ++i) {
    const Vec3 v = drawn_vector(2.0);
    m += glm::outerProduct(v, v);
  }
  const Eigen3 e = eigen_of(m);
  for (std::size_t i = 0; i < 3; ++i) {
    RC_ASSERT(length(m * e.vectors[i] - e.values[i] * e.vectors[i]) < 1e-9);
    RC_ASSERT(std::fabs(length(e.vectors[i]) - 1.0) < 1e-12);
    if (i > 0) RC_ASSERT(e.values[i] <= e.values[i - 1] + 1e-12);
    if (i > 0) RC_ASSERT(std::fabs(glm::dot(e.vectors[i], e.vectors[i - 1])) < 1e-9);
  }
}

// Against a cloud of points inside.
RC_GTEST_PROP(CapsuleInertia, IsThatOfASolid, ()) {
  const Capsule c{drawn_vector(0.5), drawn_vector(0.5), drawn(0.2, 0.3)};
  const double box = 1.0, step = 0.035;
  double volume = 0.0;
  Mat3 moments(0.0);
  const BodyInertia body = inertia_of(c, 2.0);
  for (double x = -box; x < box; x += step)
    for (double y = -box; y < box; y += step)
      for (double z = -box; z < box; z += step) {
        const Vec3 p(x, y, z), r = p - body.center_m;
        if (distance(c, p) > 0.0) continue;
        volume += step * step * step;
        moments += step * step * step * (glm::dot(r, r) * Mat3(1.0) - glm::outerProduct(r, r));
      }
  RC_ASSERT(std::fabs(volume / volume_m3(c) - 1.0) < 0.06);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      RC_ASSERT(std::fabs(2.0 / volume * moments[i][k] - body.inertia_kg_m2[i][k]) <
                0.06 * body.inertia_kg_m2[i][i] + 0.01);
}

}  // namespace
}  // namespace contort
