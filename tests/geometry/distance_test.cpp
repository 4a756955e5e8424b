// signed_distance against laws and brute force, for all sixteen pairs of cores.
#include "model/geometry/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/geometry/solids.h"

namespace contort {

namespace {

using namespace test_solids;

struct PairOfCores {
  Core a, b;
};

class DistanceOf : public testing::TestWithParam<PairOfCores> {
 protected:
  Solid draw_a() { return draw(GetParam().a); }
  Solid draw_b() { return draw(GetParam().b); }
  // Building a hull takes far longer than measuring it: drawn from a stock, and placed anew.
  Solid draw(Core core) {
    if (core != Core::hull) return random_solid(random_, core);
    static const std::vector<Solid> stock = [] {
      Random random(77);
      std::vector<Solid> hulls;
      for (int i = 0; i < 300; ++i) {
        hulls.push_back(random_solid(random, Core::hull));
        hulls.back().center_m = Vec3(0.0);
      }
      return hulls;
    }();
    const Solid& one = stock[static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(stock.size())))];
    return moved(random_.rigid(0.25), one);
  }
  static double exact(const Solid& a, const Solid& b) { return signed_distance(a, b, kNoBand); }
  Random random_{0x5eed + 3 * static_cast<std::uint64_t>(GetParam().a) + static_cast<std::uint64_t>(GetParam().b)};
};

Solid shifted(Solid solid, const Vec3& by) {
  solid.center_m += by;
  return solid;
}

// Worst measured over 20 000 pairs of each kind: 5e-16.
TEST_P(DistanceOf, DoesNotDependOnTheOrder) {
  for (int i = 0; i < 2000; ++i) {
    const Solid a = draw_a(), b = draw_b();
    ASSERT_NEAR(exact(a, b), exact(b, a), 1e-12) << "pair " << i;
  }
}

// Worst measured over 20 000 pairs of each kind: 1.1e-15.
TEST_P(DistanceOf, DoesNotChangeWhenBothMoveTogether) {
  for (int i = 0; i < 2000; ++i) {
    const Solid a = draw_a(), b = draw_b();
    const Rigid move = random_.rigid(2.0);
    ASSERT_NEAR(exact(moved(move, a), moved(move, b)), exact(a, b), 1e-12) << "pair " << i;
  }
}

TEST_P(DistanceOf, ChangesByNoMoreThanTheTranslation) {
  for (int i = 0; i < 2000; ++i) {
    const Solid a = draw_a(), b = draw_b();
    const double size = i % 2 == 0 ? 1e-6 : 0.1;
    const Vec3 by = random_.direction() * size;
    ASSERT_LE(std::fabs(exact(shifted(a, by), b) - exact(a, b)), size + 1e-12) << "pair " << i;
  }
}

