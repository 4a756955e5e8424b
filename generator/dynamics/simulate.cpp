#include "generator/dynamics/simulate.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/closed_chain.h"
#include "generator/dynamics/joint_ends.h"
#include "generator/dynamics/linear.h"
#include "generator/dynamics/racing.h"
#include "generator/dynamics/strength.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kRootEase = 1e3;        // against a joint's 1: the root goes where the legs say
constexpr double kFootStiffness = 15.0;  // rad/s, of soles that have drifted
constexpr double kLandingGap_m = 0.03;   // a sole that is meant to stand and is nearer than this has landed
constexpr double kEdge_m = 0.005;        // of the zero moment point from the edge, for which tracking gives way
constexpr double kTips_m = 0.03;         // the zero moment point this far outside cannot be brought back
constexpr double kTips_s = 0.2;          // nor one that is outside for so long
constexpr double kBlow_s = 0.02;         // a blow takes so long: what weight presses on a foot meanwhile holds it
constexpr double kLying_cos = 0.5;       // a trunk 60 degrees from its target's up has fallen
constexpr double kLimp_per_s = 10.0;     // damping of joints after a fall

class Simulation {
 public:
  Simulation(const Character& character, const DynamicsSetup& setup, const Environment& environment,
             SimulationScratch& scratch, Motion& motion)
      : character_(character),
        setup_(setup),
        figure_(setup.figure),
        body_(setup.figure.body),
        environment_(environment),
        s_(scratch),
        motion_(motion),
        target_(setup.figure.body, motion),
        planned_(planned_stances(character, setup.figure, environment, motion)),
        tick_s_(1.0 / (motion.rate_hz * setup.ticks_per_frame)),
        weight_N_(kGravity_m_s2 * setup.figure.body.mass_kg()) {
    target_.share_knots(closed_chain(setup.figure));
  }

  void run() {
    prepare();
    for (frame_ = 0; frame_ < motion_.frame_count; ++frame_) {
      store_pose();
      s_.record.begin_frame(frame_, planned_[at(frame_)]);
      for (const Blow& blow : setup_.blows)
        if (blow.frame == frame_) strike(blow);
      place_figure();
      soften(figure_, planned_, frame_, motion_.rate_hz, s_.firmness, s_.ease);
      if (!loose_) plan_feet(false);
      // The last frame is looked at, but not left.
      const bool last = frame_ + 1 == motion_.frame_count;
      for (int i = 0; i < (last ? 1 : setup_.ticks_per_frame); ++i) tick(i, !last);
      s_.record.end_frame(s_.feet.soles());
    }
  }

 private:
  void prepare() {
    const auto n = at(body_.dof_count());
    for (std::vector<double>* row : {&s_.tracked, &s_.acceleration, &s_.forces, &s_.bias, &s_.efforts, &s_.hold,
                                     &s_.hold_forces, &s_.hold_efforts})
      row->assign(n, 0.0);
    s_.mass.assign(n * n, 0.0);
    s_.factors.assign(n * n, 0.0);
    s_.record.begin(motion_, body_.dof_count());
    s_.state = standing_start(body_, target_);
    s_.control.begin(figure_, tick_s_);
    s_.feet.begin(figure_);
    s_.ease.assign(n, 1.0);
    std::fill_n(s_.ease.begin(), kRootDofs, kRootEase);
    s_.firmness.assign(figure_.soles.size(), 1.0);
    frame_ = 0;
    soften(figure_, planned_, frame_, motion_.rate_hz, s_.firmness, s_.ease);
    place_figure();
    plan_feet(true);
  }

  void store_pose() {
    motion_.root[at(frame_)] = s_.state.root;
    std::copy(s_.state.coords.begin(), s_.state.coords.end(), motion_.row(frame_).begin());
  }

  bool is_dynamic() const { return setup_.mode == Mode::dynamic; }
  void place_figure() { place(body_, s_.state.root, s_.state.coords, s_.dynamics); }

  // ---- feet

  bool is_planned(int sole) const { return (planned_[at(frame_)] >> sole & 1) != 0; }
  int sole_count() const { return static_cast<int>(figure_.soles.size()); }

  void land(int sole) { s_.feet.land(sole, footprint(figure_.soles[at(sole)], s_.dynamics, environment_)); }

  void let_go() {
    s_.feet.clear();
    s_.control.rest();
    loose_ = true;
    has_momentum_ = false;
    outside_s_ = 0.0;
  }

