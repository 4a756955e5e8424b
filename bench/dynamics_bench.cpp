// Compares rigid-body dynamics with MuJoCo's on the same character, in one process: alternating slices of a
// millisecond, and the median of their ratios, because the clocks of shared machines vary by 15 %. It uses 256 states,
// so that no branch predictor learns one.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "bench/side_by_side.h"
#include "generator/generate.h"
#include "tests/dynamics/mujoco_model.h"
#include "tests/scenes.h"

namespace contort {
namespace {

constexpr int kStates = 256;
constexpr int kSlices = 301;

// Returns the seconds of one call, over a slice of calls.
template <class Call>
double slice(int calls, int& next, Call call) {
  const double begin = thread_time_s();
  for (int i = 0; i < calls; ++i) call(next++ % kStates);
  return (thread_time_s() - begin) / calls;
}

template <class Ours, class Theirs>
void compare(const char* name, Ours ours, Theirs theirs) {
  int a = 0, b = 0;
  slice(200, a, ours), slice(200, b, theirs);
  const int our_calls = std::max(1, static_cast<int>(1e-3 / slice(500, a, ours)));
  const int their_calls = std::max(1, static_cast<int>(1e-3 / slice(200, b, theirs)));
  std::vector<double> ratios, times, peers;
  for (int i = 0; i < kSlices; ++i) {
    times.push_back(slice(our_calls, a, ours));
    peers.push_back(slice(their_calls, b, theirs));
    ratios.push_back(times.back() / peers.back());
  }
  std::printf("%-22s ours %6.2f us   MuJoCo %6.2f us   ratio %.3f\n", name, 1e6 * median(times), 1e6 * median(peers),
              median(ratios));
}

void compare_on(const char* name, const Character& character) {
  const Multibody body = Multibody::of(character);
  fixtures::MujocoModel theirs(character);
  std::mt19937_64 random(1);
  std::vector<fixtures::DynamicsState> states;
  std::vector<std::vector<double>> coords, speeds, changes;
  for (int i = 0; i < kStates; ++i) {
    states.push_back(fixtures::any_state(body, random));
    theirs.set(body, states.back());
    const mjModel* m = theirs.model();
    const mjData* d = theirs.data();
    coords.emplace_back(d->qpos, d->qpos + m->nq);
    speeds.emplace_back(d->qvel, d->qvel + m->nv);
    changes.emplace_back(d->qacc, d->qacc + m->nv);
  }
  const auto n = static_cast<std::size_t>(body.dof_count());
  DynamicsScratch scratch;
  std::vector<double> forces(n), matrix(n * n), dense(n * n), result(n);
  mjModel* m = theirs.model();
  mjData* d = theirs.data();
  const auto load = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    std::copy(coords[at].begin(), coords[at].end(), d->qpos);
    std::copy(speeds[at].begin(), speeds[at].end(), d->qvel);
    std::copy(changes[at].begin(), changes[at].end(), d->qacc);
  };
  std::printf("%s, %d freedoms\n", name, body.dof_count());
  compare(
      "inverse dynamics",
      [&](int i) {
        const auto& s = states[static_cast<std::size_t>(i)];
        place(body, s.root, s.coords, scratch);
        inverse_dynamics(body, s.velocity, s.acceleration, kGravity_m_s2, scratch, forces);
      },
      [&](int i) {
        load(i);
        mj_kinematics(m, d), mj_comPos(m, d), mj_comVel(m, d), mj_rne(m, d, 1, result.data());
      });
  compare(
      "mass matrix",
      [&](int i) {
        const auto& s = states[static_cast<std::size_t>(i)];
        place(body, s.root, s.coords, scratch);
        mass_matrix(body, scratch, matrix);
      },
      [&](int i) {
        load(i);
        mj_kinematics(m, d), mj_comPos(m, d), mj_crb(m, d), mj_fullM(m, dense.data(), d->qM);
      });
}

// Measures single ticks of one simulation. Each tick is measured in many runs; its time is the median, and the
// quantiles are over the ticks. Work between ticks counts for the tick after it.
void print_quantiles(const char* name, const Stage& stage, const Motion& target) {
  constexpr std::size_t kRuns = 101;
  SimulationScratch scratch;
  std::vector<std::vector<double>> of_tick;
  double begin = 0.0;
  std::size_t tick = 0;
  scratch.after_tick = [&] {
    const double now = thread_time_s();
    if (tick == of_tick.size()) of_tick.emplace_back();
    of_tick[tick++].push_back(now - begin);
    begin = thread_time_s();
  };
  for (std::size_t run = 0; run < kRuns; ++run) {
    Motion motion = target;
    tick = 0, begin = thread_time_s();
    simulate(*stage.character, *stage.dynamics, stage.environment, scratch, motion);
  }
  std::vector<double> times;
  for (std::size_t t = 1; t < of_tick.size(); ++t) {  // the first tick includes everything that is computed once
    std::ranges::sort(of_tick[t]);
    times.push_back(of_tick[t][kRuns / 2]);
  }
  std::ranges::sort(times);
  const auto at = [&](double share) {
    return 1e6 * times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
  };
  std::printf("%-22s %zu ticks: median %.2f us   p99 %.2f us   longest %.2f us\n", name, times.size(), at(0.5),
              at(0.99), at(1.0));
}

// Compares a whole tick of a squat with a load and a blow with mj_inverse on random states of the same figure.
void compare_tick(Mode mode) {
  Spec spec = scene("human_dynamic");
  spec.dynamics.mode = mode, spec.dynamics.ticks_per_frame = 4;
  const Stage stage = *build_stage(spec, stock_library());
  Stage still = stage;
  still.dynamics = nullptr;
  const Motion target = generate(still);
  const int ticks = (target.frame_count - 1) * 4 + 1;
  fixtures::MujocoModel theirs(*stage.character);
  std::mt19937_64 random(1);
  theirs.set(stage.dynamics->figure.body, fixtures::any_state(stage.dynamics->figure.body, random));
  SimulationScratch scratch;
  Motion motion;
  std::vector<double> times, peers, ratios;
  for (int i = 0; i < 101; ++i) {
    int none = 0;
    motion = target;
    times.push_back(
        slice(1, none, [&](int) { simulate(*stage.character, *stage.dynamics, stage.environment, scratch, motion); }) /
        ticks);
    peers.push_back(slice(300, none, [&](int) { mj_inverse(theirs.model(), theirs.data()); }));
    ratios.push_back(times.back() / peers.back());
  }
  for (std::vector<double>* v : {&times, &peers, &ratios}) std::ranges::sort(*v);
  std::printf("%-22s ours %6.2f us   mj_inverse %6.2f us   ratio %.3f\n",
              mode == Mode::dynamic ? "dynamic tick" : "tracking tick", 1e6 * times[50], 1e6 * peers[50], ratios[50]);
  print_quantiles(mode == Mode::dynamic ? "  single ticks, dynamic" : "  single ticks, tracking", stage, target);
}

}  // namespace
}  // namespace contort

int main() {
  for (const char* name : {"human", "mech", "quadruped"})
    contort::compare_on(name, *contort::build_character({name, {}, {}}, contort::stock_library()));
  for (const contort::Mode mode : {contort::Mode::tracking, contort::Mode::dynamic}) contort::compare_tick(mode);
}
