// Compares signed distances of 171 pairs of 19 capsules, each time in another pose, with FCL (double) and Bullet
// (float) if these are installed: all pairs at once, with each kind of instructions of the machine, and one pair at a
// time. Slices of both alternate in one process; medians are printed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/side_by_side.h"
#include "model/geometry/distance.h"
#include "model/geometry/round_distances.h"

#ifdef CONTORT_HAS_FCL
#include <fcl/narrowphase/distance.h>
#endif
#ifdef CONTORT_HAS_BULLET
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <btBulletCollisionCommon.h>
#endif

namespace contort {

namespace {

constexpr int kCapsules = 19, kPoses = 256;

using Pose = std::vector<Solid>;

std::vector<Pose> random_poses() {
  std::mt19937_64 engine(1);
  const auto uniform = [&](double half) { return half * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0); };
  const auto in_cube = [&](double half) {
    const double x = uniform(half), y = uniform(half), z = uniform(half);
    return Vec3(x, y, z);
  };
  std::vector<Pose> poses(kPoses);
  for (int i = 0; i < kCapsules; ++i) {
    const Vec3 first = in_cube(0.15);
    const double half_length_m = std::sqrt(glm::dot(first, first));
    for (Pose& pose : poses) {
      const Vec3 center = in_cube(0.7), half = half_length_m * unit_or(in_cube(1.0), Vec3(1, 0, 0));
      pose.push_back(solid_of(Capsule{center - half, center + half, 0.05}));
    }
  }
  return poses;
}

// The fields that differ from pose to pose, by capsule.
struct Place {
  Vec3 center_m, axis;
};

std::vector<Place> spec_fields_of(const Pose& pose) {
  std::vector<Place> places;
  for (const Solid& capsule : pose) places.push_back({capsule.center_m, capsule.axis});
  return places;
}

// All pairs of the same capsules, pose by pose.
class AllPairs {
 public:
  AllPairs(Pose capsules, const RoundKernel& kernel) : capsules_(std::move(capsules)), kernel_(kernel) {
    for (int a = 0; a < kCapsules; ++a)
      for (int b = a + 1; b < kCapsules; ++b) pairs_.push_back({a, b});
    distances_m_.resize(pairs_.size());
  }

  double least_at(const std::vector<Place>& places) {
    for (std::size_t i = 0; i < capsules_.size(); ++i)
      capsules_[i].center_m = places[i].center_m, capsules_[i].axis = places[i].axis;
    round_distances(capsules_, pairs_, distances_m_, kernel_);
    double least = 1e9;
    for (std::size_t first = 0, count = kCapsules - 1; count > 0;
         first += count--)  // rows are independent of each other
      least = std::min(least, std::ranges::min(std::span(distances_m_).subspan(first, count)));
    return least;
  }

 private:
  Pose capsules_;
  const RoundKernel& kernel_;
  std::vector<ColliderPair> pairs_;
  std::vector<double> distances_m_;
};

double least_of_pairs(const Pose& pose) {
  double least = 1e9;
  for (std::size_t i = 0; i < pose.size(); ++i)
    for (std::size_t k = i + 1; k < pose.size(); ++k) least = std::min(least, signed_distance(pose[i], pose[k], 1e9));
  return least;
}

using Measure = std::function<double(int pose)>;

// Returns microseconds for a pose. `sum` keeps the compiler from removing the work.
double slice(const Measure& measure, double& sum) {
  const double start = thread_time_s();
  for (int pose = 0; pose < kPoses; ++pose) sum += measure(pose);
  return 1e6 * (thread_time_s() - start) / kPoses;
}

void compare(const std::string& name, const char* peer_name, const Measure& ours, const Measure& peer) {
  std::vector<double> own_us, peer_us, ratios;
  double own_sum = 0.0, peer_sum = 0.0;
  for (int i = 0; i < 101; ++i) {
    own_us.push_back(slice(ours, own_sum)), peer_us.push_back(slice(peer, peer_sum));
    ratios.push_back(own_us.back() / peer_us.back());
  }
  std::printf("%s: %.2f us, %s %.2f us, ratio %.3f; mean of least distances %.9f and %.9f m\n", name.c_str(),
              median(own_us), peer_name, median(peer_us), median(ratios), own_sum / (101 * kPoses),
              peer_sum / (101 * kPoses));
}

Mat3 axes_of(const Solid& capsule) {
  const Vec3 z = capsule.axis, x = perpendicular(z);
  return Mat3(x, glm::cross(z, x), z);
}

double full_length(const Solid& capsule) { return 2.0 * capsule.half_length_m; }

#ifdef CONTORT_HAS_FCL
struct FclPose {
  std::vector<fcl::Capsuled> shapes;
  std::vector<fcl::Transform3d> places;
};

FclPose to_fcl(const Pose& pose) {
  FclPose out;
  for (const Solid& solid : pose) {
    fcl::Transform3d place = fcl::Transform3d::Identity();
    const Mat3 axes = axes_of(solid);
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row) place.linear()(row, column) = axes[column][row];
    place.translation() = fcl::Vector3d(solid.center_m.x, solid.center_m.y, solid.center_m.z);
    out.shapes.emplace_back(solid.radius_m, full_length(solid)), out.places.push_back(place);
  }
  return out;
}

