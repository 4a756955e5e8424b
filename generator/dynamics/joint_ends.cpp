#include "generator/dynamics/joint_ends.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kEndStep_rad = 1e-5;  // for differences
constexpr int kEndPasses = 3;       // over both ends, where a ball comes to them at once

// Calls visit(joint, link) for joints that no foot holds.
template <class Visit>
void for_free(const Character& character, const Multibody& body, std::span<const char> held, Visit visit) {
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (held[at(link.dof)] == 0) visit(character.joints()[i], link);
  }
}

Vec3 three_of(std::span<const double> values, int first) {
  return {values[at(first)], values[at(first) + 1], values[at(first) + 2]};
}

void set_three(std::span<double> values, int first, const Vec3& to) {
  for (int i = 0; i < 3; ++i) values[at(first + i)] = to[i];
}

Quat turned(const double* coords, const Vec3& turn_rad) {
  return Quat(coords[0], coords[1], coords[2], coords[3]) * from_rotation_vector(turn_rad);
}

// Swing and twist are smaller than the whole rotation. Most balls are far from their ends, and this is cheap to see:
// half an angle below a right one is less than pi/2 times its sine.
bool is_far_inside(const Joint& ball, const Quat& q) {
  const Quat from_center = glm::conjugate(ball.swing_center) * q;
  const double least = std::min({ball.swing_a_rad, ball.swing_b_rad, ball.high, -ball.low});
  const Vec3 sine(from_center.x, from_center.y, from_center.z);
  return least > 0.0 && kPi * length(sine) < least;
}

// The size of the swing as a share of its ellipse.
double swing_share(const Joint& ball, const double* coords) {
  const SwingTwist at = swing_twist_of(ball, coords);
  const double a = at.a_rad / ball.swing_a_rad, b = at.b_rad / ball.swing_b_rad;
  return std::sqrt(a * a + b * b);
}

// The twist from the middle of its range, as a share of half of it.
double twist_share(const Joint& ball, const double* coords) {
  const double middle = 0.5 * (ball.low + ball.high), half = 0.5 * (ball.high - ball.low);
  return half > 0.0 ? std::fabs(wrap_angle(swing_twist_of(ball, coords).twist_rad - middle)) / half : 0.0;
}

// The end at which a share is 1, by the share's differences for turns about the three axes.
void add_end(const Joint& ball, const double* coords, double (*share)(const Joint&, const double*), BallEnds& out) {
  const double now = share(ball, coords);
  Vec3 slope(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 step(0.0);
    step[axis] = kEndStep_rad;
    const Quat q = turned(coords, step);
    const double then[4] = {q.w, q.x, q.y, q.z};
    slope[axis] = (share(ball, then) - now) / kEndStep_rad;
  }
  const double steepness = length(slope);
  if (steepness > 0.0) out.ends[at(out.count++)] = {slope / steepness, (1.0 - now) / steepness};
}

bool has_twist_ends(const Joint& ball) { return ball.high - ball.low < 2.0 * kPi; }

// A turn that goes along an end, or as far along its outward direction as `most` returns, but no farther.
template <class Most>
Vec3 stopped(const BallEnds& ends, const Vec3& turn_rad, Most most) {
  Vec3 turn = turn_rad;
  for (int pass = 0; pass < kEndPasses; ++pass)
    for (const BallEnd& end : ends.all()) turn += std::min(0.0, most(end) - glm::dot(turn, end.out)) * end.out;
  return turn;
}

// The way that the target goes from the figure's joint in this time, at its present rate and acceleration.
Vec3 way_of_target(const Link& link, const TargetAhead& target, double ahead_s) {
  Vec3 way(0.0);
  for (int k = 0; k < link.dof_count; ++k) {
    const std::size_t dof = at(link.dof + k);
    way[k] = target.way[dof] + ahead_s * (target.velocity[dof] + 0.5 * ahead_s * target.acceleration[dof]);
  }
  return way;
}

}  // namespace