// The oracle brackets the true distance; where the bracket is wider than 1e-9, descent had not converged yet.
TEST_P(DistanceOf, ApartAgreesWithDescent) {
  int tight = 0, apart = 0;
  for (int i = 0; i < 600; ++i) {
    const Solid a = draw_a(), b = shifted(draw_b(), random_.in_cube(0.5));
    const double core = exact(a, b) + a.radius_m + b.radius_m;
    const Bounds truth = distance_bounds(difference_of_cores(a, b), 400);
    if (truth.low <= 0.0) continue;
    ++apart;
    tight += truth.high - truth.low < 1e-9;
    ASSERT_GE(core, truth.low - 1e-12) << "pair " << i;
    ASSERT_LE(core, truth.high + 1e-12) << "pair " << i;
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(tight, apart * 9 / 10);  // measured: 99.4 % and more
}

bool is_flat(const Sum& z) {  // no volume: cores that cross have depth 0
  return z.generators.size() < 3 && z.means.empty();
}

// Worst measured of 1500 overlapping pairs: 4.7e-6 more than computed, never less.
TEST_P(DistanceOf, OverlappingNeedsNoLessInAnyDirectionAndNoMoreInTheBest) {
  int overlapping = 0;
  const bool has_hull = GetParam().a == Core::hull || GetParam().b == Core::hull;
  for (int i = 0; i < (has_hull ? 90 : 30); ++i) {
    const Solid a = draw_a();
    Solid b = draw_b();
    b.center_m = a.center_m + random_.in_cube(0.12);
    const Sum z = difference_of_cores(a, b);
    if (is_flat(z) || distance_bounds(z, 400).high > 1e-7) continue;
    ++overlapping;
    const double depth = -(exact(a, b) + a.radius_m + b.radius_m);
    const double sampled = sampled_depth(z, random_, 40);
    ASSERT_GE(sampled, depth - 1e-9) << "pair " << i;
    ASSERT_LE(sampled, depth + 1e-4) << "pair " << i;
  }
  const bool solid = GetParam().a == Core::box || GetParam().b == Core::box || has_hull;
  EXPECT_EQ(overlapping > 10, solid) << overlapping;
}

TEST_P(DistanceOf, WithABandIsExactBelowItAndNeverTooFarAboveIt) {
  int beyond = 0;
  for (int i = 0; i < 3000; ++i) {
    const Solid a = draw_a(), b = shifted(draw_b(), random_.in_cube(0.4));
    const double truth = exact(a, b);
    const double band = random_.uniform(-0.1, 0.2);
    const double got = signed_distance(a, b, band);
    beyond += truth > band;
    if (truth <= band) {
      ASSERT_NEAR(got, truth, 1e-12) << "pair " << i;
    } else {
      ASSERT_GT(got, band) << "pair " << i;
      ASSERT_LE(got, truth + 1e-12) << "pair " << i;
    }
  }
  EXPECT_GT(beyond, 300);
}

// Along the way out the two are apart by their distance: of boxes that are apart, by something of it.
TEST_P(DistanceOf, TheWayOutIsADirectionThatPartsThem) {
  const bool has_hull = GetParam().a == Core::hull || GetParam().b == Core::hull;
  const bool has_box = GetParam().a == Core::box || GetParam().b == Core::box;
  int known = 0;
  for (int i = 0; i < 1000; ++i) {
    const Solid a = draw_a(), b = shifted(draw_b(), random_.in_cube(0.4));
    Vec3 way;
    const double distance = signed_distance(a, b, kNoBand, way), radii = a.radius_m + b.radius_m;
    ASSERT_EQ(distance, exact(a, b)) << "pair " << i;
    ASSERT_EQ(has_hull, way == Vec3(0.0)) << "pair " << i;
    if (way == Vec3(0.0)) continue;
    ++known;
    ASSERT_NEAR(glm::dot(way, way), 1.0, 1e-12) << "pair " << i;
    const double gap = gap_along(a, b, way);
    ASSERT_LE(gap, distance + 1e-12) << "pair " << i;
    if (has_box && distance + radii > 0.0)
      ASSERT_GT(gap, -radii) << "pair " << i;
    else
      ASSERT_NEAR(gap, distance, 1e-12) << "pair " << i;
  }
  EXPECT_EQ(known, has_hull ? 0 : 1000);
}

Solid scaled(Solid solid, double by) {
  for (Vec3* v : {&solid.center_m, &solid.half_m}) *v *= by;
  solid.half_length_m *= by, solid.radius_m *= by, solid.bound_m *= by;
  if (solid.hull != nullptr) {
    Polyhedron hull = *solid.hull;
    for (Vec3& corner : hull.corners_m) corner *= by;
    solid.hull = std::make_shared<Polyhedron>(std::move(hull));
  }
  return solid;
}

// A small solid must not be treated as no solid. Worst measured: 3.3e-16; it was 0.13 at 1e-6 when an axis of two tiny
// half sides was dropped.
TEST_P(DistanceOf, ScalesWithTheSolids) {
  for (const double by : {1e-6, 1e-3, 1e3})
    for (int i = 0; i < 500; ++i) {
      const Solid a = draw_a(), b = shifted(draw_b(), random_.in_cube(0.3));
      ASSERT_NEAR(exact(scaled(a, by), scaled(b, by)) / by, exact(a, b), 1e-12) << by << " pair " << i;
    }
}

TEST_P(DistanceOf, IsNaNWhereACentreIsNotFinite) {
  const Solid a = draw_a(), b = draw_b();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by(0.0);
      by[axis] = bad;
      EXPECT_TRUE(std::isnan(exact(shifted(a, by), b)));
      EXPECT_TRUE(std::isnan(exact(a, shifted(b, by))));
    }
}

TEST_P(DistanceOf, IsNaNWhereARotationIsNotFinite) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const Rigid broken{Quat(bad, 0, 0, 0), Vec3(0.0)};
  const Solid a = draw_a(), b = draw_b();
  EXPECT_TRUE(std::isnan(exact(moved(broken, a), b)));
  EXPECT_TRUE(std::isnan(exact(a, moved(broken, b))));
}

TEST_P(DistanceOf, IsNeverMoreThanTheBoundingBallsSayNorLess) {
  for (int i = 0; i < 2000; ++i) {
    const Solid a = draw_a(), b = shifted(draw_b(), random_.in_cube(0.3));
    const Vec3 d = a.center_m - b.center_m;
    const double between = std::sqrt(glm::dot(d, d));
    ASSERT_GE(exact(a, b), between - a.bound_m - b.bound_m - 1e-12);
    ASSERT_LE(exact(a, b), between + 1e-12);
  }
}

std::vector<PairOfCores> all_pairs() {
  std::vector<PairOfCores> pairs;
  for (const Core a : kCores)
    for (const Core b : kCores) pairs.push_back({a, b});
  return pairs;
}

std::string pair_name(const testing::TestParamInfo<PairOfCores>& info) {
  return std::string(name_of(info.param.a)) + "_" + name_of(info.param.b);
}

INSTANTIATE_TEST_SUITE_P(AllCores, DistanceOf, testing::ValuesIn(all_pairs()), pair_name);

}  // namespace

}  // namespace contort
