// One source, several sets of instructions.
#include "generator/dynamics/recursions.h"

#include <gtest/gtest.h>

#include "tests/dynamics/random_tree.h"

namespace contort {
namespace {

std::vector<double> numbers_of(const DynamicsScratch& scratch) {
  std::vector<double> all;
  const auto add = [&](const Vec3& v) { all.insert(all.end(), {v.x, v.y, v.z}); };
  for (const Placement& link : scratch.world) {
    add(link.origin_m);
    for (int k = 0; k < 3; ++k) add(link.rotation[k]);
  }
  for (const std::vector<SpatialMotion>* motions : {&scratch.freedoms, &scratch.velocity, &scratch.acceleration})
    for (const SpatialMotion& m : *motions) add(m.angular), add(m.linear);
  for (const SpatialForce& f : scratch.force) add(f.moment), add(f.force);
  for (const std::vector<SpatialInertia>* inertias : {&scratch.inertia, &scratch.composite})
    for (const SpatialInertia& i : *inertias) {
      all.push_back(i.mass_kg), add(i.first_moment);
      for (int k = 0; k < 3; ++k) add(i.inertia[k]);
    }
  return all;
}

// All that the recursions leave, bit for bit.
void expect_same_bits_by_all_sets(const Character& character, std::uint64_t seed) {
  const Multibody body = Multibody::of(character);
  const auto n = static_cast<std::size_t>(body.dof_count());
  std::mt19937_64 random(seed);
  const fixtures::DynamicsState state = fixtures::any_state(body, random);
  DynamicsScratch scratch;
  std::vector<double> forces(n), matrix(n * n), product(n);
  place(body, state.root, state.coords, scratch);
  inverse_dynamics(body, state.velocity, state.acceleration, kGravity_m_s2, scratch, forces);
  mass_matrix(body, scratch, matrix);
  multiply(matrix, state.acceleration, product);
  const std::vector<double> left = numbers_of(scratch);
  for (const RecursionSet& set : recursion_sets()) {
    SCOPED_TRACE(set.name);
    for (std::size_t i = 1; i < scratch.world.size(); ++i) scratch.world[i] = {}, scratch.inertia[i] = {};
    std::vector<double> own_forces(n), own_matrix(n * n), own_product(n);
    set.place_links(body, state.coords, scratch);
    set.sum_forces(body, state.velocity, state.acceleration, scratch, own_forces);
    set.fill_mass_matrix(body, scratch, own_matrix);
    set.multiply(own_matrix, state.acceleration, own_product);
    EXPECT_EQ(own_forces, forces);
    EXPECT_EQ(own_matrix, matrix);
    EXPECT_EQ(own_product, product);
    EXPECT_EQ(numbers_of(scratch), left);
  }
}

TEST(Recursions, OfAllSetsAreTheSameBits) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    expect_same_bits_by_all_sets(fixtures::human(), seed);
    expect_same_bits_by_all_sets(fixtures::built({"quadruped", {}, {}}), seed);
    expect_same_bits_by_all_sets(fixtures::random_tree(seed), seed);
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Recursions, AreTheFastestThatTheProcessorHas) {
  EXPECT_STREQ(recursion_sets().front().name, "any");
#ifdef __x86_64__
  EXPECT_STREQ(recursion_sets().back().name, __builtin_cpu_supports("avx2") ? "AVX2" : "any");
#endif
}

}  // namespace
}  // namespace contort