BallEnds ball_ends(const Joint& ball, const double* coords, const Vec3& turn_rad) {
  BallEnds out;
  const Quat q = turned(coords, turn_rad);
  const double then[4] = {q.w, q.x, q.y, q.z};
  if (is_far_inside(ball, q) || (swing_share(ball, then) < 1.0 && twist_share(ball, then) < 1.0)) return out;
  add_end(ball, coords, swing_share, out);
  if (has_twist_ends(ball)) add_end(ball, coords, twist_share, out);
  return out;
}

BallEnds near_ends(const Joint& ball, const double* coords, double within_rad) {
  BallEnds all, near;
  add_end(ball, coords, swing_share, all);
  if (has_twist_ends(ball)) add_end(ball, coords, twist_share, all);
  for (const BallEnd& end : all.all())
    if (end.room_rad < within_rad) near.ends[at(near.count++)] = end;
  return near;
}

void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, const TargetAhead& target, double ahead_s, std::span<double> acceleration) {
  const double per_distance = 2.0 / (ahead_s * ahead_s);
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    const Vec3 planned = way_of_target(link, target, ahead_s);
    if (link.kind == JointKind::ball) {
      const Vec3 rate = three_of(state.velocity, link.dof), asked_now = three_of(acceleration, link.dof);
      const Vec3 turn = ahead_s * rate + asked_now / per_distance;
      const auto most = [&](const BallEnd& end) { return std::max(end.room_rad, glm::dot(planned, end.out)); };
      if (const BallEnds ends = ball_ends(joint, &state.coords[at(link.coord)], turn); ends.count > 0)
        set_three(acceleration, link.dof, asked_now + per_distance * (stopped(ends, turn, most) - turn));
      return;
    }
    double& asked = acceleration[at(link.dof)];
    const double now = state.coords[at(link.coord)], then = now + ahead_s * state.velocity[at(link.dof)];
    asked = std::min(asked, per_distance * (std::max(joint.high, now + planned.x) - then));
    asked = std::max(asked, per_distance * (std::min(joint.low, now + planned.x) - then));
  });
}

void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state) {
  const auto not_farther_out = [](const BallEnd& end) { return std::max(end.room_rad, 0.0); };
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    if (link.kind == JointKind::ball) {
      const Vec3 turn = tick_s * three_of(state.velocity, link.dof);
      if (const BallEnds ends = ball_ends(joint, &state.coords[at(link.coord)], turn); ends.count > 0)
        set_three(state.velocity, link.dof, stopped(ends, turn, not_farther_out) / tick_s);
      return;
    }
    double& rate = state.velocity[at(link.dof)];
    const double now = state.coords[at(link.coord)];
    rate = std::min(rate, std::max(joint.high - now, 0.0) / tick_s);
    rate = std::max(rate, std::min(joint.low - now, 0.0) / tick_s);
  });
}

void put_balls_inside(const Character& character, const Multibody& body, FigureState& state) {
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (link.kind == JointKind::ball) clamp_to_range(character.joints()[i], &state.coords[at(link.coord)]);
  }
}

void put_legs_inside(const Character& character, const Multibody& body, std::span<const char> held,
                     FigureState& state) {
  constexpr double kSlight_rad = 0.1 * kRadPerDeg;
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (held[at(link.dof)] == 0 || link.kind != JointKind::hinge) continue;
    double& angle = state.coords[at(link.coord)];
    double inside = angle;
    clamp_to_range(character.joints()[i], &inside);
    if (std::fabs(inside - angle) <= kSlight_rad) angle = inside;
  }
}

bool overbends(const Character& character, const Multibody& body, std::span<const char> held,
               std::span<const double> target, const FigureState& state) {
  constexpr double kOver_rad = 0.03;
  for (std::size_t i = 1; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    if (held[at(link.dof)] == 0 || link.kind != JointKind::hinge) continue;
    const Joint& joint = character.joints()[i];
    const double now = state.coords[at(link.coord)], rate = state.velocity[at(link.dof)];
    const double wanted = target[at(link.coord)];
    const double low = std::min(joint.low, wanted) - kOver_rad, high = std::max(joint.high, wanted) + kOver_rad;
    if ((now > high && rate > 0.0) || (now < low && rate < 0.0)) return true;
  }
  return false;
}

}  // namespace contort
