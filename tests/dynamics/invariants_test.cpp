// Laws that dynamics must keep, on the stock characters and on random trees; gates from measurements of a prototype.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/character/stock.h"
#include "tests/dynamics/articulated_body.h"
#include "tests/dynamics/random_tree.h"
#include "tests/dynamics/states.h"

namespace contort {
namespace {

using fixtures::any_state;
using fixtures::any_vec;
using fixtures::between;
using fixtures::DynamicsState;
using fixtures::random_tree;

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::fabs(value));
  return most;
}

// All data of one state, computed once.
class Scene {
 public:
  Scene(const Character& character, std::uint64_t seed) : body_(Multibody::of(character)), random_(seed) {
    state_ = any_state(body_, random_);
    place(body_, state_.root, state_.coords, scratch_);
  }
  std::size_t n() const { return static_cast<std::size_t>(body_.dof_count()); }
  std::vector<double> forces(std::span<const double> acceleration, double gravity_m_s2 = kGravity_m_s2) {
    std::vector<double> out(n());
    inverse_dynamics(body_, state_.velocity, acceleration, gravity_m_s2, scratch_, out);
    return out;
  }
  std::vector<double> matrix() {
    std::vector<double> m(n() * n());
    mass_matrix(body_, scratch_, m);
    return m;
  }

  Multibody body_;
  std::mt19937_64 random_;
  DynamicsState state_;
  DynamicsScratch scratch_;
};

void expect_matrix_and_recursion_agree(Scene& scene) {
  const std::size_t n = scene.n();
  const std::vector<double> forces = scene.forces(scene.state_.acceleration);
  const std::vector<double> bias = scene.forces(std::vector<double>(n));
  const std::vector<double> m = scene.matrix();
  for (std::size_t i = 0; i < n; ++i) {
    double sum = bias[i];
    for (std::size_t j = 0; j < n; ++j) sum += m[i * n + j] * scene.state_.acceleration[j];
    EXPECT_NEAR(sum, forces[i], 1e-12 * largest(forces)) << i;
  }
}

void expect_forward_undoes_inverse(Scene& scene) {
  const std::size_t n = scene.n();
  const std::vector<double> forces = scene.forces(scene.state_.acceleration);
  const std::vector<double> by_aba = fixtures::articulated_body_acceleration(
      scene.body_, scene.scratch_, scene.state_.velocity, forces, kGravity_m_s2);
  std::vector<double> by_factors = forces;
  const std::vector<double> bias = scene.forces(std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) by_factors[i] -= bias[i];
  std::vector<double> m = scene.matrix();
  factorise(scene.body_, m);
  solve(scene.body_, m, by_factors);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(by_aba[i], scene.state_.acceleration[i], 5e-10) << i;
    EXPECT_NEAR(by_factors[i], scene.state_.acceleration[i], 5e-10) << i;
  }
}

// Six right-hand sides at once give the very bits of one after another. Every second entry is 0, as of a force on one
// limb.
void expect_six_at_once(Scene& scene) {
  const std::size_t n = scene.n();
  std::vector<double> m = scene.matrix();
  factorise(scene.body_, m);
  std::vector<Six> all(n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 6; ++c)
      if ((k + c) % 2 == 0) all[k][c] = scene.state_.acceleration[(k + c) % n];
  const std::vector<Six> right = all;
  solve_six(scene.body_, m, all);
  for (std::size_t c = 0; c < 6; ++c) {
    std::vector<double> one(n);
    for (std::size_t k = 0; k < n; ++k) one[k] = right[k][c];
    solve(scene.body_, m, one);
    for (std::size_t k = 0; k < n; ++k) EXPECT_EQ(all[k][c], one[k]) << c << " " << k;
  }
}

// The factors leave every zero of the matrix a zero.
void expect_sparsity(Scene& scene) {
  const std::size_t n = scene.n();
  std::vector<double> m(n * n);
  mass_matrix(scene.body_, scene.scratch_, m);
  factorise(scene.body_, m);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<char> on_the_way(n);
    for (int j = static_cast<int>(i); j >= 0; j = scene.body_.parent_dof()[static_cast<std::size_t>(j)])
      on_the_way[static_cast<std::size_t>(j)] = 1;
    EXPECT_GT(m[i * n + i], 0.0);
    for (std::size_t j = 0; j < i; ++j)
      if (!on_the_way[j]) {
        EXPECT_EQ(m[i * n + j], 0.0) << i << " " << j;
      }
  }
}

