#include "import/fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/core/math.h"

namespace contort {

namespace {

// Fraction of the points that is ignored at either end: stray vertices, ribbons, fingertips.
constexpr double kTrimmed = 0.02;
constexpr int kSideBySide = 4;
constexpr double kFlat = 1.5;  // from this ratio of width to depth on, capsules are placed side by side
constexpr double kLong = 2.5;  // from this ratio of length to width on, capsules are placed one after another

struct Range {
  double low = 0.0;
  double high = 0.0;
};

Range range_along(const std::vector<Vec3>& points, const Vec3& axis) {
  std::vector<double> values;
  values.reserve(points.size());
  for (const Vec3& p : points) values.push_back(glm::dot(p, axis));
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(kTrimmed * static_cast<double>(values.size()));
  return {values[cut], values[values.size() - 1 - cut]};
}

FittedBox box_along(const std::vector<Vec3>& points, const std::array<Vec3, 3>& axes) {
  std::array<double, 3> half{};
  FittedBox out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Range range = range_along(points, axes[i]);
    half[i] = 0.5 * (range.high - range.low);
    out.center_m += 0.5 * (range.high + range.low) * axes[i];
  }
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return half[a] > half[b]; });
  for (std::size_t i = 0; i < 3; ++i) out.axes[i] = axes[order[i]], out.half_m[i] = half[order[i]];
  return out;
}

Mat3 covariance(const std::vector<Vec3>& points) {
  Vec3 mean(0.0);
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 sum(0.0);
  for (const Vec3& p : points) sum += glm::outerProduct(p - mean, p - mean);
  return sum;
}

double size_of(const FittedBox& box, double least) {
  double product = 1.0;
  for (const double half : box.half_m) product *= std::max(half, least);
  return product;
}

// Fills one piece of a body, in the axes of the whole body: one capsule along its longest side, or several side by
// side.
void fill(const FittedBox& box, double least_radius_m, int most, std::vector<Capsule>& out) {
  const double width = std::max(box.half_m[1], least_radius_m), depth = std::max(box.half_m[2], least_radius_m);
  const bool is_flat = width > kFlat * depth;
  const int count = is_flat ? std::clamp(static_cast<int>(std::lround(width / depth)), 2, most) : 1;
  const double radius = is_flat ? std::max(depth, width / (2.0 * count)) : 0.5 * (width + depth);
  const double straight = std::max(box.half_m[0] - radius, 0.0), aside = std::max(width - radius, 0.0);
  for (int i = 0; i < count; ++i) {
    const double place = count == 1 ? 0.0 : aside * (2.0 * i / (count - 1) - 1.0);
    const Vec3 middle = box.center_m + place * box.axes[1];
    out.push_back({middle - straight * box.axes[0], middle + straight * box.axes[0], radius});
  }
}

// The box of the points on one side of the middle, with the same axes.
FittedBox half_of(const FittedBox& box, const std::vector<Vec3>& points, bool upper) {
  std::vector<Vec3> part;
  for (const Vec3& p : points)
    if ((glm::dot(p - box.center_m, box.axes[0]) >= 0.0) == upper) part.push_back(p);
  FittedBox out = box;
  out.half_m[0] = 0.5 * box.half_m[0];
  out.center_m = box.center_m + (upper ? 0.5 : -0.5) * box.half_m[0] * box.axes[0];
  if (part.size() < 4) return out;
  for (std::size_t i = 1; i < 3; ++i) {
    const Range range = range_along(part, box.axes[i]);
    out.half_m[i] = 0.5 * (range.high - range.low);
    out.center_m += (0.5 * (range.high + range.low) - glm::dot(out.center_m, box.axes[i])) * box.axes[i];
  }
  if (out.half_m[2] > out.half_m[1]) std::swap(out.half_m[1], out.half_m[2]), std::swap(out.axes[1], out.axes[2]);
  return out;
}

}  // namespace

