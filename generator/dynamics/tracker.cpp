#include "generator/dynamics/tracker.h"

#include "generator/dynamics/dynamics.h"

namespace contort {

namespace {

constexpr double kRootStiffness = 12.0;  // rad/s

Vec3 vec_at(const double* v) { return {v[0], v[1], v[2]}; }
void put(const Vec3& v, double* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }

// A root that legs carry along: it follows as feet do, ahead by what the target accelerates, brought back as by a
// critically damped spring.
void lead_root(const TargetMotion& target, double frame, const FigureState& state, std::span<double> acceleration) {
  Rigid goal;
  double rates[kRootDofs], ahead[kRootDofs];
  target.root_at(frame, goal, rates);
  target.root_acceleration_at(frame, ahead);
  const Vec3 turn = to_rotation_vector(glm::conjugate(state.root.q) * goal.q);
  for (int k = 0; k < kRootDofs; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double off = k < 3 ? goal.p_m[k] - state.root.p_m[k] : turn[k - 3];
    acceleration[i] =
        ahead[k] + 2.0 * kRootStiffness * (rates[k] - state.velocity[i]) + kRootStiffness * kRootStiffness * off;
  }
}

void track_root(const TargetMotion& target, double then, double ahead_s, const FigureState& state,
                std::span<double> acceleration) {
  Rigid goal;
  double rates[kRootDofs];
  target.root_at(then, goal, rates);
  for (int k = 0; k < 3; ++k)
    acceleration[static_cast<std::size_t>(k)] = cubic_acceleration(
        state.root.p_m[k], state.velocity[static_cast<std::size_t>(k)], goal.p_m[k], rates[k], ahead_s);
  put(cubic_acceleration(state.root.q, vec_at(&state.velocity[3]), goal.q, vec_at(rates + 3), ahead_s),
      &acceleration[3]);
}

void track_joint(const Link& link, const TargetMotion& target, double then, double ahead_s, const FigureState& state,
                 double* acceleration) {
  const double* now = &state.coords[static_cast<std::size_t>(link.coord)];
  const double* velocity = &state.velocity[static_cast<std::size_t>(link.dof)];
  double goal[4], rates[3];
  target.joint_at(link, then, goal, rates);
  if (link.kind == JointKind::ball)
    put(cubic_acceleration(quat_at(now), vec_at(velocity), quat_at(goal), vec_at(rates), ahead_s), acceleration);
  else
    acceleration[0] = cubic_acceleration(now[0], velocity[0], goal[0], rates[0], ahead_s);
}

// The difference between the acceleration of the cubic, from the target itself to the goal, and the target's own.
void add_missed(const Link& link, const TargetMotion& target, double frame, double then, double ahead_s,
                double* acceleration) {
  double now[4], rates[3], goal[4], goal_rates[3], own[3];
  target.joint_at(link, frame, now, rates);
  target.joint_at(link, then, goal, goal_rates);
  target.joint_acceleration_at(link, frame, own);
  if (link.kind != JointKind::ball) {
    acceleration[0] += own[0] - cubic_acceleration(now[0], rates[0], goal[0], goal_rates[0], ahead_s);
    return;
  }
  const Vec3 cubic = cubic_acceleration(quat_at(now), vec_at(rates), quat_at(goal), vec_at(goal_rates), ahead_s);
  put(vec_at(acceleration) + vec_at(own) - cubic, acceleration);
}

}  // namespace

FigureState moving_start(const Multibody& body, const TargetMotion& target) {
  FigureState state;
  state.coords.resize(static_cast<std::size_t>(body.coord_count()));
  state.velocity.assign(static_cast<std::size_t>(body.dof_count()), 0.0);
  target.root_at(0.0, state.root, state.velocity.data());
  for (const Link& link : body.links().subspan(1))
    target.joint_at(link, 0.0, &state.coords[static_cast<std::size_t>(link.coord)],
                    &state.velocity[static_cast<std::size_t>(link.dof)]);
  return state;
}

void track(const Multibody& body, const TargetMotion& target, double frame, double tick_s, const Tracking& how,
           const FigureState& state, std::span<double> acceleration) {
  for (std::size_t i = 0; i < body.links().size(); ++i) {
    const Link& link = body.links()[i];
    const double ahead_s = horizon_s(target.knots(static_cast<int>(i)), frame, target.rate_hz(), tick_s);
    const double then = frame + target.rate_hz() * ahead_s;
    if (link.kind == JointKind::root && how.root_leads)
      lead_root(target, frame, state, acceleration);
    else if (link.kind == JointKind::root)
      track_root(target, then, ahead_s, state, acceleration);
    else
      track_joint(link, target, then, ahead_s, state, &acceleration[static_cast<std::size_t>(link.dof)]);
    if (link.kind != JointKind::root && how.exactly)
      add_missed(link, target, frame, then, ahead_s, &acceleration[static_cast<std::size_t>(link.dof)]);
  }
}

void advance(const Multibody& body, std::span<const double> acceleration, double tick_s, FigureState& state) {
  for (std::size_t k = 0; k < state.velocity.size(); ++k) state.velocity[k] += tick_s * acceleration[k];
  integrate(body, state.velocity, tick_s, state.root, state.coords);
}

}  // namespace contort