// A point's velocity and its change by finite differences along the motion.
void expect_jacobians(Scene& scene) {
  const std::size_t n = scene.n();
  const int link = static_cast<int>(scene.body_.links().size()) - 1;
  const Vec3 local(0.1, -0.05, 0.2);
  const auto point_at = [&](double time_s, std::vector<double>& rows) {
    Rigid root = scene.state_.root;
    std::vector<double> coords = scene.state_.coords;
    integrate(scene.body_, scene.state_.velocity, time_s, root, coords);
    DynamicsScratch moved;
    place(scene.body_, root, coords, moved);
    const Placement& at = moved.world.back();
    const Vec3 point = at.origin_m + at.rotation * local;
    rows.resize(3 * n);
    point_jacobian(scene.body_, moved, link, point, rows);
    return point;
  };
  const auto speed = [&](const std::vector<double>& rows) {
    Vec3 sum(0.0);
    for (int k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < n; ++j)
        sum[k] += rows[static_cast<std::size_t>(k) * n + j] * scene.state_.velocity[j];
    return sum;
  };
  constexpr double kStep_s = 1e-5;
  std::vector<double> before, now, after;
  const Vec3 p0 = point_at(-kStep_s, before), p1 = point_at(0.0, now), p2 = point_at(kStep_s, after);
  EXPECT_LT(length((p2 - p0) / (2 * kStep_s) - speed(now)), 1e-7);
  const Vec3 bias = carried_acceleration(scene.body_, scene.scratch_, link, p1, scene.state_.velocity).linear;
  EXPECT_LT(length((speed(after) - speed(before)) / (2 * kStep_s) - bias), 1e-5 * (1.0 + length(bias)));
}

void expect_laws(const Character& character, int states, std::uint64_t seed) {
  for (int i = 0; i < states; ++i) {
    Scene scene(character, seed + static_cast<std::uint64_t>(i));
    expect_matrix_and_recursion_agree(scene);
    expect_forward_undoes_inverse(scene);
    expect_six_at_once(scene);
    expect_sparsity(scene);
    expect_jacobians(scene);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Dynamics, KeepsItsLawsOnTheStockCharacters) {
  expect_laws(fixtures::human(), 100, 1);
  expect_laws(
      fixtures::built(fixtures::mech_choice({{"arm_left", "mech_arm_extend"}, {"leg_left", "mech_leg_reverse"}})), 100,
      1000);
  expect_laws(fixtures::built({"quadruped", {}, {}}), 100, 2000);
}

TEST(Dynamics, KeepsItsLawsOnRandomTrees) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) expect_laws(random_tree(seed), 3, 100 * seed);
}

// Placed bodies are where forward kinematics puts them, mass is all of the mass.
TEST(Dynamics, SeesTheCharacterThatItIsMadeOf) {
  const Multibody body = Multibody::of(fixtures::human());
  EXPECT_EQ(body.dof_count(), 36);
  EXPECT_NEAR(body.mass_kg(), 73.0, 0.003);
  DynamicsScratch scratch;
  place(body, fixtures::human().rest_root(), fixtures::human().rest_coords(), scratch);
  std::vector<double> m(36 * 36);
  mass_matrix(body, scratch, m);
  // Measured on another model of the same tables (y and z are z and x there).
  const auto entry = [&](const char* a, const char* b) {
    const auto dof = [&](const char* name) {
      const int joint = fixtures::human().find_joint(name);
      return static_cast<std::size_t>(body.links()[static_cast<std::size_t>(joint)].dof);
    };
    return m[dof(a) * 36 + dof(b)];
  };
  EXPECT_NEAR(entry("torso/lumbar_flex", "torso/lumbar_flex"), 3.618, 0.0005);
  EXPECT_NEAR(entry("leg_left/hip_flex", "leg_left/hip_flex"), 2.5575, 0.0005);
  EXPECT_NEAR(entry("leg_left/hip_flex", "leg_left/knee"), -0.8484, 0.0005);
  EXPECT_NEAR(entry("leg_right/knee", "leg_right/knee"), 0.3895, 0.0005);
}

