#include "generator/motion/joint_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "generator/motion/way.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kShare = 0.98;       // of the greatest speed: room for rounding
constexpr double kShortest_s = 0.03;  // from rest to the greatest speed in a posture that is passed on
constexpr double kGentle_s = 0.1;     // the same of a joint that has fallen behind
constexpr double kBrakes = 0.2;       // of its speed, which a joint with mass loses in a frame if it must

void go(const Joint& joint, const double* from, const Vec3& step, double* out) {
  if (joint.kind != JointKind::ball) {
    out[0] = from[0] + step.x;
    return;
  }
  const Quat q = glm::normalize(quat_at(from) * from_rotation_vector(step));
  out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z;
}

Vec3 shortened(const Vec3& v, double most) {
  const double now = length(v);
  return now > most ? v * (most / now) : v;
}

// The greatest speed at which what is `distance` away can be reached without going past it, per frame: this step and n
// more, each slower by `change`, cover the distance, (n + 1) speed - n (n + 1) / 2 change.
double closing_speed(double distance, double change) {
  if (!(change > 0.0)) return 0.0;
  const double n = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * distance / change) - 1.0));
  return distance / (n + 1.0) + 0.5 * n * change;
}

// The speed that is nearest to the wanted one and allows to stop at the end of the range.
double stopping_in_range(const Joint& joint, double now, double speed, double change) {
  const auto most = [&](double room) { return room > 0.0 ? closing_speed(room, change) : 0.0; };
  return std::clamp(speed, -most(now - joint.low), most(joint.high - now));
}

// Rounding puts a joint at the end of its range a little beyond.
bool is_inside(const Joint& joint, const double* coords) { return normalised_margin(joint, coords) >= -1e-6; }

// A ball that comes to the edge of its range goes on along it, in another direction: it slows down before, so that it
// can turn at once.
Vec3 braking_at_edge(const Joint& ball, const double* now, const Vec3& aim, double speed, double most_speed,
                     double most_change) {
  constexpr double kTurns = 0.3;  // of the greatest speed
  const double wanted = length(aim);
  if (!(wanted > kTurns * most_speed) || !(most_change > 0.0)) return aim;
  const double coast = 0.5 * speed * speed / most_change;
  std::array<double, 4> ahead{};
  go(ball, now, aim * ((wanted + coast) / wanted), ahead.data());
  if (is_inside(ball, ahead.data())) return aim;
  return shortened(aim, std::max(kTurns * most_speed, speed - most_change));
}

// Goes a step, along the edge of the range where it would leave that. Where the edge would make it longer than the
// joint can go, it is shortened, at last to nothing.
void go_inside(const Joint& joint, const double* now, const Vec3& step, bool stays_inside, double* out) {
  const double most = length(step) * 1.01;
  for (const double share : {1.0, 0.5, 0.25, 0.0}) {
    go(joint, now, share * step, out);
    if (!stays_inside) return;
    clamp_to_range(joint, out);
    if (length(joint_way_vector(joint, now, out)) <= most) return;
  }
}

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

// The greatest speed, and changes of speed, of a joint, per frame. A limb that was moved out of the way may have more
// speed than it gets at ease, and must not coast on with it.
struct JointPath::Limits {
  double speed;
  double change;
  double brake;
};

JointPath::Limits JointPath::limits_of(int j, bool is_behind) const {
  const double speed = kShare * character_->joint(j).max_speed * frame_s_;
  const double change = speed * std::min(1.0, frame_s_ / (is_behind ? kGentle_s : kShortest_s));
  if (most_change_.empty() || haste_ == Haste::struck) return {speed, change, change};
  const double easy = most_change_[at(j)];
  const State& state = joints_[at(j)];
  const double brake = state.is_corrected ? std::max(easy, kBrakes * length(state.speed)) : easy;
  return {speed, std::min(change, easy), std::min(change, brake)};
}

void JointPath::begin(const Character& character, std::span<const double> coords, double rate_hz,
                      std::span<const double> easy) {
  character_ = &character;
  frame_s_ = 1.0 / rate_hz;
  most_change_.clear();
  for (const double acceleration : easy) most_change_.push_back(acceleration * frame_s_ * frame_s_);
  now_.assign(coords.begin(), coords.end());
  wanted_.assign(coords.begin(), coords.end());
  joints_.assign(character.joints().size(), {});
}

