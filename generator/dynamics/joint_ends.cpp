#include "generator/dynamics/joint_ends.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/tracking.h"
#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kBeyond_rad = 1e-8;  // the clamp leaves a ball 1e-9 inside

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

// Turns no farther along `out` than there is room, and not farther out where there is none.
void stop_ball(const Joint& ball, const double* coords, double tick_s, Vec3& rate) {
  const std::optional<BallEnd> end = ball_end(ball, coords, tick_s * rate);
  if (!end) return;
  const double most = std::max(end->room_rad, 0.0) / tick_s;
  rate += std::min(0.0, most - glm::dot(rate, end->out)) * end->out;
}

}  // namespace

std::optional<BallEnd> ball_end(const Joint& ball, const double* coords, const Vec3& turn_rad) {
  const Quat then = turned(coords, turn_rad);
  if (is_far_inside(ball, then)) return std::nullopt;
  double inside[4] = {then.w, then.x, then.y, then.z};
  clamp_to_range(ball, inside);
  const Quat nearest = quat_at(inside);
  const Vec3 beyond = to_rotation_vector(glm::conjugate(nearest) * then);
  const double beyond_rad = length(beyond);
  if (!(beyond_rad > kBeyond_rad)) return std::nullopt;
  const Vec3 out = beyond / beyond_rad;
  return BallEnd{out, glm::dot(out, turn_rad) - beyond_rad};
}

void slow_at_ends(const Character& character, const Multibody& body, std::span<const char> held,
                  const FigureState& state, double tick_s, std::span<double> acceleration) {
  const double ahead_s = shortest_horizon_s(tick_s);
  const double per_distance = 2.0 / (ahead_s * ahead_s);
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    if (link.kind == JointKind::ball) {
      const Vec3 rate = three_of(state.velocity, link.dof), asked = three_of(acceleration, link.dof);
      const Vec3 turn = ahead_s * rate + asked / per_distance;
      if (const std::optional<BallEnd> end = ball_end(joint, &state.coords[at(link.coord)], turn); end)
        set_three(acceleration, link.dof,
                  asked + per_distance * (end->room_rad - glm::dot(turn, end->out)) * end->out);
      return;
    }
    double& asked = acceleration[at(link.dof)];
    const double then = state.coords[at(link.coord)] + ahead_s * state.velocity[at(link.dof)];
    asked = std::min(asked, per_distance * (joint.high - then));
    asked = std::max(asked, per_distance * (joint.low - then));
  });
}

void stop_at_ends(const Character& character, const Multibody& body, std::span<const char> held, double tick_s,
                  FigureState& state) {
  for_free(character, body, held, [&](const Joint& joint, const Link& link) {
    if (link.kind == JointKind::ball) {
      Vec3 turning = three_of(state.velocity, link.dof);
      stop_ball(joint, &state.coords[at(link.coord)], tick_s, turning);
      set_three(state.velocity, link.dof, turning);
      return;
    }
    double& rate = state.velocity[at(link.dof)];
    const double now = state.coords[at(link.coord)];
    rate = std::min(rate, std::max(joint.high - now, 0.0) / tick_s);
    rate = std::max(rate, std::min(joint.low - now, 0.0) / tick_s);
  });
}

}  // namespace contort
