#include "generator/dynamics/simulate.h"

#include <optional>

#include "generator/dynamics/closed_chain.h"
#include "generator/dynamics/foot_lifts.h"
#include "generator/dynamics/joint_ends.h"
#include "generator/dynamics/linear.h"
#include "generator/dynamics/racing.h"
#include "generator/dynamics/soft_legs.h"
#include "generator/dynamics/target.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kRecovers_s = 1.5;  // after an impact
constexpr double kNearBody_m = 0.1;  // bodies of the figure that are nearer to each other may touch soon
constexpr double kBodiesAhead_s = 0.1;
constexpr double kUnfelt = 0.05;    // of a figure's mass; lighter loads do not take it off its target
constexpr double kSlips_m_s = 0.5;  // a sole that an impact makes faster than this does not stand any more

class Simulation {
 public:
  Simulation(const Character& character, const DynamicsSetup& setup, const Environment& environment,
             const ContactPlan& plan, const BalancePlan& balance, SimulationScratch& scratch, Motion& motion)
      : character_(character),
        setup_(setup),
        figure_(setup.figure),
        body_(setup.figure.body),
        environment_(environment),
        plan_(plan),
        balance_(balance),
        s_(scratch),
        state_(scratch.equation.state),
        motion_(motion),
        target_(setup.figure.body, motion),
        tick_s_(1.0 / (motion.rate_hz * setup.ticks_per_frame)),
        feels_load_(feels_loads(setup.figure)) {
    target_.share_knots(closed_chain(setup.figure));
  }

  void run() {
    prepare();
    for (frame_ = 0; frame_ < motion_.frame_count; ++frame_) {
      s_.record.begin_frame(frame_, state_, s_.contacts.planned(frame_));
      for (const Impact& blow : setup_.impacts)
        if (blow.frame == frame_) strike(blow);
      s_.equation.place();
      s_.contacts.begin_frame(frame_);
      // The last frame is looked at, but not left.
      const bool last = frame_ + 1 == motion_.frame_count;
      for (int i = 0; i < (last ? 1 : setup_.ticks_per_frame); ++i) tick(i, !last);
      s_.record.end_frame(s_.contacts.feet().soles());
    }
  }

 private:
  void prepare() {
    const auto n = at(body_.dof_count());
    s_.tracked.assign(n, 0.0);
    s_.actuation.assign(n);
    s_.contacts.begin(figure_, environment_, plan_, motion_.rate_hz, tick_s_);
    s_.record.begin(motion_, body_.dof_count());
    s_.equation.begin(figure_, moving_start(body_, target_, tick_s_));
    s_.standing.begin(figure_, balance_, tick_s_);
    s_.loose.begin(tick_s_);
    s_.leg_stops.clear();
    s_.bodies.begin(character_, figure_);
    s_.contacts.lead_all();
    s_.equation.place();
    s_.equation.find_mass();
    s_.contacts.follow_plan(0.0, s_.equation.dynamics);  // soles bear from the first frame on, also a blow in it
  }

  // Returns true if something acts from outside, or did a short while ago.
  bool is_disturbed() const { return !figure_.loads.empty() || is_struck(); }
  bool is_struck() const { return struck_frame_ >= 0 && frame_ - struck_frame_ < kRecovers_s * motion_.rate_hz; }

  // Returns true if the loads weigh more than a small fraction of the figure.
  static bool feels_loads(const DynamicFigure& figure) {
    double loads_kg = 0.0;
    for (const Load& load : figure.loads) loads_kg += load.mass_kg;
    return loads_kg > kUnfelt * (figure.body.mass_kg() - loads_kg);
  }

  std::span<const double> target_coords() const {
    const auto count = at(motion_.coord_count);
    return std::span<const double>(motion_.response.target_coords).subspan(at(frame_) * count, count);
  }

  bool leg_overbends() const {
    return overbends(character_, body_, s_.contacts.feet().stands_by_dof(), target_coords(), state_);
  }

  bool is_dynamic() const { return setup_.mode == Mode::dynamic; }

  void let_go() {
    s_.contacts.release();
    s_.standing.let_go();
    s_.loose.let_go();
    s_.leg_stops.clear();
  }

