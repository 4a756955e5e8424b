// Compares signed_distance with FCL, for all sixteen pairs of cores. FCL iterates, and is sometimes wrong. It has two
// solvers: if libccd's differs from ours, FCL's own is used; if that differs too, descent (solids.h), which shares no
// code with any of them, must agree with ours. Such pairs are counted. FCL's distance of overlapping solids is not
// used, because its penetration can abort the process; its contacts give the depth in some direction, which is never
// less than the least.
#ifdef CONTORT_HAS_FCL

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>
#include <gtest/gtest.h>

#include <iostream>
#include <limits>
#include <memory>
#include <vector>

#include "tests/geometry/solids.h"

namespace contort {

namespace {

using namespace test_solids;

fcl::Vector3d to_fcl(const Vec3& v) { return {v.x, v.y, v.z}; }

fcl::Transform3d to_fcl(const Mat3& axes, const Vec3& center) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) pose.linear()(row, column) = axes[column][row];
  pose.translation() = to_fcl(center);
  return pose;
}

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Solid& s) {
  const double length = 2.0 * s.half_length_m;
  if (s.core == Core::point || (s.core == Core::segment && length == 0.0))
    return std::make_shared<fcl::Sphered>(s.radius_m);
  if (s.core == Core::segment) return std::make_shared<fcl::Capsuled>(s.radius_m, length);
  if (s.core == Core::box) return std::make_shared<fcl::Boxd>(to_fcl(2.0 * s.half_m));
  auto corners = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3& corner : s.hull->corners_m) corners->push_back(to_fcl(corner));
  auto faces = std::make_shared<std::vector<int>>();
  for (const Polyhedron::Face& face : s.hull->faces) {
    faces->push_back(face.count);
    for (int i = 0; i < face.count; ++i) faces->push_back(s.hull->loops[static_cast<std::size_t>(face.first + i)]);
  }
  return std::make_shared<fcl::Convexd>(corners, static_cast<int>(s.hull->faces.size()), faces);
}

fcl::Transform3d pose_of(const Solid& s) {
  if (s.core != Core::segment) return to_fcl(s.axes, s.center_m);
  const Vec3 x = perpendicular(s.axis);
  return to_fcl(Mat3(x, glm::cross(s.axis, x), s.axis), s.center_m);
}

struct Known {  // in its own frame, with FCL's counterpart
  Solid solid;
  std::shared_ptr<fcl::CollisionGeometryd> geometry;
};

struct Posed {
  Solid solid;
  const fcl::CollisionGeometryd* geometry;
  fcl::Transform3d pose;
};

// Building a hull takes far longer than measuring it, so solids are drawn from a stock and posed anew for each pair.
class Stock {
 public:
  Stock(Random& random, Core core) {
    for (int i = 0; i < 200; ++i) {
      Solid solid = random_solid(random, core);
      solid.center_m = Vec3(0.0);
      known_.push_back({solid, geometry_of(solid)});
    }
  }
  Posed draw(Random& random, double spread_m) const {
    const Known& one = known_[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(known_.size())))];
    const Solid solid = moved(random.rigid(spread_m), one.solid);
    return {solid, one.geometry.get(), pose_of(solid)};
  }

 private:
  std::vector<Known> known_;
};

double fcl_distance(const Posed& a, const Posed& b, fcl::GJKSolverType solver) {
  fcl::DistanceRequestd request;
  request.enable_nearest_points = true;  // without them, pairs of capsules are measured less exactly
  request.gjk_solver_type = solver;
  request.distance_tolerance = 1e-12;
  fcl::DistanceResultd result;
  fcl::distance(a.geometry, a.pose, b.geometry, b.pose, request, result);
  return result.min_distance;
}

// The depth of the deepest contact.
double fcl_depth(const Posed& a, const Posed& b) {
  fcl::CollisionRequestd request(8, true);
  request.gjk_solver_type = fcl::GST_LIBCCD;
  request.gjk_tolerance = 1e-12;
  fcl::CollisionResultd result;
  fcl::collide(a.geometry, a.pose, b.geometry, b.pose, request, result);
  double depth = 0.0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, result.getContact(i).penetration_depth);
  return depth;
}

struct Tally {
  int apart = 0, libccd_off = 0, both_off = 0, overlapping = 0, same_depth = 0, deeper_in_fcl = 0, fcl_too_shallow = 0;
  double worst_apart = 0.0;
};