  // Lifts and lands feet as the target does. A foot that is still high in the air lands later.
  void plan_feet(bool at_once) {
    bool changed = false;
    for (int i = 0; i < sole_count(); ++i) {
      const bool stands = s_.feet.stands(i), shall = is_planned(i);
      const bool lands =
          shall && !stands && (at_once || gap_m(figure_.soles[at(i)], s_.dynamics, environment_) < kLandingGap_m);
      if (stands && !shall) s_.feet.lift(i);
      if (lands) land(i);
      changed = changed || lands || (stands && !shall);
    }
    if (!changed) return;
    s_.control.rest();
    if (!s_.feet.none()) {
      find_rows();
      stop_feet(s_.ease, s_.support, s_.state.velocity);
    } else if (is_dynamic() && sole_count() > 0) {
      let_go();
    }
  }

  // The forces of no acceleration at all, with the velocities and accelerations of all links.
  void find_bias() {
    std::ranges::fill(s_.hold, 0.0);
    inverse_dynamics(body_, s_.state.velocity, s_.hold, kGravity_m_s2, s_.dynamics, s_.bias);
  }

  // And what standing feet ask.
  void find_rows() {
    find_bias();
    support_rows(body_, s_.feet.places(), s_.state.velocity, kFootStiffness, kGravity_m_s2, s_.dynamics, s_.support);
  }

  // ---- blows

  void strike(const Blow& blow) {
    place_figure();
    mass_matrix(body_, s_.dynamics, s_.mass);
    s_.factors = s_.mass;
    factorise(body_, s_.factors);
    const Placement& link = s_.dynamics.world[at(blow.link)];
    s_.record.impact({frame_, blow.link, link.origin_m + link.rotation * blow.point_m, blow.impulse_N_s});
    std::vector<double>& change = s_.acceleration;
    answer(blow, change);
    if (is_dynamic() && pulls_a_foot()) {
      let_go();
      answer(blow, change);
    }
    find_stiff_answer(blow, s_.hold);
    brace(s_.state.velocity, s_.hold, figure_.fastest, change);
    for (std::size_t k = 0; k < change.size(); ++k) s_.state.velocity[k] += change[k];
    s_.control.rest();
    has_momentum_ = false;
  }

  // The change of velocity with joints that do not resist and feet that stay.
  void answer(const Blow& blow, std::span<double> change) {
    find_rows();
    std::ranges::fill(change, 0.0);
    add_impulse(body_, s_.dynamics, blow, change);
    std::vector<double>& stay = s_.support.wanted;
    soles_moved_by(s_.support, s_.state.velocity, stay);
    for (double& speed : stay) speed = -speed;
    respond(body_, s_.factors, s_.support, stay, s_.response, change);
  }

  bool pulls_a_foot() const {
    const auto feet = s_.feet.soles().size();
    for (std::size_t i = 0; i < feet; ++i)
      if (s_.response.push[6 * i + 1] < -weight_N_ * kBlow_s / static_cast<double>(feet)) return true;
    return false;
  }

  // With joints that do not move: none at all on its feet.
  void find_stiff_answer(const Blow& blow, std::span<double> change) {
    std::ranges::fill(change, 0.0);
    if (!s_.feet.none()) return;
    std::ranges::fill(s_.forces, 0.0);
    add_impulse(body_, s_.dynamics, blow, s_.forces);
    for (double& impulse : s_.forces) impulse = -impulse;
    fall_freely(body_, s_.mass, s_.loose, change, s_.forces);
  }

  // ---- a tick

  void tick(int index, bool moves) {
    place_figure();
    const double frame = frame_ + static_cast<double>(index) / setup_.ticks_per_frame;
    track(body_, target_, frame, tick_s_, s_.state, s_.tracked);
    slow_at_ends(character_, body_, s_.feet.stands_by_dof(), s_.state, tick_s_, s_.tracked);
    if (is_dynamic()) {
      mass_matrix(body_, s_.dynamics, s_.mass);
      if (loose_) carry_momentum();
      if (loose_ && !fallen_) try_to_stand();
      if (loose_ || !stand()) fall();
      s_.record.control(s_.control.added(), 1.0 / setup_.ticks_per_frame);
    } else {
      follow();
    }
    s_.record.efforts(s_.efforts);
    if (moves) move();
    if (s_.after_tick) s_.after_tick();
  }

  // Tracking alone: what that takes is measured, and changes nothing. Feet that stay only while a joint races (a leg
  // that is to fold through itself) are let go.
  void follow() {
    find_rows();
    s_.acceleration = s_.tracked;
    project_on_support(s_.ease, s_.support, s_.acceleration);
    if (!s_.feet.none() && races(body_, figure_.fastest, s_.state.velocity, s_.acceleration, tick_s_)) {
      s_.feet.clear();
      s_.acceleration = s_.tracked;
    }
    inverse_dynamics(body_, s_.state.velocity, s_.acceleration, kGravity_m_s2, s_.dynamics, s_.forces);
    find_ground();
    if (!s_.feet.none()) s_.record.balance(balance_of(s_.area, s_.dynamics, s_.forces, weight_N_));
  }

