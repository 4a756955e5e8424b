// Our dynamics against MuJoCo 2.2.2, on random states of the stock characters.
#include <gtest/gtest.h>

#ifdef CONTORT_HAS_MUJOCO
#include <algorithm>
#include <cmath>

#include "tests/character/stock.h"
#include "tests/dynamics/mujoco_model.h"

namespace contort {
namespace {

using fixtures::any_state;
using fixtures::DynamicsState;
using fixtures::MujocoModel;

constexpr int kStates = 1000;

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::fabs(value));
  return most;
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[i]));
  return most / std::max(1e-300, largest(b));
}

struct Worst {
  double mass = 0.0;
  double bias = 0.0;
  double inverse = 0.0;
  double forward = 0.0;
  double jacobian = 0.0;
};

class Compared {
 public:
  explicit Compared(const Character& character)
      : body_(Multibody::of(character)), theirs_(character), n_(static_cast<std::size_t>(body_.dof_count())) {}

  Worst over(int states) {
    std::mt19937_64 random(7);
    for (int i = 0; i < states; ++i) compare(any_state(body_, random));
    return worst_;
  }

 private:
  void compare(const DynamicsState& state) {
    theirs_.set(body_, state);
    mj_inverse(theirs_.model(), theirs_.data());
    const std::vector<double> their_inverse = theirs_.ours(body_, theirs_.data()->qfrc_inverse);
    place(body_, state.root, state.coords, scratch_);
    std::vector<double> forces(n_), bias(n_), zero(n_);
    inverse_dynamics(body_, state.velocity, state.acceleration, kGravity_m_s2, scratch_, forces);
    worst_.inverse = std::max(worst_.inverse, difference(forces, their_inverse));
    inverse_dynamics(body_, state.velocity, zero, kGravity_m_s2, scratch_, bias);

    // Forward dynamics: MuJoCo's acceleration under the forces that ours computes.
    mjData* data = theirs_.data();
    for (std::size_t i = 0; i < body_.links().size(); ++i) {
      const Link& link = body_.links()[i];
      std::copy_n(forces.begin() + link.dof, link.dof_count, data->qfrc_applied + theirs_.dof_of(static_cast<int>(i)));
    }
    mj_forward(theirs_.model(), data);
    worst_.bias = std::max(worst_.bias, difference(bias, theirs_.ours(body_, data->qfrc_bias)));
    worst_.forward = std::max(worst_.forward, difference(theirs_.ours(body_, data->qacc), state.acceleration));
    compare_mass(forces, bias, state);
    compare_jacobian();
  }

  void compare_mass(const std::vector<double>& forces, const std::vector<double>& bias, const DynamicsState& state) {
    std::vector<double> matrix(n_ * n_);
    mass_matrix(body_, scratch_, matrix);
    worst_.mass = std::max(worst_.mass, difference(matrix, theirs_.mass_matrix(body_)));
    std::vector<double> x(n_);
    for (std::size_t i = 0; i < n_; ++i) x[i] = forces[i] - bias[i];
    factorise(body_, matrix);
    solve(body_, matrix, x);
    worst_.forward = std::max(worst_.forward, difference(x, state.acceleration));
  }

  void compare_jacobian() {
    const int link = static_cast<int>(body_.links().size()) - 1;
    const int body = theirs_.model()->dof_bodyid[theirs_.dof_of(link)];
    const Vec3 point = scratch_.world.back().origin_m + Vec3(0.1, -0.2, 0.3);
    const mjtNum at[3] = {point.x, point.y, point.z};
    std::vector<double> linear(3 * n_), angular(3 * n_), their_linear(3 * n_), their_angular(3 * n_);
    mj_jac(theirs_.model(), theirs_.data(), their_linear.data(), their_angular.data(), at, body);
    point_jacobian(body_, scratch_, link, point, linear);
    angular_jacobian(body_, scratch_, link, angular);
    for (std::size_t row = 0; row < 3; ++row) {
      const auto in_order = [&](const std::vector<double>& all) { return theirs_.ours(body_, &all[row * n_]); };
      const auto own = [&](const std::vector<double>& all) {
        return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(row * n_),
                                   all.begin() + static_cast<std::ptrdiff_t>((row + 1) * n_));
      };
      worst_.jacobian = std::max({worst_.jacobian, difference(own(linear), in_order(their_linear)),
                                  difference(own(angular), in_order(their_angular))});
    }
  }

  Multibody body_;
  MujocoModel theirs_;
  std::size_t n_;
  DynamicsScratch scratch_;
  Worst worst_;
};

void expect_equal(const char* name, const Character& character) {
  const Worst worst = Compared(character).over(kStates);
  std::printf("%-16s M %.1e  bias %.1e  inverse %.1e  forward %.1e  Jacobian %.1e\n", name, worst.mass, worst.bias,
              worst.inverse, worst.forward, worst.jacobian);
  EXPECT_LT(worst.mass, 1e-12) << name;
  EXPECT_LT(worst.bias, 1e-11) << name;
  EXPECT_LT(worst.inverse, 1e-11) << name;
  EXPECT_LT(worst.forward, 1e-9) << name;
  EXPECT_LT(worst.jacobian, 1e-12) << name;
}

TEST(Mujoco, AgreesOnMassBiasInverseAndForwardDynamics) {
  expect_equal("human", fixtures::human());
  expect_equal("human, backpack", fixtures::built({"human", {}, {{"backpack", "torso", "back"}}}));
  expect_equal("mech", fixtures::built(fixtures::mech_choice()));
  // Travels, and four balls one after another.
  expect_equal("mech, extending", fixtures::built(fixtures::mech_choice({{"arm_left", "mech_arm_extend"}})));
  expect_equal("quadruped", fixtures::built({"quadruped", {}, {}}));
}

}  // namespace
}  // namespace contort
#else
TEST(Mujoco, AgreesOnMassBiasInverseAndForwardDynamics) {
  GTEST_SKIP() << "libmujoco-dev is not installed: no oracle for dynamics";
}
#endif