// Descent has the last word, given time to converge.
void decide_apart(const Posed& a, const Posed& b, double ours) {
  const double core = ours + a.solid.radius_m + b.solid.radius_m;
  const Sum difference = difference_of_cores(a.solid, b.solid);
  Bounds truth = distance_bounds(difference, 1000);
  for (int sweeps = 10000; truth.high - truth.low > 1e-9 && sweeps <= 1000000; sweeps *= 10)
    truth = distance_bounds(difference, sweeps);
  ASSERT_LE(truth.high - truth.low, 1e-9) << "undecided";
  ASSERT_GE(core, truth.low - 1e-12);
  ASSERT_LE(core, truth.high + 1e-12);
}

void compare_apart(const Posed& a, const Posed& b, double ours, Tally& tally) {
  ++tally.apart;
  for (const fcl::GJKSolverType solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
    const double off = std::fabs(fcl_distance(a, b, solver) - ours);
    if (off <= 1e-9) return void(tally.worst_apart = std::max(tally.worst_apart, off));
    ++(solver == fcl::GST_LIBCCD ? tally.libccd_off : tally.both_off);
  }
  decide_apart(a, b, ours);
}

// No direction of FCL's may need less than ours, but for the error of its own: spheres and capsules 1e-6, else 1e-4.
void compare_depth(const Posed& a, const Posed& b, double ours, Random& random, Tally& tally) {
  ++tally.overlapping;
  const bool is_round = a.solid.core < Core::box && b.solid.core < Core::box;
  const bool has_closed_form = is_round && (a.solid.core == Core::point || b.solid.core == Core::point);
  const double tolerance = is_round || a.solid.core == Core::point || b.solid.core == Core::point ? 1e-6 : 1e-4;
  const double theirs = fcl_depth(a, b);
  if (std::fabs(theirs + ours) <= tolerance) return void(++tally.same_depth);
  ASSERT_FALSE(has_closed_form) << theirs << " and " << -ours;
  if (theirs + ours > 0.0 && tally.deeper_in_fcl++ % 50 != 0) return;
  tally.fcl_too_shallow += theirs + ours < 0.0;
  Sum difference = difference_of_cores(a.solid, b.solid);
  const double radii = a.solid.radius_m + b.solid.radius_m;
  if (ours + radii > 1e-3) return decide_apart(a, b, ours);  // the cores are apart
  if (difference.generators.size() < 3 && difference.means.empty()) return;
  double sampled = std::numeric_limits<double>::infinity();  // too much where no start led to the least of all minima
  for (int starts = 40; starts <= 40000 && sampled > -ours + 1e-4; starts *= 10)
    sampled = sampled_depth(difference, random, starts) + radii;
  ASSERT_GE(sampled, -ours - 1e-9);
  ASSERT_LE(sampled, -ours + 1e-4);
}

void compare_with_fcl(int pairs_of_each_kind) {
  Random random(2026);
  std::vector<Stock> stocks;
  for (const Core core : kCores) stocks.emplace_back(random, core);
  for (const Core core_a : kCores)
    for (const Core core_b : kCores) {
      Tally tally;
      for (int i = 0; i < pairs_of_each_kind && !testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE(std::string(name_of(core_a)) + " and " + name_of(core_b) + ", pair " + std::to_string(i));
        const Posed a = stocks[static_cast<std::size_t>(core_a)].draw(random, 0.25);
        const Posed b = stocks[static_cast<std::size_t>(core_b)].draw(random, 0.25);
        const double ours = signed_distance(a.solid, b.solid, kNoBand);
        if (ours > 0.0)
          compare_apart(a, b, ours, tally);
        else
          compare_depth(a, b, ours, random, tally);
      }
      std::cout << name_of(core_a) << "-" << name_of(core_b) << ": apart " << tally.apart << ", libccd off in "
                << tally.libccd_off << ", and FCL's own solver too in " << tally.both_off << ", else within "
                << tally.worst_apart << " m; overlapping " << tally.overlapping << ", same depth " << tally.same_depth
                << ", deeper in FCL " << tally.deeper_in_fcl << ", shallower " << tally.fcl_too_shallow << "\n";
      EXPECT_LE(tally.libccd_off, 2 + tally.apart / 100);
      EXPECT_LE(tally.both_off, 1 + tally.apart / 10000);
    }
}

TEST(DistanceAgainstFcl, AgreesWhereApartAndIsNeverDeeper) { compare_with_fcl(1000); }

TEST(DistanceAgainstFclSlow, AgreesInAMillionPairs) { compare_with_fcl(62500); }

}  // namespace

}  // namespace contort

#endif  // CONTORT_HAS_FCL
