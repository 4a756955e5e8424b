// Standing feet: rows are satisfied, and a tracked squat stays on its feet and near its target.
#include "generator/dynamics/support.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/dynamics/linear.h"
#include "generator/dynamics/tracker.h"
#include "generator/generate.h"
#include "model/motion/kinematics.h"
#include "model/motion/legs.h"
#include "tests/dynamics/states.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::use;

TEST(Support, ASymmetricSystemIsSolved) {
  std::mt19937_64 random(5);
  for (const int n : {1, 2, 6, 12, 24}) {
    const auto size = static_cast<std::size_t>(n);
    std::vector<double> root(size * size), matrix(size * size), x(size), b(size);
    for (double& v : root) v = fixtures::between(random, -1, 1);
    for (double& v : x) v = fixtures::between(random, -1, 1);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t k = 0; k < size; ++k) matrix[i * size + j] += root[i * size + k] * root[j * size + k];
        matrix[i * size + j] += i == j ? 0.1 : 0.0;
        b[i] += matrix[i * size + j] * x[j];
      }
    solve_symmetric(matrix, n, b);
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(b[i], x[i], 1e-9);
  }
}

TEST(Support, DependentRowsGiveNoInfinity) {
  std::vector<double> matrix = {4, 4, 2, 4, 4, 2, 2, 2, 1};
  std::vector<double> x = {4, 4, 2};
  solve_symmetric(matrix, 3, x);
  for (const double v : x) EXPECT_TRUE(std::isfinite(v));
  EXPECT_NEAR(4 * x[0] + 4 * x[1] + 2 * x[2], 4.0, 1e-6);
}

std::vector<LedSole> feet_of(const Character& character, std::span<const Rigid> world) {
  std::vector<LedSole> feet;
  for (const Leg& leg : find_legs(character)) {
    const Socket& sole = character.sockets()[static_cast<std::size_t>(leg.sole)];
    feet.push_back({sole.joint, sole.joint_from_socket, {world_from_socket(character, world, leg.sole)}});
  }
  return feet;
}

TEST(Support, ProjectedAccelerationsKeepTheFeet) {
  const std::pair<Character, double> standing[] = {{fixtures::human(), 1e-9},
                                                   {fixtures::built({"quadruped", {}, {}}), 1e-9}};
  for (const auto& [character, gate] : standing) {
    const Multibody body = Multibody::of(character);
    std::mt19937_64 random(11);
    for (int i = 0; i < 50; ++i) {
      const fixtures::DynamicsState state = fixtures::any_state(body, random);
      DynamicsScratch scratch;
      place(body, state.root, state.coords, scratch);
      std::vector<Rigid> world(character.joints().size());
      forward_kinematics(character, state.root, state.coords, world);
      SupportRows support;
      std::vector<double> none(state.velocity.size(), 0.0), forces(state.velocity.size());
      inverse_dynamics(body, state.velocity, none, kGravity_m_s2, scratch, forces);
      support_rows(body, feet_of(character, world), state.velocity, {}, 15.0, 0.0, scratch, support);
      std::vector<double> acceleration = state.acceleration;
      std::vector<double> ease(acceleration.size(), 1.0);
      std::fill_n(ease.begin(), kRootDofs, 1e3);
      prepare_projection(ease, support);
      project_on_support(ease, support, acceleration);
      std::vector<double> met(support.wanted.size());
      soles_moved_by(support, acceleration, met);
      for (std::size_t r = 0; r < met.size(); ++r)
        EXPECT_NEAR(met[r], support.wanted[r], gate * (1.0 + std::fabs(support.wanted[r]))) << i << " " << r;
    }
  }
}

struct Tracked {
  double worst_rad = 0.0;  // greatest distance of any hinge from its target
  double drift_m = 0.0;    // greatest drift of a sole
};

