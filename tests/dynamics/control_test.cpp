// Ground, relief and impacts one by one, on a human in a squat with 8 kg on its back.
#include "generator/dynamics/control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "generator/dynamics/feet.h"
#include "generator/dynamics/impact.h"
#include "generator/dynamics/linear.h"
#include "generator/dynamics/strength.h"
#include "generator/dynamics/tracker.h"
#include "tests/dynamics/states.h"
#include "tests/generator/scenes_of_one.h"

namespace contort {
namespace {

using fixtures::use;

// All results of a tick before control begins, in a pose of a squat with random velocities and accelerations.
class Tick {
 public:
  explicit Tick(std::uint64_t seed, double load_kg = 8.0) {
    const Character& character = fixtures::human();
    Spec spec;
    spec.sequences = {
        fixtures::sequence({use("squat", "waist", 0, 60, {{"share", 0.25}, {"lean_deg", 35.0}, {"back_m", 0.15}})})};
    const Stage stage = *build_stage(spec, fixtures::shared_human());
    std::vector<Load> loads;
    if (load_kg > 0.0)
      loads = {box_load(character.find_joint("torso/lumbar_rot"), {kNoRotation, {0, 0.25, -0.2}}, {0.3, 0.4, 0.15},
                        load_kg)};
    figure = build_figure(character, stage.legs, loads);
    const TargetMotion target(figure.body, generate(stage));
    state = moving_start(figure.body, target);
    double unused[kRootDofs];
    target.root_at(28.0, state.root, unused);
    for (const Link& link : figure.body.links().subspan(1))
      target.joint_at(link, 28.0, &state.coords[static_cast<std::size_t>(link.coord)], unused);
    std::mt19937_64 random(seed);
    for (std::size_t k = kRootDofs; k < state.velocity.size(); ++k)
      state.velocity[k] = fixtures::between(random, -0.3, 0.3);
    prepare(random);
  }

  double effort(int dof) const { return ground.effort(dynamics, forces, dof); }
  std::size_t size() const { return state.velocity.size(); }

  DynamicFigure figure;
  FigureState state;
  DynamicsScratch dynamics;
  SupportRows support;
  SupportArea area;
  GroundShare ground;
  Feet feet;
  std::vector<LedSole> led;
  std::vector<double> mass, bias, acceleration, forces, ease;

 private:
  void prepare(std::mt19937_64& random) {
    const auto n = size();
    mass.assign(n * n, 0.0), bias.assign(n, 0.0), forces.assign(n, 0.0), acceleration.assign(n, 0.0);
    ease.assign(n, 1.0);
    std::fill_n(ease.begin(), kRootDofs, 1e3);
    place(figure.body, state.root, state.coords, dynamics);
    feet.begin(figure);
    for (int i = 0; i < 2; ++i) {
      const Sole& sole = figure.soles[static_cast<std::size_t>(i)];
      feet.put(i, {0xF, 1.0});
      led.push_back({sole.link, sole.link_from_sole, {sole_place(sole, dynamics)}});
    }
    find_rows();
    keep_still(ease, support, state.velocity);
    find_rows();
    for (std::size_t k = kRootDofs; k < n; ++k) acceleration[k] = fixtures::between(random, -2.0, 2.0);
    project_on_support(ease, support, acceleration);
    mass_matrix(figure.body, dynamics, mass);
    multiply(mass, acceleration, forces);
    for (std::size_t k = 0; k < n; ++k) forces[k] += bias[k];
    find_support_area(figure, feet, 0.0, dynamics, area);
    const std::vector<double> firm(figure.soles.size(), 1.0);
    ground.prepare(figure, feet, firm, dynamics);
  }

  void find_rows() {
    const std::vector<double> none(size(), 0.0);
    inverse_dynamics(figure.body, state.velocity, none, kGravity_m_s2, dynamics, bias);
    support_rows(figure.body, led, state.velocity, {}, 15.0, 0.0, dynamics, support);
    prepare_projection(ease, support);
  }
};

TEST(Ground, SharesOfTheSolesAddUpAndBalanceTheRoot) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Tick tick(seed);
    const SpatialForce net = ground_force(tick.dynamics, tick.forces);
    SpatialForce sum = tick.ground.share(0, net);
    sum += tick.ground.share(1, net);
    EXPECT_LT(length(Vec3(sum.force - net.force)), 1e-9 * (1 + length(Vec3(net.force))));
    EXPECT_LT(length(Vec3(sum.moment - net.moment)), 1e-9 * (1 + length(Vec3(net.moment))));
  }
}

