// Distances that can be worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "model/geometry/distance.h"

namespace contort {

namespace {

constexpr double kNoBand = 1e9;
const double kRoot2 = std::sqrt(2.0);

double between(const ColliderShape& a, const ColliderShape& b) {
  const double there = signed_distance(solid_of(a), solid_of(b), kNoBand);
  EXPECT_NEAR(signed_distance(solid_of(b), solid_of(a), kNoBand), there, 1e-12);
  return there;
}

Box cube(const Vec3& center, const Vec3& rotation_deg = Vec3(0.0)) { return {center, Vec3(0.5), rotation_deg}; }

TEST(DistanceExemplars, BoxFaceToFace) {
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({1.25, 0.3, -0.2})), 0.25, 1e-15);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({0.9, 0.3, -0.2})), -0.1, 1e-15);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({1.0, 0.3, -0.2})), 0.0, 1e-15);
}

TEST(DistanceExemplars, BoxEdgeToEdgeAndCornerToCorner) {
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({1.3, 1.4, 0.2})), 0.5, 1e-15);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({1.2, 1.3, 1.6})), 0.7, 1e-15);
}

TEST(DistanceExemplars, BoxEdgeAgainstAFace) {
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({2, 0, 0}, {0, 0, 45})), 1.5 - 0.5 * kRoot2, 1e-12);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({1.1, 0, 0}, {0, 0, 45})), 0.6 - 0.5 * kRoot2, 1e-12);
}

TEST(DistanceExemplars, CrossedEdgesOfTwoBoxes) {  // both stand on edges at right angles to each other, one above
  const double top = 0.5 * kRoot2;
  for (const double gap : {0.3, -0.05}) {
    const double height = 2.0 * top + gap;
    EXPECT_NEAR(between(cube({0, 0, 0}, {0, 0, 45}), cube({0, height, 0}, {45, 0, 0})), gap, 1e-12) << gap;
  }
}

TEST(DistanceExemplars, BoxCornerAgainstAFace) {
  const double tilt_deg = std::atan(kRoot2) * kDegPerRad;  // brings a cube's diagonal upright
  const Vec3 about = Vec3(1, 0, -1) / kRoot2 * tilt_deg;
  const double tip = 0.5 * std::sqrt(3.0);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({0, 0.5 + tip + 0.2, 0}, -about)), 0.2, 1e-12);
  EXPECT_NEAR(between(cube({0, 0, 0}), cube({0, 0.5 + tip - 0.04, 0}, -about)), -0.04, 1e-12);
}

TEST(DistanceExemplars, BoxWithinABox) {
  EXPECT_NEAR(between(cube({0, 0, 0}), Box{{0.2, 0, 0}, Vec3(0.1), {}}), -0.4, 1e-15);
}

TEST(DistanceExemplars, CapsuleThroughABoxCountsTheShortWayOutAndItsRadius) {
  const Box slab{{0, 0, 0}, {0.5, 0.1, 0.5}, {}};
  const Capsule lying{{-2, 0.04, 0}, {2, 0.04, 0}, 0.03};  // out through the top: 0.06
  EXPECT_NEAR(between(slab, lying), -0.06 - 0.03, 1e-15);
  const Capsule upright{{0.45, -2, 0}, {0.45, 2, 0}, 0.03};  // out through the side: 0.05
  EXPECT_NEAR(between(slab, upright), -0.05 - 0.03, 1e-15);
  const Capsule above{{-2, 0.3, 0}, {2, 0.3, 0}, 0.03};
  EXPECT_NEAR(between(slab, above), 0.2 - 0.03, 1e-15);
}

TEST(DistanceExemplars, CapsulePastABoxEdge) {
  const Capsule diagonal{{0.5 + 0.6, 0.5 + 0.6, -2}, {0.5 + 0.6, 0.5 + 0.6, 2}, 0.1};
  EXPECT_NEAR(between(cube({0, 0, 0}), diagonal), 0.6 * kRoot2 - 0.1, 1e-12);
}