// ---- free flight

struct Conserved {
  double energy_J = 0.0;
  Vec3 momentum_N_s{0.0};
  Vec3 angular_momentum{0.0};  // about the world's origin
};

class Flight {
 public:
  explicit Flight(const Character& character, double size) : body_(Multibody::of(character)) {
    std::mt19937_64 random(3);
    state_ = any_state(body_, random);
    for (double& v : state_.velocity) v *= size;
    for (const Link& link : body_.links().subspan(1))
      if (link.kind != JointKind::ball) state_.coords[static_cast<std::size_t>(link.coord)] *= 0.4;
  }

  Conserved now() {
    const std::size_t n = state_.velocity.size();
    place(body_, state_.root, state_.coords, scratch_);
    std::vector<double> m(n * n);
    mass_matrix(body_, scratch_, m);
    std::vector<double> momentum(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) momentum[i] += m[i * n + j] * state_.velocity[j];
    Conserved out;
    for (std::size_t i = 0; i < n; ++i) out.energy_J += 0.5 * momentum[i] * state_.velocity[i];
    out.momentum_N_s = Vec3(momentum[0], momentum[1], momentum[2]);
    out.angular_momentum = scratch_.world[0].rotation * Vec3(momentum[3], momentum[4], momentum[5]) +
                           glm::cross(state_.root.p_m, out.momentum_N_s);
    return out;
  }

  // Semi-implicit, as the product does.
  void step(double time_s) {
    const std::vector<double> a = acceleration(state_);
    for (std::size_t i = 0; i < a.size(); ++i) state_.velocity[i] += time_s * a[i];
    integrate(body_, state_.velocity, time_s, state_.root, state_.coords);
  }

  // Runge and Kutta's fourth order, over rotations as quaternions.
  void step_rk4(double time_s) {
    const std::vector<double> start = flat(state_);
    std::vector<double> sum = start;
    std::vector<double> slope(start.size());
    const double shares[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const double ahead[] = {0.0, 0.5, 0.5, 1.0};
    for (int k = 0; k < 4; ++k) {
      std::vector<double> at = start;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] += ahead[k] * time_s * slope[i];
      slope = derivative(at);
      for (std::size_t i = 0; i < at.size(); ++i) sum[i] += shares[k] * time_s * slope[i];
    }
    state_ = unflat(sum);
  }

 private:
  std::vector<double> acceleration(const DynamicsState& state) {
    const std::size_t n = state.velocity.size();
    place(body_, state.root, state.coords, scratch_);
    std::vector<double> force(n), zero(n), m(n * n);
    inverse_dynamics(body_, state.velocity, zero, 0.0, scratch_, force);
    mass_matrix(body_, scratch_, m);
    factorise(body_, m);
    for (double& f : force) f = -f;
    solve(body_, m, force);
    return force;
  }

  static void append(std::vector<double>& out, const Quat& q) { out.insert(out.end(), {q.w, q.x, q.y, q.z}); }

  std::vector<double> flat(const DynamicsState& s) const {
    std::vector<double> out = {s.root.p_m.x, s.root.p_m.y, s.root.p_m.z};
    append(out, s.root.q);
    out.insert(out.end(), s.coords.begin(), s.coords.end());
    out.insert(out.end(), s.velocity.begin(), s.velocity.end());
    return out;
  }

  DynamicsState unflat(const std::vector<double>& x) const {
    DynamicsState s;
    s.root.p_m = Vec3(x[0], x[1], x[2]);
    s.root.q = glm::normalize(Quat(x[3], x[4], x[5], x[6]));
    s.coords.assign(x.begin() + 7, x.begin() + 7 + body_.coord_count());
    for (const Link& link : body_.links().subspan(1))
      if (link.kind == JointKind::ball) {
        double* q = &s.coords[static_cast<std::size_t>(link.coord)];
        const Quat unit = glm::normalize(Quat(q[0], q[1], q[2], q[3]));
        q[0] = unit.w, q[1] = unit.x, q[2] = unit.y, q[3] = unit.z;
      }
    s.velocity.assign(x.begin() + 7 + body_.coord_count(), x.end());
    return s;
  }