  void strike(const Impact& blow) {
    s_.equation.place();
    s_.equation.find_mass();
    s_.equation.find_factors();
    const Placement& link = s_.equation.dynamics.world[at(blow.link)];
    s_.record.impact({frame_, blow.link, link.origin_m + link.rotation * blow.point_m, blow.impulse_N_s});
    s_.impact.strike(s_.equation, s_.contacts, environment_, blow);
    if (!is_dynamic()) hold_soles();
    if (is_dynamic() && s_.impact.sole_speed_m_s() > kSlips_m_s) let_go();
    s_.standing.rest();
    s_.loose.forget_momentum();
    struck_frame_ = frame_;
  }

  // Tracking alone stands on ground that gives whatever the soles need, also in a blow.
  void hold_soles() {
    if (!s_.contacts.has_soles()) return;
    s_.contacts.find_rows(s_.equation, s_.equation.still);
    s_.contacts.stop(s_.equation);
  }

  void tick(int index, bool moves) {
    s_.equation.place();
    const double frame = frame_ + static_cast<double>(index) / setup_.ticks_per_frame;
    const bool is_planted = s_.contacts.is_planted();
    std::optional<double> since_impact_s;
    if (is_struck() && !s_.loose.is_loose()) since_impact_s = (frame - struck_frame_) / motion_.rate_hz;
    // With a load that it feels, a figure may leave its target to relieve its joints, but not while it steps.
    const bool is_exact = !is_struck() && (!feels_load_ || !is_planted);
    track(body_, target_, frame, tick_s_, {!is_planted, since_impact_s, is_exact}, state_, track_, s_.tracked);
    frame_time_ = frame;
    s_.contacts.follow_plan(frame, s_.equation.dynamics);
    s_.standing.begin_tick(frame, is_disturbed());
    slow_at_ends(character_, body_, s_.contacts.feet().stands_by_dof(), state_, track_.ahead,
                 shortest_horizon_s(tick_s_), s_.tracked);
    find_bodies(index == 0);
    if (is_disturbed()) s_.bodies.slow(s_.equation, kBodiesAhead_s, s_.tracked);
    if (is_dynamic())
      actuate();
    else
      follow();
    s_.record.efforts(s_.actuation.efforts);
    if (moves)
      move();
    else if (s_.loose.is_loose())
      look_at_footing();
    if (s_.after_tick) s_.after_tick();
  }

  // In each tick of a loose figure, and in the first one of a frame of a figure that stands, which follows its contacts
  // from there on. Bodies of a figure that nothing disturbs do what the target does.
  void find_bodies(bool begins_frame) {
    const bool is_loose = s_.loose.is_loose();
    if (!is_loose && !is_disturbed()) return s_.bodies.clear();
    if (begins_frame || is_loose) s_.bodies.find(s_.equation.dynamics, kNearBody_m, !is_loose);
  }

  // Tracking alone: what that takes is measured, and changes nothing. Feet that stay only while a joint races (a leg
  // that is to fold through itself) are let go.
  void follow() {
    std::vector<double>& acceleration = s_.actuation.acceleration;
    s_.contacts.find_rows(s_.equation, s_.tracked);
    acceleration = s_.tracked;
    s_.contacts.keep(acceleration);
    if (!s_.contacts.feet().none() && races(body_, figure_.fastest, state_.velocity, acceleration, tick_s_)) {
      s_.contacts.release();
      acceleration = s_.tracked;
    }
    inverse_dynamics(body_, state_.velocity, acceleration, kGravity_m_s2, s_.equation.dynamics, s_.actuation.forces);
    s_.standing.find_ground(s_.equation, s_.contacts, s_.actuation);
    s_.standing.find_efforts(s_.equation, s_.actuation);
    if (!s_.contacts.feet().none()) s_.record.balance(s_.standing.balance(s_.equation, s_.actuation.forces));
  }

  // As a figure with mass: on its soles while the ground can hold it, otherwise loose.
  void actuate() {
    s_.equation.find_mass();
    if (s_.loose.is_loose()) s_.loose.carry_momentum(s_.equation);
    if (s_.loose.is_loose() && !s_.loose.has_fallen()) try_to_stand();
    if (!s_.loose.is_loose() && is_disturbed() && leg_overbends()) let_go();
    // Without a sole on the ground the rest of the figure may touch it.
    if (!s_.loose.is_loose() && s_.contacts.has_soles() && s_.contacts.planned(frame_) == 0) let_go();
    if (!s_.loose.is_loose() && !stand()) let_go();
    if (s_.loose.is_loose()) s_.loose.fall(s_.equation, s_.tracked, s_.actuation);
    s_.record.control(s_.standing.added(), 1.0 / setup_.ticks_per_frame);
  }