  void find_ground() {
    find_support_area(figure_, s_.feet.soles(), s_.dynamics, s_.area);
    s_.ground.prepare(figure_, s_.feet.soles(), s_.firmness, s_.dynamics);
    s_.ground.efforts(figure_, s_.dynamics, s_.forces, s_.efforts);
  }

  void find_forces(std::span<const double> acceleration, std::span<double> forces) {
    multiply(s_.mass, acceleration, forces);
    for (std::size_t k = 0; k < forces.size(); ++k) forces[k] += s_.bias[k];
  }

  // Whether the ground can hold the figure; if not, it has let go.
  bool stand() {
    find_rows();
    s_.acceleration = s_.tracked;
    project_on_support(s_.ease, s_.support, s_.acceleration);
    find_forces(s_.acceleration, s_.forces);
    find_ground();
    s_.control.correct({figure_, s_.dynamics, s_.mass, s_.feet.stands_by_dof(), s_.support, s_.area, s_.ground,
                        weight_N_, s_.acceleration, s_.forces});
    s_.ground.efforts(figure_, s_.dynamics, s_.forces, s_.efforts);
    const bool tips = sole_count() > 0 && balance_of(s_.area, s_.dynamics, s_.forces, weight_N_).margin_m < kEdge_m;
    if (tips || exceeds_strength(figure_, s_.efforts)) hold_back();
    if (sole_count() == 0) return true;
    const Balance balance = balance_of(s_.area, s_.dynamics, s_.forces, weight_N_);
    s_.record.balance(balance);
    outside_s_ = balance.margin_m < 0.0 ? outside_s_ + tick_s_ : 0.0;
    if (balance.margin_m > -kTips_m && outside_s_ < kTips_s) return true;
    let_go();
    return false;
  }

  // Back towards holding still, as far as joints and ground cannot give more. Where even that is too much for a joint,
  // joints give what they have and the rest follows.
  void hold_back() {
    std::ranges::fill(s_.hold, 0.0);
    project_on_support(s_.ease, s_.support, s_.hold);
    find_forces(s_.hold, s_.hold_forces);
    s_.ground.efforts(figure_, s_.dynamics, s_.hold_forces, s_.hold_efforts);
    const double share = std::min(affordable_share(figure_, s_.hold_efforts, s_.efforts),
                                  balanced_share(s_.area, s_.hold_forces, s_.forces, kEdge_m));
    take_back(share);
    find_forces(s_.acceleration, s_.forces);
    s_.ground.efforts(figure_, s_.dynamics, s_.forces, s_.efforts);
    if (!exceeds_strength(figure_, s_.efforts)) return;
    s_.record.overpowered();
    s_.record.efforts(s_.efforts);
    clamp_to_strength(figure_, s_.efforts);
    s_.factors = s_.mass;
    factorise(body_, s_.factors);
    for (std::size_t k = 0; k < s_.efforts.size(); ++k) s_.acceleration[k] = s_.efforts[k] - s_.bias[k];
    respond(body_, s_.factors, s_.support, s_.support.wanted, s_.response, s_.acceleration);
    find_forces(s_.acceleration, s_.forces);
  }

  void take_back(double share) {
    for (std::size_t k = 0; k < s_.hold.size(); ++k)
      s_.acceleration[k] = s_.hold[k] + share * (s_.acceleration[k] - s_.hold[k]);
  }

  // ---- without standing

  void fall() {
    find_bias();
    s_.acceleration = s_.tracked;
    std::fill_n(s_.acceleration.begin(), kRootDofs, 0.0);
    if (fallen_)
      for (std::size_t k = kRootDofs; k < s_.acceleration.size(); ++k)
        s_.acceleration[k] = -std::min(kLimp_per_s, 0.5 / tick_s_) * s_.state.velocity[k];
    fly(s_.acceleration, s_.efforts);
    if (!exceeds_strength(figure_, s_.efforts)) return;
    fly(s_.hold, s_.hold_efforts);
    const double share = affordable_share(figure_, s_.hold_efforts, s_.efforts);
    take_back(share);
    for (std::size_t k = kRootDofs; k < s_.efforts.size(); ++k)
      s_.efforts[k] = s_.hold_efforts[k] + share * (s_.efforts[k] - s_.hold_efforts[k]);
  }