  std::vector<double> derivative(const std::vector<double>& x) {
    const DynamicsState s = unflat(x);
    std::vector<double> out(x.begin() + 7 + body_.coord_count(), x.begin() + 10 + body_.coord_count());
    const auto turning = [](const Quat& q, const double* rate) {
      return q * Quat(0.0, 0.5 * rate[0], 0.5 * rate[1], 0.5 * rate[2]);
    };
    append(out, turning(Quat(x[3], x[4], x[5], x[6]), &s.velocity[3]));
    std::vector<double> rates(s.coords.size());
    for (const Link& link : body_.links().subspan(1)) {
      const auto coord = static_cast<std::size_t>(link.coord);
      if (link.kind != JointKind::ball) {
        rates[coord] = s.velocity[static_cast<std::size_t>(link.dof)];
        continue;
      }
      const double* q = &x[7 + coord];
      const Quat rate = turning(Quat(q[0], q[1], q[2], q[3]), &s.velocity[static_cast<std::size_t>(link.dof)]);
      rates[coord] = rate.w, rates[coord + 1] = rate.x, rates[coord + 2] = rate.y, rates[coord + 3] = rate.z;
    }
    out.insert(out.end(), rates.begin(), rates.end());
    const std::vector<double> a = acceleration(s);
    out.insert(out.end(), a.begin(), a.end());
    return out;
  }

  Multibody body_;
  DynamicsState state_;
  DynamicsScratch scratch_;
};

struct Drift {
  double energy = 0.0;
  double momentum = 0.0;
  double angular = 0.0;
};

template <class Step>
Drift drift_over_a_second(Flight& flight, int steps, Step step) {
  const Conserved before = flight.now();
  for (int i = 0; i < steps; ++i) step();
  const Conserved after = flight.now();
  return {std::fabs(after.energy_J / before.energy_J - 1.0),
          length(after.momentum_N_s - before.momentum_N_s) / length(before.momentum_N_s),
          length(after.angular_momentum - before.angular_momentum) / length(before.angular_momentum)};
}

TEST(Dynamics, FreeFlightKeepsEnergyAndMomentum) {
  const std::pair<const char*, Character> flyers[] = {
      {"human", fixtures::human()},
      {"mech", fixtures::built(fixtures::mech_choice({{"arm_left", "mech_arm_extend"}}))},
      {"quadruped", fixtures::built({"quadruped", {}, {}})}};
  for (const auto& [name, character] : flyers) {
    Flight exact(character, 0.25);
    const Drift rk4 = drift_over_a_second(exact, 480, [&] { exact.step_rk4(1.0 / 480); });
    std::printf("%-10s RK4: energy %.1e momentum %.1e angular %.1e\n", name, rk4.energy, rk4.momentum, rk4.angular);
    EXPECT_LT(rk4.energy, 1e-9) << name;
    EXPECT_LT(rk4.momentum, 1e-6) << name;
    EXPECT_LT(rk4.angular, 1e-6) << name;
    Flight coarse(character, 0.25), fine(character, 0.25);
    const Drift at_480 = drift_over_a_second(coarse, 480, [&] { coarse.step(1.0 / 480); });
    const Drift at_1920 = drift_over_a_second(fine, 1920, [&] { fine.step(1.0 / 1920); });
    std::printf("%-10s semi-implicit: energy %.1e momentum %.1e angular %.1e, a quarter of the step: %.1e %.1e %.1e\n",
                name, at_480.energy, at_480.momentum, at_480.angular, at_1920.energy, at_1920.momentum,
                at_1920.angular);
    EXPECT_LT(at_480.momentum, 1e-3) << name;
    EXPECT_LT(at_480.angular, 1e-3) << name;
    EXPECT_NEAR(at_480.momentum / at_1920.momentum, 4.0, 1.0) << name;  // first order
  }
}

}  // namespace
}  // namespace contort