// The moment that a sole gives beyond what its footprint allows, N m; infinite if it pulls with more than 1 N.
double moment_too_large_N_m(const Tick& tick, std::size_t i, const SpatialForce& share) {
  const Sole& sole = tick.figure.soles[i];
  const Rigid place = sole_place(sole, tick.dynamics), sole_from_link = inverse(sole.link_from_sole);
  Vec3 middle(0.0), half(0.0);
  for (const Vec3& corner : sole.corners_m) middle += sole_from_link * corner / 4.0;
  for (const Vec3& corner : sole.corners_m) half = glm::max(half, glm::abs(sole_from_link * corner - middle));
  const Vec3 from_root_m = place * middle - tick.dynamics.world[0].origin_m;
  const Vec3 force = glm::conjugate(place.q) * share.force;
  const Vec3 moment = glm::conjugate(place.q) * (share.moment - glm::cross(from_root_m, share.force));
  if (force.y < -1.0) return std::numeric_limits<double>::infinity();
  const double pressing_N = std::max(force.y, 0.0);
  return std::max(std::abs(moment.x) - pressing_N * half.z, std::abs(moment.z) - pressing_N * half.x);
}

// Moves the net force so that the zero moment point is anywhere in the support area: on a sole's heel, or below one
// sole alone.
TEST(Ground, EachSolePushesInsideItsOwnFootprint) {
  std::mt19937_64 random(5);
  int outside = 0, tried = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Tick tick(seed);
    for (Sole& sole : tick.figure.soles) sole.toes_N_m = sole.heel_N_m = sole.tilt_N_m = 1e9;
    for (int i = 0; i < 20; ++i) {
      std::vector<double> forces = tick.forces;
      for (int k = 3; k < kRootDofs; ++k) forces[static_cast<std::size_t>(k)] += fixtures::between(random, -80.0, 80.0);
      if (balance_of(tick.area, tick.dynamics, forces, 700.0).margin_m < 0.01) continue;
      const std::vector<double> firm{1.0, fixtures::between(random, 0.1, 1.0)};
      tick.ground.prepare(tick.figure, tick.feet, firm, tick.dynamics);
      const SpatialForce net = ground_force(tick.dynamics, forces);
      for (std::size_t s = 0; s < 2; ++s) outside += moment_too_large_N_m(tick, s, tick.ground.share(s, net)) > 1.0;
      tick.ground.follow_load(tick.dynamics, forces);
      SpatialForce sum;
      for (std::size_t s = 0; s < 2; ++s) {
        const SpatialForce share = tick.ground.share(s, net);
        sum += share;
        EXPECT_LT(moment_too_large_N_m(tick, s, share), 0.5) << "seed " << seed << ", force " << i << ", sole " << s;
      }
      EXPECT_LT(length(Vec3(sum.moment - net.moment)), 1e-6 * (1 + length(Vec3(net.moment))));
      ++tried;
    }
  }
  EXPECT_GT(tried, 100);
  EXPECT_GT(outside, 20);  // before the division is fitted to the forces
}

TEST(Ground, AWeakAnkleLeavesWhatIsTooMuchForItToTheOther) {
  Tick tick(3);
  const auto prepare = [&] {
    tick.ground.prepare(tick.figure, tick.feet, std::vector<double>(2, 1.0), tick.dynamics);
    tick.ground.follow_load(tick.dynamics, tick.forces);
  };
  const auto flex = [&](std::size_t i) {
    double most = 0.0;
    for (const int dof : tick.figure.soles[i].ankle_dofs) most = std::max(most, std::abs(tick.effort(dof)));
    return most;
  };
  tick.forces[3] -= 60.0;  // the zero moment point comes nearer to the toes
  prepare();
  const double left = flex(0), right = flex(1);
  ASSERT_GT(left, 30.0);
  tick.figure.soles[0].toes_N_m = tick.figure.soles[0].heel_N_m = 0.7 * left;
  prepare();
  EXPECT_LT(flex(0), 0.75 * left);
  EXPECT_GT(flex(1), right);
}