  // From the pose before to this one. Its moment is kept about a point of the world.
  void carry_momentum() {
    if (!has_momentum_) return;
    const SpatialForce here{momentum_.moment - glm::cross(s_.state.root.p_m, momentum_.force), momentum_.force};
    set_momentum(body_, s_.dynamics, s_.mass, here, s_.loose, s_.state.velocity);
  }

  // Joints go as they are told, weight and ground change the momentum, and the root follows from both.
  void move_loosely(SpatialForce momentum) {
    const SpatialForce weight = weight_of(s_.dynamics);
    momentum += {tick_s_ * weight.moment, tick_s_ * weight.force};
    set_momentum(body_, s_.dynamics, s_.mass, momentum, s_.loose, s_.state.velocity);
    push_off(figure_, setup_.touches, environment_, tick_s_, s_.dynamics, s_.loose, s_.state.velocity);
    momentum_ = momentum_of(body_, s_.dynamics, s_.mass, s_.state.velocity);
    momentum_.moment += glm::cross(s_.state.root.p_m, momentum_.force);
    has_momentum_ = true;
    see_how_it_lies();
  }

  // Root accelerations of free fall, and the efforts of the joints.
  void fly(std::span<double> acceleration, std::span<double> efforts) {
    find_forces(acceleration, efforts);
    fall_freely(body_, s_.mass, s_.loose, acceleration, efforts);
    std::fill_n(efforts.begin(), kRootDofs, 0.0);
  }

  // Planned soles that lie flat and still take the weight again, if it is above them.
  void try_to_stand() {
    find_bias();
    for (int i = 0; i < sole_count(); ++i)
      if (is_planned(i) && lies_still(figure_.soles[at(i)], s_.dynamics, environment_)) land(i);
    if (s_.feet.none()) return;
    s_.hold_efforts = s_.state.velocity;
    find_rows();
    stop_feet(s_.ease, s_.support, s_.state.velocity);
    find_rows();
    s_.acceleration = s_.tracked;
    project_on_support(s_.ease, s_.support, s_.acceleration);
    find_forces(s_.acceleration, s_.forces);
    find_support_area(figure_, s_.feet.soles(), s_.dynamics, s_.area);
    loose_ = balance_of(s_.area, s_.dynamics, s_.forces, weight_N_).margin_m < 0.0;
    if (!loose_) return;
    s_.state.velocity = s_.hold_efforts;
    s_.feet.clear();
  }

  // ---- moving on

  void move() {
    const SpatialForce momentum = loose_ ? momentum_of(body_, s_.dynamics, s_.mass, s_.state.velocity) : SpatialForce{};
    for (std::size_t k = 0; k < s_.acceleration.size(); ++k) s_.state.velocity[k] += tick_s_ * s_.acceleration[k];
    stop_at_ends(character_, body_, s_.feet.stands_by_dof(), tick_s_, s_.state);
    stop_racing(body_, figure_.fastest, s_.state.velocity);
    if (loose_) move_loosely(momentum);
    integrate(body_, s_.state.velocity, tick_s_, s_.state.root, s_.state.coords);
  }

  void see_how_it_lies() {
    bool on_sole = false, on_other = false;
    for (const LooseScratch::Contact& contact : s_.loose.contacts)
      if (contact.impulse[0] > 0.0) (contact.is_sole ? on_sole : on_other) = true;
    const Vec3 up = s_.state.root.q * Vec3(0, 1, 0);
    const Vec3 wanted = motion_.response.target_root[at(frame_)].q * Vec3(0, 1, 0);
    fallen_ = fallen_ || on_other || glm::dot(up, wanted) < kLying_cos;
    s_.record.footing(fallen_ ? Footing::fallen : on_sole ? Footing::tipping : Footing::airborne);
  }

  const Character& character_;
  const DynamicsSetup& setup_;
  const DynamicFigure& figure_;
  const Multibody& body_;
  const Environment& environment_;
  SimulationScratch& s_;
  Motion& motion_;
  TargetMotion target_;
  std::vector<std::uint8_t> planned_;
  double tick_s_;
  double weight_N_;
  int frame_ = 0;
  bool loose_ = false;
  bool fallen_ = false;
  bool has_momentum_ = false;
  SpatialForce momentum_;  // of a loose figure, about the world's origin
  double outside_s_ = 0.0;
};

}  // namespace

void simulate(const Character& character, const DynamicsSetup& setup, const Environment& environment,
              SimulationScratch& scratch, Motion& motion) {
  Simulation(character, setup, environment, scratch, motion).run();
}

}  // namespace contort