bool JointPath::follow_joint(int j, double* coords) {
  const Joint& joint = character_->joint(j);
  const double* now = now_.data() + joint.coord;
  State& state = joints_[at(j)];
  const Vec3 left = joint_way_vector(joint, now, coords);
  const Vec3 wanted_speed = joint_way_vector(joint, wanted_.data() + joint.coord, coords);
  const Limits limits = limits_of(j, state.is_behind);
  const bool is_there = length(left) <= limits.speed && length(left - state.speed) <= limits.change &&
                        length(left - wanted_speed) <= limits.change;
  if (is_there || !is_finite(left) || !is_finite(state.speed) || joint.max_speed <= 0.0) {
    state = {is_there ? left : Vec3(0.0), false};
    return false;
  }
  const Limits gentle = limits_of(j, true);
  const double distance = length(left);
  const Vec3 towards = distance > 0.0 ? left * (closing_speed(distance, gentle.change) / distance) : Vec3(0.0);
  Vec3 aim = shortened(shortened(wanted_speed, gentle.speed) + towards, gentle.speed);
  const bool stays_inside = is_inside(joint, now) && is_inside(joint, coords);
  if (stays_inside && joint.kind != JointKind::ball) aim.x = stopping_in_range(joint, now[0], aim.x, gentle.change);
  if (stays_inside && joint.kind == JointKind::ball)
    aim = braking_at_edge(joint, now, aim, length(state.speed), gentle.speed, gentle.change);
  const bool brakes = length(aim) < length(state.speed);
  const Vec3 step = state.speed + shortened(aim - state.speed, brakes ? gentle.brake : gentle.change);
  go_inside(joint, now, step, stays_inside, coords);
  state = {joint_way_vector(joint, now, coords), true, state.is_corrected && brakes};
  return true;
}

// Returns true if a joint of one coordinate rests where it is wanted: most joints do in most frames.
bool JointPath::rests(int j, double wanted) const {
  const Joint& joint = character_->joint(j);
  return joint.kind != JointKind::ball && now_[at(joint.coord)] == wanted && wanted_[at(joint.coord)] == wanted &&
         joints_[at(j)].speed == Vec3(0.0);
}

bool JointPath::follow(std::size_t part, std::span<double> coords, Haste haste) {
  haste_ = haste;
  const Part& own = character_->parts()[part];
  bool is_behind = false;
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character_->joint(j);
    if (joint.kind == JointKind::root) continue;
    if (const double coord = coords[at(joint.coord)]; rests(j, coord)) {
      now_[at(joint.coord)] = wanted_[at(joint.coord)] = coord;  // the sign of a zero may differ
      joints_[at(j)] = {};
      continue;
    }
    std::array<double, 4> wanted{};
    const auto first = coords.begin() + joint.coord;
    std::copy_n(first, coord_size(joint.kind), wanted.begin());
    is_behind = follow_joint(j, coords.data() + joint.coord) || is_behind;
    std::copy_n(first, coord_size(joint.kind), now_.begin() + joint.coord);
    std::copy_n(wanted.begin(), coord_size(joint.kind), wanted_.begin() + joint.coord);
  }
  return is_behind;
}

void JointPath::put(std::size_t part, std::span<const double> coords) {
  const Part& own = character_->parts()[part];
  const auto first = coords.begin() + own.first_coord;
  std::copy_n(first, own.coord_count, now_.begin() + own.first_coord);
  std::copy_n(first, own.coord_count, wanted_.begin() + own.first_coord);
}

void JointPath::pass(std::size_t part, std::span<const double> coords) {
  const Part& own = character_->parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character_->joint(j);
    if (joint.kind == JointKind::root) continue;
    const Vec3 step = joint_way_vector(joint, now_.data() + joint.coord, coords.data() + joint.coord);
    const double most = limits_of(j, false).speed;
    joints_[at(j)] = {is_finite(step) ? shortened(step, most) : Vec3(0.0), false};
  }
  put(part, coords);
}

void JointPath::correct(std::size_t part, std::span<const double> coords) {
  const Part& own = character_->parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character_->joint(j);
    if (joint.kind == JointKind::root) continue;
    State& state = joints_[at(j)];
    state = {state.speed + joint_way_vector(joint, now_.data() + joint.coord, coords.data() + joint.coord), true, true};
  }
  std::copy_n(coords.begin() + own.first_coord, own.coord_count, now_.begin() + own.first_coord);
}

void JointPath::correct(std::size_t part, std::span<const double> shown_before, std::span<const double> coords) {
  correct(part, coords);
  const Part& own = character_->parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) {
    const Joint& joint = character_->joint(j);
    if (joint.kind != JointKind::root)
      joints_[at(j)].speed = joint_way_vector(joint, shown_before.data() + joint.coord, coords.data() + joint.coord);
  }
}

void JointPath::cut(std::size_t part, std::span<const double> coords) {
  const Part& own = character_->parts()[part];
  for (int j = own.first_joint; j < own.first_joint + own.joint_count; ++j) joints_[at(j)] = {};
  put(part, coords);
}

}  // namespace contort