// A squat of 1.5 s on flat feet and a second of rest at 30 Hz.
Stage squat() {
  Spec spec;
  spec.rate_hz = 30.0;
  spec.hold_frames = 30;
  spec.sequences = {
      fixtures::sequence({use("squat", "waist", 0, 45, {{"share", 0.3}, {"lean_deg", 25.0}, {"back_m", 0.12}})})};
  const Result<Stage> stage = build_stage(spec, stock_library());
  EXPECT_TRUE(stage.ok());
  return *stage;
}

// The root and all joints of legs and feet: one chain while both feet stand.
std::vector<int> closed_chain(const Character& character, std::span<const Leg> legs) {
  std::vector<int> links = {0};
  for (const Leg& leg : legs)
    for (int j = 1; j < static_cast<int>(character.joints().size()); ++j) {
      const int part = character.joints()[static_cast<std::size_t>(j)].part;
      if (part == leg.part || part == leg.foot_part) links.push_back(j);
    }
  return links;
}

class Squat {
 public:
  explicit Squat(int ticks)
      : stage_(squat()),
        body_(Multibody::of(*stage_.character)),
        target_(body_, generate(stage_)),
        ticks_(ticks),
        tick_s_(1.0 / (30.0 * ticks)) {
    target_.share_knots(closed_chain(*stage_.character, stage_.legs));
    state_ = moving_start(body_, target_);
    world_.resize(stage_.character->joints().size());
    place_all();
    feet_ = feet_of(*stage_.character, world_);
  }

  Tracked tracked() {
    Tracked out;
    std::vector<double> acceleration(state_.velocity.size());
    for (int i = 0; i < target_.last_frame() * ticks_; ++i) {
      track(body_, target_, static_cast<double>(i) / ticks_, tick_s_, {}, state_, track_, acceleration);
      place(body_, state_.root, state_.coords, scratch_);
      std::vector<double> none(state_.velocity.size(), 0.0), forces(state_.velocity.size());
      inverse_dynamics(body_, state_.velocity, none, 0.0, scratch_, forces);
      support_rows(body_, feet_, state_.velocity, {}, 15.0, 0.0, scratch_, support_);
      std::vector<double> ease(acceleration.size(), 1.0);
      std::fill_n(ease.begin(), kRootDofs, 1e3);
      prepare_projection(ease, support_);
      project_on_support(ease, support_, acceleration);
      advance(body_, acceleration, tick_s_, state_);
      measure(static_cast<double>(i + 1) / ticks_, out);
    }
    return out;
  }

 private:
  void place_all() { forward_kinematics(*stage_.character, state_.root, state_.coords, world_); }

  void measure(double frame, Tracked& out) {
    place_all();
    for (const LedSole& foot : feet_) {
      const Rigid now = world_[static_cast<std::size_t>(foot.link)] * foot.link_from_sole;
      out.drift_m = std::max(out.drift_m, length(now.p_m - foot.wanted.world_from_sole.p_m));
    }
    for (const Link& link : body_.links().subspan(1)) {
      double goal[4], rates[3];
      target_.joint_at(link, frame, goal, rates);
      if (link.kind != JointKind::ball)
        out.worst_rad =
            std::max(out.worst_rad, std::fabs(goal[0] - state_.coords[static_cast<std::size_t>(link.coord)]));
    }
  }

  Stage stage_;
  Multibody body_;
  TargetMotion target_;
  int ticks_;
  double tick_s_;
  FigureState state_;
  TrackScratch track_;
  std::vector<Rigid> world_;
  std::vector<LedSole> feet_;
  DynamicsScratch scratch_;
  SupportRows support_;
};

TEST(Support, ATrackedSquatStaysOnItsFeetAndNearItsTarget) {
  for (const int ticks : {1, 2, 4}) {
    const Tracked tracked = Squat(ticks).tracked();
    std::printf("%d ticks a frame: %.2f deg from the target, soles drift %.2f mm\n", ticks,
                tracked.worst_rad / kRadPerDeg, 1e3 * tracked.drift_m);
    EXPECT_LT(tracked.worst_rad, (ticks == 1 ? 7.0 : 4.0) * kRadPerDeg);
    EXPECT_LT(tracked.drift_m, 6e-3);
  }
}

}  // namespace
}  // namespace contort