TEST(DistanceExemplars, ParallelCapsules) {
  const Capsule one{{0, 0, 0}, {1, 0, 0}, 0.1};
  EXPECT_NEAR(between(one, Capsule{{0.2, 0.5, 0}, {0.7, 0.5, 0}, 0.1}), 0.3, 1e-15);   // side by side
  EXPECT_NEAR(between(one, Capsule{{1.3, 0.4, 0}, {2.0, 0.4, 0}, 0.1}), 0.3, 1e-15);   // beyond each other
  EXPECT_NEAR(between(one, Capsule{{2.0, 0.4, 0}, {1.3, 0.4, 0}, 0.1}), 0.3, 1e-15);   // against each other
  EXPECT_NEAR(between(one, Capsule{{0.2, 0.0, 0}, {0.7, 0.0, 0}, 0.1}), -0.2, 1e-15);  // one within the other
}

TEST(DistanceExemplars, NearlyParallelCapsules) {
  const Capsule one{{-1, 0, 0}, {1, 0, 0}, 0.05};
  for (const double tilt : {1e-4, 1e-6, 1e-7, 1e-8, 1e-10}) {  // they touch the plane y = 0.3 at one end
    const Capsule other{{-1, 0.3, 0}, {1, 0.3 + tilt, 0}, 0.05};
    EXPECT_NEAR(between(one, other), 0.2, 1e-12) << tilt;
  }
}

TEST(DistanceExemplars, CrossingCapsulesAreAsDeepAsTheirRadii) {
  EXPECT_NEAR(between(Capsule{{-1, 0, 0}, {1, 0, 0}, 0.1}, Capsule{{0, -1, 0}, {0, 1, 0}, 0.2}), -0.3, 1e-15);
}

TEST(DistanceExemplars, ACapsuleWithoutLengthIsASphere) {
  const Capsule ball{{0.3, 0.9, 0}, {0.3, 0.9, 0}, 0.1};
  const Sphere sphere{{0.3, 0.9, 0}, 0.1};
  const Capsule rod{{-1, 0, 0}, {1, 0, 0}, 0.05};
  EXPECT_NEAR(between(ball, rod), between(sphere, rod), 1e-15);
  EXPECT_NEAR(between(ball, ball), -0.2, 1e-15);
  EXPECT_NEAR(between(ball, cube({0, 0, 0})), between(sphere, cube({0, 0, 0})), 1e-15);
  EXPECT_NEAR(between(sphere, cube({0, 0, 0})), 0.3, 1e-15);
}

TEST(DistanceExemplars, SphereWithinABoxCountsTheShortWayOut) {
  EXPECT_NEAR(between(Sphere{{0.3, 0, 0}, 0.1}, cube({0, 0, 0})), -0.3, 1e-15);
  EXPECT_NEAR(between(Sphere{{0, 0, 0}, 0.1}, Sphere{{0, 0, 0}, 0.2}), -0.3, 1e-15);
}

// A box of 10 micrometres stands on its edge beside a large one. The separating direction is the normal of a face of
// the small box.
TEST(DistanceExemplars, TinyBoxesAreMeasuredAsWellAsLargeOnes) {
  for (const double size : {1.0, 1e-3, 1e-5, 1e-7}) {
    const Box tall{{0, 0, 0}, {0.5 * size, 5 * size, 5 * size}, {0, 0, 45}};
    const Vec3 out = Vec3(1, 1, 0) / kRoot2;
    const Box other{out * size * (0.5 + kRoot2 * 0.5 + 0.25), Vec3(0.5 * size), {}};
    EXPECT_NEAR(between(tall, other) / size, 0.25, 1e-9) << size;
  }
}

TEST(DistanceExemplars, AMirroredCopyIsAsFarAway) {
  const Box a{{0.1, 0.2, 0.3}, {0.1, 0.2, 0.05}, {10, 20, 30}};
  const Capsule b{{0.3, 0.6, 0.3}, {0.5, 0.4, 0.1}, 0.03};
  EXPECT_NEAR(between(mirrored(ColliderShape(a)), mirrored(ColliderShape(b))), between(a, b), 1e-15);
}

}  // namespace

}  // namespace contort