Eigen3 eigen_of(const Mat3& symmetric) {
  Mat3 a = symmetric, v(1.0);
  constexpr int kSweeps = 12;  // Jacobi's method converges quadratically: 5 sweeps are enough for doubles
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::fabs(a[p][q]) < 1e-300) continue;
        const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        const double t = (theta >= 0.0 ? 1.0 : -1.0) / (std::fabs(theta) + std::sqrt(theta * theta + 1.0));
        const double c = 1.0 / std::sqrt(t * t + 1.0), s = t * c;
        Mat3 turn(1.0);
        turn[p][p] = c, turn[q][q] = c, turn[q][p] = s, turn[p][q] = -s;
        a = glm::transpose(turn) * a * turn;
        v = v * turn;
      }
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int l, int r) { return a[l][l] > a[r][r]; });
  Eigen3 out;
  for (std::size_t i = 0; i < 3; ++i)
    out.values[i] = a[order[i]][order[i]], out.vectors[i] = unit_or(v[order[i]], Vec3(1.0, 0.0, 0.0));
  return out;
}

FittedBox fit_box(const std::vector<Vec3>& points, const Vec3& bone) {
  const Mat3 spread = covariance(points);
  const Eigen3 own = eigen_of(spread);
  // The direction across the bone in which the points spread most.
  const Vec3 side = perpendicular(bone), other = glm::cross(bone, side);
  const double a = glm::dot(side, spread * side), b = glm::dot(side, spread * other),
               c = glm::dot(other, spread * other);
  const Eigen3 flat = eigen_of(Mat3(a, b, 0.0, b, c, 0.0, 0.0, 0.0, 0.0));
  const Vec3 wide = unit_or(flat.vectors[0].x * side + flat.vectors[0].y * other, side);
  const Vec3 third = unit_or(glm::cross(own.vectors[0], own.vectors[1]), own.vectors[2]);
  const std::array<std::array<Vec3, 3>, 3> frames = {{{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)},
                                                      {bone, wide, glm::cross(bone, wide)},
                                                      {own.vectors[0], own.vectors[1], third}}};
  FittedBox best;
  double smallest = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FittedBox box = box_along(points, frames[i]);
    const double size = size_of(box, 1e-3 * (box.half_m[0] + 1e-9));
    if (i == 0 || size < 0.95 * smallest) smallest = size, best = box;
  }
  return best;
}

std::vector<Capsule> fit_capsules(const std::vector<Vec3>& points, const Vec3& bone, double least_radius_m) {
  std::vector<Capsule> out;
  if (points.empty()) return out;
  const FittedBox box = fit_box(points, bone);
  const bool is_long = box.half_m[0] > kLong * std::max(box.half_m[1], least_radius_m);
  if (!is_long) {
    fill(box, least_radius_m, kSideBySide, out);
    return out;
  }
  for (const bool upper : {false, true}) fill(half_of(box, points, upper), least_radius_m, 2, out);
  // Both end at the same point, so they overlap by a radius and leave no gap between their round ends.
  if (out.size() == 2) {
    const Vec3 joint = 0.5 * (out[0].b_m + out[1].a_m);
    out[0].b_m = out[1].a_m = joint;
  }
  return out;
}

double volume_m3(const Capsule& c) {
  return kPi * c.radius_m * c.radius_m * (length(c.b_m - c.a_m) + 4.0 / 3.0 * c.radius_m);
}

double volume_m3(const Box& box) { return 8.0 * box.half_m.x * box.half_m.y * box.half_m.z; }

BodyInertia inertia_of(const Capsule& c, double mass_kg) {
  const double r = c.radius_m, h = length(c.b_m - c.a_m);
  const double tube = h / (h + 4.0 / 3.0 * r), balls = 1.0 - tube;  // fractions of the volume
  const double along = mass_kg * r * r * (0.5 * tube + 0.4 * balls);
  const double across =
      mass_kg * (tube * (r * r / 4.0 + h * h / 12.0) + balls * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r));
  const Vec3 u = unit_or(c.b_m - c.a_m, Vec3(0.0, 1.0, 0.0));
  return {mass_kg, 0.5 * (c.a_m + c.b_m), across * Mat3(1.0) + (along - across) * glm::outerProduct(u, u)};
}

BodyInertia inertia_of(const Box& box, double mass_kg) {
  const Vec3 h = box.half_m;
  const Vec3 moments = mass_kg / 3.0 * Vec3(h.y * h.y + h.z * h.z, h.x * h.x + h.z * h.z, h.x * h.x + h.y * h.y);
  const Mat3 turn = glm::mat3_cast(from_rotation_vector(box.rotation_deg * kRadPerDeg));
  return {mass_kg, box.center_m, turn * Mat3(moments.x, 0, 0, 0, moments.y, 0, 0, 0, moments.z) * glm::transpose(turn)};
}

}  // namespace contort