  bool stand() {
    return s_.standing.stand(s_.equation, s_.contacts, s_.tracked, s_.leg_stops.at_ends(), s_.record, s_.actuation);
  }

  // Planned soles that lie flat and still take the weight again, if it is above them.
  void try_to_stand() {
    s_.equation.find_bias();
    if (!s_.contacts.land_flat(frame_time_, s_.equation.dynamics)) return;
    s_.velocity_before = state_.velocity;
    s_.contacts.find_rows(s_.equation, s_.equation.still);
    s_.equation.find_factors();
    s_.contacts.stop(s_.equation);
    if (s_.standing.could_stand(s_.equation, s_.contacts)) return s_.loose.take_hold();
    state_.velocity = s_.velocity_before;
    s_.contacts.release();
  }

  void move() {
    const bool is_loose = s_.loose.is_loose();
    const SpatialForce momentum =
        is_loose ? momentum_of(body_, s_.equation.dynamics, s_.equation.mass, state_.velocity) : SpatialForce{};
    add_scaled(tick_s_, s_.actuation.acceleration, state_.velocity);
    if (is_loose)
      move_loosely(momentum);
    else
      stop_joints();
    if (stop_racing(body_, figure_.fastest, state_.velocity) && is_loose) s_.loose.keep_way(s_.equation);
    integrate(body_, state_.velocity, tick_s_, state_.root, state_.coords);
    if (is_loose) put_balls_inside(character_, body_, state_);
    put_legs_inside(character_, body_, s_.contacts.feet().stands_by_dof(), state_);
  }

  void stop_joints() {
    if (is_disturbed()) s_.bodies.stop(s_.equation, tick_s_, state_.velocity);
    s_.leg_stops.clear();
    if (is_dynamic() && is_disturbed() && !s_.contacts.feet().none()) stop_legs();
    stop_at_ends(character_, body_, s_.contacts.feet().stands_by_dof(), tick_s_, state_);
  }

  void stop_legs() {
    s_.leg_stops.find_hinges(character_, body_, s_.contacts.feet().stands_by_dof(), target_coords());
    s_.leg_stops.stop(s_.contacts.support(), s_.contacts.sole_count(), s_.actuation.forces[1], tick_s_, s_.equation);
  }

  void move_loosely(const SpatialForce& momentum) {
    s_.loose.move(character_, s_.equation, setup_.touches, s_.bodies.contacts(), environment_, momentum);
    record_footing();
  }

  // In the last frame, which is not left. A figure that has let go just now has found no contacts yet.
  void look_at_footing() {
    if (s_.loose.knows_contacts()) return record_footing();
    s_.velocity_before = state_.velocity;
    const SpatialForce momentum = momentum_of(body_, s_.equation.dynamics, s_.equation.mass, state_.velocity);
    add_scaled(tick_s_, s_.actuation.acceleration, state_.velocity);
    move_loosely(momentum);
    state_.velocity = s_.velocity_before;
  }

  void record_footing() {
    s_.record.footing(s_.loose.footing(state_.root.q, motion_.response.target_root[at(frame_)].q));
  }

  const Character& character_;
  const DynamicsSetup& setup_;
  const DynamicFigure& figure_;
  const Multibody& body_;
  const Environment& environment_;
  const ContactPlan& plan_;
  const BalancePlan& balance_;
  SimulationScratch& s_;
  FigureState& state_;
  Motion& motion_;
  TargetMotion target_;
  double tick_s_;
  bool feels_load_;
  TrackScratch track_;
  double frame_time_ = 0.0;
  int struck_frame_ = -1;  // the last blow's; -1: none yet
  int frame_ = 0;
};

}  // namespace

void simulate(const Character& character, const DynamicsSetup& setup, const Environment& environment,
              SimulationScratch& scratch, Motion& motion) {
  const std::vector<Leg> legs = find_legs(character);
  soften_legs(character, setup.figure, legs, environment, setup.easy, motion);
  keep_enough_feet(character, legs, setup.figure, environment, motion);
  ContactPlan plan(character, setup.figure, environment, motion);
  const BalancePlan balance = make_possible(character, setup.figure, setup.easy, plan, setup.ticks_per_frame, motion);
  plan.move_airborne(character, setup.figure, motion);
  Simulation(character, setup, environment, plan, balance, scratch, motion).run();
}

}  // namespace contort
