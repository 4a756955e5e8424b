#include "generator/motion/foot_rests.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/motion/low_pass.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Speeds are measured by the speed that a leg's pendulum has, sqrt(g l): 2.9 m/s for people.
constexpr double kLands = 0.12;
constexpr double kLeaves = 0.19;
constexpr double kNear = 0.07;  // of the leg's length, above the usual height
constexpr double kShortestRest_s = 0.08;
constexpr double kTurns_s = 0.05;  // in which a foot begins or ceases to lie flat
constexpr double kSteepest = 0.71;  // sine of the greatest tilt of a foot that still bears

// One end of a sole, by frame.
struct EndPath {
  std::vector<double> height_m;
  std::vector<double> steepness;  // sine of the foot's tilt, >= 0
  std::vector<double> speed_m_s;
};

// Speeds are those that are usual around a frame, so that a jump does not end a rest.
EndPath path_of_end(double z_m, const SolePath& path, const Environment& environment, double rate_hz) {
  EndPath out;
  const int last = static_cast<int>(path.size()) - 1;
  const auto point = [&](int f) { return path[at(f)] * Vec3(0.0, 0.0, z_m); };
  std::vector<Vec3> speeds_m_s;
  for (int f = 0; f <= last; ++f) {
    const int before = std::max(f - 1, 0), after = std::min(f + 1, last);
    speeds_m_s.push_back((point(after) - point(before)) * (rate_hz / std::max(after - before, 1)));
    const GroundBelow ground = ground_below(environment, point(f));
    out.height_m.push_back(ground.height_m);
    out.steepness.push_back(std::fabs(glm::dot(ground.normal, path[at(f)].q * Vec3(0, 0, 1))));
  }
  for (const Vec3& speed : medians(speeds_m_s, rate_hz)) out.speed_m_s.push_back(length(speed));
  return out;
}

// The median height of an end while it is slow; infinite if it never is.
double usual_height_m(const EndPath& end, double slow_m_s) {
  std::vector<double> heights_m;
  for (std::size_t f = 0; f < end.height_m.size(); ++f)
    if (end.speed_m_s[f] < slow_m_s) heights_m.push_back(end.height_m[f]);
  return heights_m.empty() ? std::numeric_limits<double>::infinity() : median(std::move(heights_m));
}

// By frame: true from where an end is slow and low until it is fast or high, or the foot too steep.
std::vector<char> resting(const EndPath& end, const Leg& leg) {
  const double pendulum_m_s = pendulum_rad_s(leg) * leg.length_m;
  const double low_m = usual_height_m(end, kLands * pendulum_m_s) + kNear * leg.length_m;
  std::vector<char> rests;
  bool rested = false;
  for (std::size_t f = 0; f < end.height_m.size(); ++f) {
    const double slow_m_s = (rested ? kLeaves : kLands) * pendulum_m_s;
    rested = end.speed_m_s[f] < slow_m_s && end.height_m[f] < low_m && end.steepness[f] < kSteepest;
    rests.push_back(rested ? 1 : 0);
  }
  return rests;
}

// Changes short runs of a value. At the motion's ends a short rest may be the end of a longer one, and stays.
void change_short_runs(char from, double shortest_frames, std::vector<char>& values) {
  const int count = static_cast<int>(values.size());
  for (int first = 0, end = 0; first < count; first = end) {
    for (end = first + 1; end < count && values[at(end)] == values[at(first)];) ++end;
    const bool may_change = end - first < count && (from == 0 || (first > 0 && end < count));
    if (values[at(first)] == from && may_change && end - first < shortest_frames)
      std::fill(values.begin() + first, values.begin() + end, static_cast<char>(1 - from));
  }
}

void find_flat(std::span<const char> heel, std::span<const char> toes, int beside, FootRest& rest) {
  std::vector<int> all;
  for (int f = rest.first; f <= rest.last; ++f)
    if (heel[at(f)] != 0 && toes[at(f)] != 0) all.push_back(f);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_inside = i >= at(beside) && i + at(beside) < all.size();
    if (is_inside || all.size() <= 2 * at(beside)) rest.flat.push_back(all[i]);
  }
}

}  // namespace

std::vector<SolePath> sole_paths(const Character& character, std::span<const Leg> legs, const Motion& motion) {
  std::vector<SolePath> paths(legs.size());
  std::vector<Rigid> world(character.joints().size());
  for (int f = 0; f < motion.frame_count; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    for (std::size_t i = 0; i < legs.size(); ++i) paths[i].push_back(world_from_socket(character, world, legs[i].sole));
  }
  return paths;
}

double pendulum_rad_s(const Leg& leg) { return std::sqrt(9.81 / leg.length_m); }

GroundBelow ground_below(const Environment& environment, const Vec3& point_m) {
  const Surface ground = environment.nearest_ground(point_m);
  return {ground.normal, ground.distance_m / ground.normal.y};
}

std::vector<FootRest> find_rests(const Leg& leg, const SolePath& path, const Environment& environment, double rate_hz) {
  const std::vector<char> heel = resting(path_of_end(leg.low_m.z, path, environment, rate_hz), leg);
  const std::vector<char> toes = resting(path_of_end(leg.high_m.z, path, environment, rate_hz), leg);
  std::vector<char> rests;
  for (std::size_t f = 0; f < heel.size(); ++f) rests.push_back(heel[f] != 0 || toes[f] != 0 ? 1 : 0);
  change_short_runs(0, kShortestRest_s * rate_hz, rests);
  change_short_runs(1, kShortestRest_s * rate_hz, rests);
  std::vector<FootRest> out;
  for (int f = 0; f < static_cast<int>(rests.size()); ++f) {
    if (rests[at(f)] == 0) continue;
    if (f == 0 || rests[at(f - 1)] == 0) out.push_back({f, f, {}});
    out.back().last = f;
  }
  for (FootRest& rest : out) find_flat(heel, toes, static_cast<int>(kTurns_s * rate_hz), rest);
  return out;
}

}  // namespace contort