// Efforts and the soles' forces fed back into the equation of motion give the accelerations that they were found for.
TEST(Ground, EffortsAndSharesMoveTheFigureAsItWasAsked) {
  Tick tick(7);
  std::vector<double> push(tick.size());
  tick.ground.efforts(tick.dynamics, tick.forces, push);
  const SpatialForce net = ground_force(tick.dynamics, tick.forces);
  for (std::size_t i = 0; i < 2; ++i) {
    const SpatialForce share = tick.ground.share(i, net);
    for (int k = 0; k < tick.figure.body.dof_count(); ++k) {
      const bool in_chain = k < kRootDofs || std::ranges::count(tick.figure.soles[i].chain_dofs, k) > 0;
      if (in_chain)
        push[static_cast<std::size_t>(k)] += dot(tick.dynamics.freedoms[static_cast<std::size_t>(k)], share);
    }
  }
  for (std::size_t k = 0; k < push.size(); ++k) push[k] -= tick.bias[k];
  std::vector<double> factors = tick.mass;
  factorise(tick.figure.body, factors);
  solve(tick.figure.body, factors, push);
  for (std::size_t k = 0; k < push.size(); ++k) EXPECT_NEAR(push[k], tick.acceleration[k], 1e-8) << k;
}

// On level ground the margin is the ZMP's distance to the nearest side of the rectangle around both soles.
TEST(Ground, TheMarginIsTheDistanceFromTheHull) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Tick tick(seed);
    const Balance balance =
        balance_of(tick.area, tick.dynamics, tick.forces, kGravity_m_s2 * tick.figure.body.mass_kg());
    double low_x = 1e9, high_x = -1e9, low_z = 1e9, high_z = -1e9;
    for (const Vec3& corner : tick.area.corners_m) {
      low_x = std::min(low_x, corner.x), high_x = std::max(high_x, corner.x);
      low_z = std::min(low_z, corner.z), high_z = std::max(high_z, corner.z);
    }
    const Vec3& p = balance.zmp_m;
    EXPECT_NEAR(balance.margin_m, std::min({p.x - low_x, high_x - p.x, p.z - low_z, high_z - p.z}), 1e-6);
  }
}

// The change asked of the groups takes effort away where it was too much, summed over all that were overloaded.
TEST(Control, ReliefNeverAddsToAnOverload) {
  int relieved = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Tick tick(seed, 20.0);
    std::vector<double> before;
    for (const int dof : tick.figure.watched) before.push_back(tick.effort(dof));
    DynamicControl control;
    control.begin(tick.figure, 1.0 / 120);
    const SupportArea endless;  // balance requires nothing
    control.correct({tick.figure, tick.dynamics, tick.mass, tick.feet.stands_by_dof(), tick.support, endless,
                     tick.ground, kGravity_m_s2 * tick.figure.body.mass_kg(), tick.acceleration, tick.forces});
    double change = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const int dof = tick.figure.watched[i];
      const double most = std::max(-tick.figure.strength_low[static_cast<std::size_t>(dof)],
                                   tick.figure.strength_high[static_cast<std::size_t>(dof)]);
      if (std::fabs(before[i]) < 0.3 * most) continue;
      change += (tick.effort(dof) - before[i]) * before[i] / (most * most);
    }
    relieved += change < 0.0;
    EXPECT_LE(change, 1e-12) << seed;
  }
  EXPECT_GT(relieved, 20);
}

TEST(Control, WithoutLoadsItActsExactlyWhereTheMarginIsLost) {
  int kept = 0, lost = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Tick tick(seed, 0.0);
    const double weight_N = kGravity_m_s2 * tick.figure.body.mass_kg();
    const double margin_m = balance_of(tick.area, tick.dynamics, tick.forces, weight_N).margin_m;
    const std::vector<double> before = tick.acceleration;
    DynamicControl control;
    control.begin(tick.figure, 1.0 / 120);
    control.correct({tick.figure, tick.dynamics, tick.mass, tick.feet.stands_by_dof(), tick.support, tick.area,
                     tick.ground, weight_N, tick.acceleration, tick.forces});
    EXPECT_EQ(before == tick.acceleration, margin_m >= 0.01) << seed;
    if (margin_m < 0.01) {
      EXPECT_GT(balance_of(tick.area, tick.dynamics, tick.forces, weight_N).margin_m, margin_m) << seed;
    }
    (margin_m < 0.01 ? lost : kept) += 1;
  }
  EXPECT_GT(kept, 3);
  EXPECT_GT(lost, 3);
}

