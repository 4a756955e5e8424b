// Prints one line per golden scene: name, a shape that is easy to reason about (frames, findings), and hashes.
#include "tests/golden/hashes.h"

#include <cmath>
#include <cstdio>
#include <random>

#include "generator/dynamics/recursions.h"
#include "model/core/detmath.h"
#include "model/core/hash.h"
#include "model/geometry/round_distances.h"
#include "tests/dynamics/states.h"
#include "tests/scenes.h"
#include "tests/stage_evaluator.h"

namespace contort::golden {

namespace {

void add_findings(Hash64& hash, const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    hash.add(finding.check);
    hash.add(finding.subject);
    hash.add(static_cast<std::uint64_t>(finding.worst_frame));
    hash.add(finding.worst_margin);
  }
}

void print_scene(const NamedScene& named) {
  const Result<Stage> stage = build_stage(scene(named.name), stock_library());
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(*stage);
  Hash64 findings;
  add_findings(findings, evaluation.findings);
  std::printf("%s frames=%d findings=%zu motion=%s margins=%s\n", std::string(named.name).c_str(),
              evaluation.frame_count, evaluation.findings.size(), to_hex(evaluation.motion_hash).c_str(),
              to_hex(findings.value()).c_str());
}

void print_math() {
  Hash64 hash;
  for (int i = -20000; i <= 20000; ++i) {
    const double x = i * 0.0137;
    for (const double value :
         {det::sin(x), det::cos(x), det::atan2(x, 1.7 - 0.001 * i), det::acos(x / 300.0), det::exp(0.01 * x)})
      hash.add(value);
  }
  std::printf("detmath values=200005 hash=%s\n", to_hex(hash.value()).c_str());
}

// 4950 pairs of capsules by one of the kernels. Scenes do not test all kernels: a machine uses its fastest one.
void print_round(const char* which, const RoundKernel& kernel) {
  std::mt19937_64 engine(5);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0; };
  const auto point = [&] {
    const double x = uniform(), y = uniform(), z = uniform();
    return Vec3(x, y, z);
  };
  std::vector<Solid> solids;
  std::vector<ColliderPair> pairs;
  for (int b = 0; b < 100; ++b) {
    const Vec3 from = point(), to = point();
    solids.push_back(solid_of(Capsule{from, to, 0.05}));
    for (int a = 0; a < b; ++a) pairs.push_back({a, b});
  }
  std::vector<double> distances_m(pairs.size());
  round_distances(solids, pairs, distances_m, kernel);
  Hash64 hash;
  for (const double distance_m : distances_m) hash.add(distance_m);
  std::printf("round_distances kernel=%s pairs=%zu hash=%s\n", which, pairs.size(), to_hex(hash.value()).c_str());
}

// The recursions of dynamics with one set of instructions, on the results of place() and inverse_dynamics().
void print_recursions(const char* which, const RecursionSet& set) {
  Hash64 hash;
  for (const char* name : {"human", "mech", "quadruped"}) {
    const Multibody body = Multibody::of(*build_character({name, {}, {}}, stock_library()));
    const auto n = static_cast<std::size_t>(body.dof_count());
    std::mt19937_64 engine(5);
    std::vector<double> forces(n), matrix(n * n), product(n);
    for (int i = 0; i < 20; ++i) {
      const fixtures::DynamicsState state = fixtures::any_state(body, engine);
      DynamicsScratch scratch;
      place(body, state.root, state.coords, scratch);
      inverse_dynamics(body, state.velocity, state.acceleration, kGravity_m_s2, scratch, forces);
      scratch.composite.resize(body.links().size());
      set.place_links(body, state.coords, scratch);
      set.sum_forces(body, state.velocity, state.acceleration, scratch, forces);
      set.fill_mass_matrix(body, scratch, matrix);
      set.multiply(matrix, state.acceleration, product);
      for (const std::vector<double>* values : {&forces, &matrix, &product})
        for (const double value : *values) hash.add(value);
    }
  }
  std::printf("recursions set=%s hash=%s\n", which, to_hex(hash.value()).c_str());
}

}  // namespace

void print_fixed() {
  print_math();
  print_round("slowest", round_kernels().front());
  print_round("fastest", round_kernels().back());
  print_recursions("slowest", recursion_sets().front());
  print_recursions("fastest", recursion_sets().back());
  for (const NamedScene& named : all_scenes()) print_scene(named);
}

std::uint64_t hash_of(const Spec& spec, Evaluator& evaluator) {
  const Result<Evaluation> evaluation = evaluator.run(spec);
  if (!evaluation) return 0;
  Hash64 hash;
  hash.add(print_spec(spec));
  hash.add(evaluation->motion_hash);
  add_findings(hash, evaluation->findings);
  return hash.value();
}

void print_drawn(int jobs, std::span<const std::uint64_t> hashes) {
  Hash64 all;
  for (const std::uint64_t hash : hashes) all.add(hash);
  std::printf("drawn seed=7 cases=%zu jobs=%d hash=%s\n", hashes.size(), jobs, to_hex(all.value()).c_str());
}

}  // namespace contort::golden
