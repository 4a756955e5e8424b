#include "generator/motion/standing_feet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "generator/motion/joint_clamp.h"
#include "generator/motion/place_foot.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kTouches_m = 0.003;  // over the ground
constexpr double kFree_m = 0.03;      // over the ground: a foot that is as high stands no more
constexpr double kLift_m = 0.006;     // of a foot that goes far
constexpr double kFar_m = 0.02;       // from there on
constexpr double kThere = 1e-9;       // m and rad: a foot that is so near is where it stood
constexpr double kRounding_m = 5e-4;  // into the ground, for rounding

std::array<Vec3, 4> corners_of(const Leg& leg) {
  return {Vec3(leg.low_m.x, 0.0, leg.low_m.z), Vec3(leg.low_m.x, 0.0, leg.high_m.z),
          Vec3(leg.high_m.x, 0.0, leg.low_m.z), Vec3(leg.high_m.x, 0.0, leg.high_m.z)};
}

// The height that a point must have at this distance from where it stood. It begins flat, so that the knee, which
// starts from straight, begins slowly.
double lift_at(double distance_m) { return kLift_m * minimum_jerk(std::min(1.0, distance_m / kFar_m)); }

}  // namespace

void StandingFeet::begin(const Character& character, std::span<const Leg> legs, const Environment& environment) {
  character_ = &character, legs_ = legs, environment_ = &environment;
  stood_.fill(std::nullopt), rests_.fill(std::nullopt), was_seen_.fill(false), use_.fill(LegUse::idle);
}

double StandingFeet::height_m(std::size_t leg, const Rigid& sole) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : corners_of(legs_[leg])) {
    const Vec3 at = sole * corner;
    least = std::min(least, at.y - environment_->height_at(at.x, at.z));
  }
  return least;
}

bool StandingFeet::put_on_ground(std::size_t leg, Rigid& sole) const {
  const double height = height_m(leg, sole);
  if (!(height < -kRounding_m)) return false;
  sole.p_m.y -= height;
  return true;
}

bool StandingFeet::is_planted(std::size_t leg) const {
  return stood_[leg] && use_[leg] == LegUse::idle && carrier_of(*character_, legs_[leg].part) != 0;
}

void StandingFeet::note(std::size_t leg, LegUse use, std::span<const Rigid> world) {
  const Rigid sole = world_from_socket(*character_, world, legs_[leg].sole);
  const double height = height_m(leg, sole);
  const bool stays_idle = use_[leg] == LegUse::idle && use == LegUse::idle;
  use_[leg] = use;
  const bool moves = use == LegUse::acts || use == LegUse::lands;
  const bool stays = (stays_idle && is_planted(leg)) || (moves && stood_[leg] && height <= kFree_m);
  if (!stays) stood_[leg] = height <= kTouches_m ? std::optional(sole) : std::nullopt;
  if (!moves || !was_seen_[leg]) rests_[leg] = stood_[leg];
  seen_[leg] = sole, was_seen_[leg] = true;
}

bool StandingFeet::land(std::size_t leg, const Rigid& world_from_sole, LandingStep step, std::span<Rigid> world,
                        std::span<double> row) {
  constexpr double kArrives_m = 2e-4, kArrives_rad = 2e-3;
  stood_[leg] = world_from_sole;
  const Rigid from = world_from_socket(*character_, world, legs_[leg].sole);
  Rigid sole = part_way(from, world_from_sole, step.share);
  sole.p_m.y += step.lift * std::max(0.0, -spare_m(leg, sole));
  put(leg, sole, world, row);
  const Rigid now = world_from_socket(*character_, world, legs_[leg].sole);
  return length(now.p_m - world_from_sole.p_m) < kArrives_m &&
         rotation_angle(glm::conjugate(now.q) * world_from_sole.q) < kArrives_rad;
}

void StandingFeet::put(std::size_t leg, const Rigid& sole, std::span<Rigid> world, std::span<double> row) const {
  place_foot(*character_, legs_[leg], world, sole, row);
  for (const int j : legs_[leg].joints) {
    clamp_to_range(character_->joint(j), row.data() + character_->joint(j).coord);
    forward_kinematics(*character_, row, j, j + 1, world);
  }
}

bool StandingFeet::put_back(std::size_t leg, const Rigid& stood, std::span<Rigid> world, std::span<double> row) const {
  const Rigid sole = world_from_socket(*character_, world, legs_[leg].sole);
  const bool is_there = length(sole.p_m - stood.p_m) < kThere &&
                        rotation_angle(glm::conjugate(sole.q) * stood.q) < kThere;
  if (!is_there) put(leg, stood, world, row);
  return !is_there;
}

bool StandingFeet::plant(std::size_t leg, std::span<Rigid> world, std::span<double> row) const {
  return put_back(leg, *stood_[leg], world, row);
}

void StandingFeet::put_to_rest(std::size_t leg, std::span<Rigid> world, std::span<double> row) const {
  put_back(leg, *rests_[leg], world, row);
}

void StandingFeet::stay(std::size_t leg, std::span<Rigid> world, std::span<double> row) const {
  if (stood_[leg]) put_back(leg, seen_[leg], world, row);
}

double StandingFeet::missed_m(std::size_t leg, const Rigid& sole, std::span<Rigid> world, std::span<double> row) const {
  put(leg, sole, world, row);
  return length(world_from_socket(*character_, world, legs_[leg].sole).p_m - sole.p_m);
}

double StandingFeet::off_m(std::size_t leg, std::span<const Rigid> world) const {
  return length(world_from_socket(*character_, world, legs_[leg].sole).p_m - rests_[leg]->p_m);
}

double StandingFeet::spare_m(std::size_t leg, const Rigid& sole) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : corners_of(legs_[leg])) {
    const Vec3 now = sole * corner, was = *stood_[leg] * corner;
    const double distance_m = std::sqrt((now.x - was.x) * (now.x - was.x) + (now.z - was.z) * (now.z - was.z));
    const double ground_m = environment_->height_at(now.x, now.z);
    const double stood_m = std::min(0.0, was.y - environment_->height_at(was.x, was.z));
    least = std::min(least, now.y - ground_m - stood_m + kRounding_m - lift_at(distance_m));
  }
  return least;
}

double StandingFeet::room_m(std::size_t leg, std::span<const Rigid> world) const {
  if (!stood_[leg]) return std::numeric_limits<double>::infinity();
  return spare_m(leg, world_from_socket(*character_, world, legs_[leg].sole));
}

bool StandingFeet::lift(std::size_t leg, std::span<Rigid> world, std::span<double> row) const {
  if (!stood_[leg]) return false;
  Rigid sole = world_from_socket(*character_, world, legs_[leg].sole);
  const double missing_m = -spare_m(leg, sole);
  if (missing_m <= 0.0) return false;
  sole.p_m.y += missing_m;
  put(leg, sole, world, row);
  return true;
}

}  // namespace contort