// Repeats the same tick, because the result of control comes in with its lags.
double margin_after(Tick& tick, int ticks) {
  const double weight_N = kGravity_m_s2 * tick.figure.body.mass_kg();
  const std::vector<double> acceleration = tick.acceleration, forces = tick.forces;
  DynamicControl control;
  control.begin(tick.figure, 1.0 / 120);
  for (int i = 0; i < ticks; ++i) {
    tick.acceleration = acceleration, tick.forces = forces;
    control.correct({tick.figure, tick.dynamics, tick.mass, tick.feet.stands_by_dof(), tick.support, tick.area,
                     tick.ground, weight_N, tick.acceleration, tick.forces});
  }
  const double margin_m = balance_of(tick.area, tick.dynamics, tick.forces, weight_N).margin_m;
  tick.acceleration = acceleration, tick.forces = forces;
  return margin_m;
}

// In one system of equations with one price, relief of a heavy load would be worth a lost balance.
TEST(Control, ReliefIsNeverPaidForWithBalance) {
  int lost = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Tick tick(seed, 8.0);
    if (margin_after(tick, 0) > 0.0 || margin_after(tick, 0) < -0.05) continue;
    ++lost;
    EXPECT_GT(margin_after(tick, 60), 0.0) << seed;
  }
  EXPECT_GT(lost, 5);
}

// With the lag of relief, 0.08 s, a third of the missing margin would be back after 33 ms.
TEST(Control, BalanceIsBackWithinFourTicks) {
  int lost = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    Tick tick(seed, 0.0);
    const double before_m = margin_after(tick, 0), after_m = margin_after(tick, 4), end_m = margin_after(tick, 60);
    if (before_m > 0.0 || end_m < 0.005) continue;
    ++lost;
    EXPECT_GT(after_m, before_m + 0.8 * (end_m - before_m)) << seed;
  }
  EXPECT_GT(lost, 5);
}

// Arms that swing forward load the knees: to watch these too would make both fight.
TEST(Control, KneesAreNotRelieved) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Tick tick(seed, 20.0), weak(seed, 20.0);
    for (const Sole& sole : weak.figure.soles)
      for (const int dof : sole.leg_dofs) {
        const Link& link =
            weak.figure.body.links()[static_cast<std::size_t>(fixtures::human().find_joint("leg_left/knee"))];
        const Link& other =
            weak.figure.body.links()[static_cast<std::size_t>(fixtures::human().find_joint("leg_right/knee"))];
        if (dof != link.dof && dof != other.dof) continue;
        weak.figure.strength_low[static_cast<std::size_t>(dof)] *= 0.05;
        weak.figure.strength_high[static_cast<std::size_t>(dof)] *= 0.05;
      }
    const SupportArea endless;
    for (Tick* t : {&tick, &weak}) {
      DynamicControl control;
      control.begin(t->figure, 1.0 / 120);
      control.correct({t->figure, t->dynamics, t->mass, t->feet.stands_by_dof(), t->support, endless, t->ground,
                       kGravity_m_s2 * t->figure.body.mass_kg(), t->acceleration, t->forces});
    }
    EXPECT_EQ(tick.acceleration, weak.acceleration) << seed;
  }
}

TEST(Control, HandlesLeaveStandingSolesWhereTheyAre) {
  Tick tick(5);
  prepare_keep_feet(tick.feet.stands_by_dof(), tick.support);
  for (const ControlGroup& group : tick.figure.groups)
    for (const Handle& handle : group.handles) {
      std::vector<double> change(tick.size(), 0.0), soles(static_cast<std::size_t>(tick.support.count));
      change[static_cast<std::size_t>(handle.dof)] = 1.0;
      if (group.moves_feet) keep_feet(tick.feet.stands_by_dof(), tick.support, change);
      soles_moved_by(tick.support, change, soles);
      for (const double moved : soles) EXPECT_NEAR(moved, 0.0, 1e-4) << group.name;
    }
}

