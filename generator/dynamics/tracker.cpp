#include "generator/dynamics/tracker.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/dynamics.h"

namespace contort {

namespace {

constexpr double kJointStiffness = 12.0;  // rad/s

// Frequencies with which the root comes back, rad/s: along the ground, up and down, and in turns.
struct RootStiffness {
  double level = 0.0;
  double height = 0.0;
  double turn = 0.0;
};
constexpr RootStiffness kLedRoot{12.0, 12.0, 12.0};
// These are used after an impact. Along the ground, the root comes back little faster than an inverted pendulum of its
// height falls, sqrt(g / h), since the ground cannot move it much faster.
constexpr RootStiffness kSoftRoot{5.0, 10.0, 6.0};
// The stiffness of joints is low just after an impact. Later it exceeds the stiffness of undisturbed motion, so that an
// arm that another body has stopped reaches its target in time.
constexpr double kSoftJointStiffness = 8.0, kSoftUntil_s = 0.3;
constexpr double kStiffJointStiffness = 18.0, kStiffFrom_s = 0.6;

double joint_stiffness(const Tracking& how) {
  if (!how.since_impact_s) return kJointStiffness;
  const double share = (*how.since_impact_s - kSoftUntil_s) / (kStiffFrom_s - kSoftUntil_s);
  return kSoftJointStiffness + (kStiffJointStiffness - kSoftJointStiffness) * std::clamp(share, 0.0, 1.0);
}

Vec3 vec_at(const double* v) { return {v[0], v[1], v[2]}; }
void put(const Vec3& v, double* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; }
void put_turn(const Quat& q, double* out) { out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z; }

// Critically damped.
double spring(double stiffness_per_s, double off, double off_per_s) {
  return 2.0 * stiffness_per_s * off_per_s + stiffness_per_s * stiffness_per_s * off;
}

// The acceleration times this is what a figure misses of its target (missed_of_bend). One that were drawn back to the
// cubics would arrive beside its target.
double missed_s2(double tick_s, double rate_hz) {
  const double frame_s = 1.0 / rate_hz;
  return (frame_s * frame_s - tick_s * tick_s) / 6.0;
}

TargetLead lead_at(const Link& link, const TargetMotion& target, double frame, double missed) {
  TargetLead lead;
  lead.frame = frame;
  double rates[3], acceleration[3]{};
  target.joint_at(link, frame, lead.coords, rates);
  target.joint_acceleration_at(link, frame, acceleration);
  lead.acceleration = vec_at(acceleration);
  if (link.kind == JointKind::ball)
    put_turn(quat_at(lead.coords) * from_rotation_vector(missed * lead.acceleration), lead.coords);
  else
    lead.coords[0] += missed * acceleration[0];
  return lead;
}

Vec3 way_between(const Link& link, const double* from, const double* to) {
  return link.kind == JointKind::ball ? to_rotation_vector(glm::conjugate(quat_at(from)) * quat_at(to))
                                      : Vec3(to[0] - from[0], 0.0, 0.0);
}

// Half a tick before the first frame, as the rates of semi-implicit Euler are.
Vec3 rate_at_start(const Link& link, const TargetMotion& target, double tick_s) {
  double coords[4], rates[3]{}, acceleration[3]{};
  target.joint_at(link, 0.0, coords, rates);
  target.joint_acceleration_at(link, 0.0, acceleration);
  return vec_at(rates) - 0.5 * tick_s * vec_at(acceleration);
}

// Values that all joints share in a tick.
struct Tick {
  const TargetMotion& target;
  double frame;
  double length_s;
  double missed;  // missed_s2
  double before() const { return after(-length_s); }
  double after(double time_s) const { return frame + target.rate_hz() * time_s; }
  double horizon_to(int link) const { return horizon_s(target.knots(link), frame, target.rate_hz(), length_s); }
};

// The rate that a joint has which goes with its target. A step of semi-implicit Euler goes with the rate of its middle,
// so that is the rate of the way of the last tick.
Vec3 last_rate(const Link& link, const Tick& tick, const TargetLead& last, const TargetLead& lead) {
  constexpr double kSame = 1e-6;  // frames
  if (tick.before() < 0.0) return rate_at_start(link, tick.target, tick.length_s);
  if (std::fabs(last.frame - tick.before()) < kSame) return way_between(link, last.coords, lead.coords) / tick.length_s;
  const TargetLead before = lead_at(link, tick.target, tick.before(), tick.missed);
  return way_between(link, before.coords, lead.coords) / tick.length_s;
}

struct Ahead {
  Vec3 way, velocity, acceleration;
};

void store(const Link& link, const Ahead& ahead, TargetAhead& out) {
  for (int k = 0; k < link.dof_count; ++k) {
    const std::size_t dof = static_cast<std::size_t>(link.dof + k);
    out.way[dof] = ahead.way[k], out.velocity[dof] = ahead.velocity[k], out.acceleration[dof] = ahead.acceleration[k];
  }
}

// The acceleration of a joint that goes as its target goes, so that one that is on its target stays on it, and that is
// brought back as by a critically damped spring.
Ahead lead_joint(const Link& link, const Tick& tick, double stiffness_per_s, const double* now, const double* velocity,
                TargetLead& last, double* acceleration) {
  const TargetLead lead = lead_at(link, tick.target, tick.frame, tick.missed);
  const Vec3 rate = last_rate(link, tick, last, lead), off = way_between(link, now, lead.coords);
  for (int k = 0; k < link.dof_count; ++k)
    acceleration[k] = lead.acceleration[k] + spring(stiffness_per_s, off[k], rate[k] - velocity[k]);
  last = lead;
  return {off, rate, lead.acceleration};
}

// A root that legs carry along follows as joints do.
void lead_root(const Tick& tick, const RootStiffness& per_s, const FigureState& state, TargetLead& turn,
               TargetLead* travels, std::span<double> acceleration) {
  for (int k = 0; k < 3; ++k)
    lead_joint(tick.target.root_travel(k), tick, k == 1 ? per_s.height : per_s.level, &state.root.p_m[k],
               &state.velocity[static_cast<std::size_t>(k)], travels[k], &acceleration[static_cast<std::size_t>(k)]);
  double now[4];
  put_turn(state.root.q, now);
  lead_joint(tick.target.root_turn(), tick, per_s.turn, now, &state.velocity[3], turn, &acceleration[3]);
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

Ahead ahead_at(const Link& link, const TargetMotion& target, double frame, const FigureState& state) {
  double goal[4], rates[3]{}, bends[3]{};
  target.joint_at(link, frame, goal, rates);
  target.joint_acceleration_at(link, frame, bends);
  return {way_between(link, &state.coords[static_cast<std::size_t>(link.coord)], goal), vec_at(rates), vec_at(bends)};
}

// Returns how the target's joint is relative to the figure's.
Ahead follow_joint(const Link& link, int index, const Tick& tick, const Tracking& how, const FigureState& state,
                   TargetLead& last, double* acceleration) {
  if (how.exactly || how.since_impact_s)
    return lead_joint(link, tick, joint_stiffness(how),
                      &state.coords[static_cast<std::size_t>(link.coord)],
                      &state.velocity[static_cast<std::size_t>(link.dof)], last, acceleration);
  const double ahead_s = tick.horizon_to(index);
  track_joint(link, tick.target, tick.after(ahead_s), ahead_s, state, acceleration);
  return ahead_at(link, tick.target, tick.frame, state);
}

void follow_root(const Tick& tick, const Tracking& how, const FigureState& state, TargetLead& turn, TargetLead* travels,
                 std::span<double> acceleration) {
  if (how.root_leads || how.since_impact_s)
    return lead_root(tick, how.since_impact_s ? kSoftRoot : kLedRoot, state, turn, travels, acceleration);
  const double ahead_s = tick.horizon_to(0);
  track_root(tick.target, tick.after(ahead_s), ahead_s, state, acceleration);
}

}  // namespace

double missed_of_bend(int ticks_per_frame) { return (1.0 - 1.0 / (ticks_per_frame * ticks_per_frame)) / 6.0; }

FigureState moving_start(const Multibody& body, const TargetMotion& target, double tick_s) {
  FigureState state;
  state.coords.resize(static_cast<std::size_t>(body.coord_count()));
  state.velocity.assign(static_cast<std::size_t>(body.dof_count()), 0.0);
  target.root_at(0.0, state.root, state.velocity.data());
  for (int k = 0; k < 3; ++k)
    state.velocity[static_cast<std::size_t>(k)] = rate_at_start(target.root_travel(k), target, tick_s).x;
  put(rate_at_start(target.root_turn(), target, tick_s), &state.velocity[3]);
  for (const Link& link : body.links().subspan(1)) {
    double rates[3];
    target.joint_at(link, 0.0, &state.coords[static_cast<std::size_t>(link.coord)], rates);
    put(rate_at_start(link, target, tick_s), rates);
    std::copy_n(rates, link.dof_count, &state.velocity[static_cast<std::size_t>(link.dof)]);
  }
  return state;
}

void track(const Multibody& body, const TargetMotion& target, double frame, double tick_s, const Tracking& how,
           const FigureState& state, TrackScratch& scratch, std::span<double> acceleration) {
  const Tick tick{target, frame, tick_s, missed_s2(tick_s, target.rate_hz())};
  const std::size_t count = body.links().size();
  scratch.leads.resize(count + 3);
  for (std::vector<double>* values : {&scratch.ahead.way, &scratch.ahead.velocity, &scratch.ahead.acceleration})
    values->resize(static_cast<std::size_t>(body.dof_count()));
  follow_root(tick, how, state, scratch.leads[0], &scratch.leads[count], acceleration);
  for (std::size_t i = 1; i < count; ++i) {
    const Link& link = body.links()[i];
    double* own = &acceleration[static_cast<std::size_t>(link.dof)];
    store(link, follow_joint(link, static_cast<int>(i), tick, how, state, scratch.leads[i], own), scratch.ahead);
  }
}

void advance(const Multibody& body, std::span<const double> acceleration, double tick_s, FigureState& state) {
  for (std::size_t k = 0; k < state.velocity.size(); ++k) state.velocity[k] += tick_s * acceleration[k];
  integrate(body, state.velocity, tick_s, state.root, state.coords);
}

}  // namespace contort