double least_of_fcl(const FclPose& pose) {
  double least = 1e9;
  for (std::size_t i = 0; i < pose.shapes.size(); ++i)
    for (std::size_t k = i + 1; k < pose.shapes.size(); ++k) {
      fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      request.enable_nearest_points = true;
      fcl::distance(&pose.shapes[i], pose.places[i], &pose.shapes[k], pose.places[k], request, result);
      least = std::min(least, result.min_distance);
    }
  return least;
}
#endif

#ifdef CONTORT_HAS_BULLET
struct BulletPose {
  std::vector<std::unique_ptr<btCapsuleShapeZ>> shapes;
  std::vector<btTransform> places;
};

BulletPose to_bullet(const Pose& pose) {
  BulletPose out;
  const auto narrow = [](double v) { return static_cast<btScalar>(v); };
  for (const Solid& solid : pose) {
    const Mat3 m = axes_of(solid);
    const btMatrix3x3 turn(narrow(m[0][0]), narrow(m[1][0]), narrow(m[2][0]), narrow(m[0][1]), narrow(m[1][1]),
                           narrow(m[2][1]), narrow(m[0][2]), narrow(m[1][2]), narrow(m[2][2]));
    out.places.emplace_back(turn,
                            btVector3(narrow(solid.center_m.x), narrow(solid.center_m.y), narrow(solid.center_m.z)));
    out.shapes.push_back(std::make_unique<btCapsuleShapeZ>(narrow(solid.radius_m), narrow(full_length(solid))));
  }
  return out;
}

// Bullet's formula for two capsules is hidden in the algorithm that its dispatcher chooses.
class BulletDistance : public btManifoldResult {
 public:
  BulletDistance() {
    m_closestPointDistanceThreshold = btScalar(1e9);
    for (btCollisionObject* object : {&a_, &b_}) object->setCollisionShape(&any_);
    const btCollisionObjectWrapper a(nullptr, &any_, &a_, a_.getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper b(nullptr, &any_, &b_, b_.getWorldTransform(), -1, -1);
    algorithm_ = dispatcher_.findAlgorithm(&a, &b, nullptr, BT_CLOSEST_POINT_ALGORITHMS);
  }
  ~BulletDistance() override {
    algorithm_->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm_);
  }
  void addContactPoint(const btVector3&, const btVector3&, btScalar depth) override { distance_ = depth; }
  double between(const BulletPose& pose, std::size_t i, std::size_t k) {
    const btCollisionObjectWrapper a(nullptr, pose.shapes[i].get(), &a_, pose.places[i], -1, -1);
    const btCollisionObjectWrapper b(nullptr, pose.shapes[k].get(), &b_, pose.places[k], -1, -1);
    setBody0Wrap(&a), setBody1Wrap(&b);
    algorithm_->processCollision(&a, &b, info_, this);
    return static_cast<double>(distance_);
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDispatcherInfo info_;
  btCapsuleShapeZ any_{btScalar(0.1), btScalar(0.1)};
  btCollisionObject a_, b_;
  btCollisionAlgorithm* algorithm_ = nullptr;
  btScalar distance_ = 0;
};

double least_of_bullet(BulletDistance& distance, const BulletPose& pose) {
  double least = 1e9;
  for (std::size_t i = 0; i < pose.shapes.size(); ++i)
    for (std::size_t k = i + 1; k < pose.shapes.size(); ++k) least = std::min(least, distance.between(pose, i, k));
  return least;
}
#endif

}  // namespace

}  // namespace contort

int main() {
  using namespace contort;
  const std::vector<Pose> poses = random_poses();
  const Measure pairs = [&](int pose) { return least_of_pairs(poses[static_cast<std::size_t>(pose)]); };
  std::vector<std::pair<std::string, Measure>> ours{{"one pair at a time", pairs}};
  std::vector<std::vector<Place>> places;
  for (const Pose& pose : poses) places.push_back(spec_fields_of(pose));
  for (const RoundKernel& kernel : round_kernels()) {
    AllPairs all(poses.front(), kernel);
    ours.emplace_back(kernel.name,
                      [&, all](int pose) mutable { return all.least_at(places[static_cast<std::size_t>(pose)]); });
  }
  compare("one pair at a time", "again", pairs, pairs);
#ifdef CONTORT_HAS_FCL
  std::vector<FclPose> fcl_poses;
  for (const Pose& pose : poses) fcl_poses.push_back(to_fcl(pose));
  for (const auto& [name, own] : ours)
    compare(name, "FCL", own, [&](int pose) { return least_of_fcl(fcl_poses[static_cast<std::size_t>(pose)]); });
#endif
#ifdef CONTORT_HAS_BULLET
  std::vector<BulletPose> bullet_poses;
  for (const Pose& pose : poses) bullet_poses.push_back(to_bullet(pose));
  BulletDistance distance;
  for (const auto& [name, own] : ours)
    compare(name, "Bullet", own,
            [&](int pose) { return least_of_bullet(distance, bullet_poses[static_cast<std::size_t>(pose)]); });
#endif
}