// Plastic impact: soles stay, and the ground's impulse is the only difference in momentum.
TEST(Impact, SolesStayAndMomentumIsTheBlowsAndTheGrounds) {
  Tick tick(9);
  std::vector<double> factors = tick.mass, change(tick.size(), 0.0);
  factorise(tick.figure.body, factors);
  const Impact blow{0, fixtures::human().find_joint("arm_left/shoulder"), {0, -0.1, 0}, {2, 1, -5}};
  add_impulse(tick.figure.body, tick.dynamics, blow, change);
  std::vector<double> stay(static_cast<std::size_t>(tick.support.count));
  soles_moved_by(tick.support, tick.state.velocity, stay);
  for (double& v : stay) v = -v;
  ResponseScratch response;
  respond(tick.figure.body, factors, tick.support, stay, response, change);
  std::vector<double> after = tick.state.velocity, moved(stay.size()), momentum(tick.size());
  for (std::size_t k = 0; k < after.size(); ++k) after[k] += change[k];
  soles_moved_by(tick.support, after, moved);
  for (const double v : moved) EXPECT_NEAR(v, 0.0, 1e-9);
  multiply(tick.mass, change, momentum);
  Vec3 given = blow.impulse_N_s;
  for (std::size_t f = 0; f < 2; ++f)
    given += Vec3(response.push[6 * f], response.push[6 * f + 1], response.push[6 * f + 2]);
  EXPECT_LT(length(given - Vec3(momentum[0], momentum[1], momentum[2])), 1e-9);
}

TEST(Impact, BracingKeepsTheMomentumAndNoJointIsFasterThanItCanBe) {
  Tick tick(11);
  std::vector<double> factors = tick.mass, change(tick.size(), 0.0), stiff(tick.size(), 0.0), forces(tick.size(), 0.0);
  factorise(tick.figure.body, factors);
  const Impact blow{0, fixtures::human().find_joint("arm_left/elbow"), {0, -0.2, 0}, {0, 0, 60}};
  add_impulse(tick.figure.body, tick.dynamics, blow, change);
  const std::vector<double> impulse = change;
  solve(tick.figure.body, factors, change);
  // The stiff figure: its root alone answers.
  std::vector<double> matrix(kRootDofs * kRootDofs);
  for (std::size_t i = 0; i < kRootDofs; ++i)
    for (std::size_t j = 0; j <= i; ++j) matrix[i * kRootDofs + j] = tick.mass[i * tick.size() + j];
  std::copy_n(impulse.begin(), kRootDofs, stiff.begin());
  solve_symmetric(matrix, kRootDofs, std::span(stiff).first(kRootDofs));
  brace(tick.state.velocity, stiff, tick.figure.fastest, change);
  multiply(tick.mass, change, forces);
  for (std::size_t k = 0; k < kRootDofs; ++k) EXPECT_NEAR(forces[k], impulse[k], 1e-8 * (1 + std::fabs(impulse[k])));
  double closest = 1e9;
  for (std::size_t k = kRootDofs; k < change.size(); ++k) {
    const double room = tick.figure.fastest[k] - std::fabs(tick.state.velocity[k] + change[k]);
    EXPECT_GT(room, -1e-9) << k;
    closest = std::min(closest, room);
  }
  EXPECT_LT(closest, 1e-6);  // it was needed, and no more was taken than needed
}

TEST(Strength, TheShareEndsAtTheFirstLimit) {
  Tick tick(13);
  std::vector<double> hold(tick.size(), 0.0), efforts(tick.size(), 0.0);
  const auto knee = static_cast<std::size_t>(tick.figure.soles[0].leg_dofs[3]);
  efforts[knee] = 2.0 * tick.figure.strength_high[knee];
  efforts[knee + 1] = 4.0 * tick.figure.strength_low[knee + 1];
  EXPECT_TRUE(exceeds_strength(tick.figure, efforts));
  EXPECT_NEAR(affordable_share(tick.figure, hold, efforts), 0.25, 1e-12);
  hold[knee] = 1.5 * tick.figure.strength_high[knee];
  EXPECT_EQ(affordable_share(tick.figure, hold, efforts), 0.0);
}

}  // namespace
}  // namespace contort
