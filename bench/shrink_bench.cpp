// Measures the cost and the results of shrinking, on failures as a run finds them without guidance: human, mech, and
// mech on reverse legs, at most two failures of a family for each seed and figure. Prints one line for each failure,
// then medians and fractions. The exit code is 1 if a family is lost, or if shrinking again changes anything.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "corpus/case.h"
#include "tests/stage_evaluator.h"
#include "fuzz/compose.h"
#include "fuzz/lineage.h"
#include "fuzz/shrink.h"

namespace contort {

namespace {

constexpr int kOfFamily = 2;
constexpr std::size_t kCasesOfSeed = 400;

struct Figure {
  const char* name;
  const char* character;
  bool reverse_legs;
};
constexpr Figure kFigures[] = {{"human", "human", false}, {"mech", "mech", false}, {"reverse", "mech", true}};

struct Measured {
  std::string figure;
  Case original;
  Case minimal;
  int evaluations = 0;
  double seconds = 0.0;
  bool same_again = false;
  std::string stopped;
};

Spec drawn(const Figure& figure, int seed, int index) {
  const DrawConfig config{{figure.character}};
  Spec spec = compose(raw_of(config, stock_generator(), seed, {index}), config, stock_generator());
  if (figure.reverse_legs)
    for (const char* slot : {"leg_left", "leg_right"}) spec.character.parts[slot] = "mech_leg_reverse";
  return spec;
}

// The deepest failure of each family.
std::vector<Case> failures_of(const Spec& spec, StageEvaluator& evaluator) {
  const Result<Stage> stage = build_stage(spec, stock_library());
  if (!stage) return {};  // reverse legs do not accept all parameters of human ones
  const Evaluation evaluation = evaluator.run(*stage);
  std::map<Family, const Finding*> deepest_of;
  for (const Finding& finding : evaluation.findings) {
    const Finding*& deepest = deepest_of[family_of(spec.character.name, finding)];
    if (deepest == nullptr || finding.depth > deepest->depth) deepest = &finding;
  }
  std::vector<Case> failures;
  for (const auto& [family, finding] : deepest_of)
    failures.push_back({spec, expectation_of(evaluator.execution(), evaluation, *finding), {}});
  return failures;
}

// One failure for each drawn case that fails, each of another kind.
std::vector<Case> drawn_failures(const Figure& figure, int seed, std::size_t wanted) {
  std::vector<Case> chosen;
  std::map<Family, int> of_family;
  StageEvaluator evaluator;
  for (std::size_t index = 0; index < kCasesOfSeed && chosen.size() < wanted; ++index) {
    const std::vector<Case> failures = failures_of(drawn(figure, seed, static_cast<int>(index)), evaluator);
    if (failures.empty()) continue;
    const Case& failure = failures[index % failures.size()];
    if (++of_family[family_of(failure)] <= kOfFamily) chosen.push_back(failure);
  }
  return chosen;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Measured measure(const std::string& figure, const Case& original) {
  const auto start = std::chrono::steady_clock::now();
  const Shrunk once = shrink(original, stock_generator(), {});
  const double seconds = seconds_since(start);
  const Shrunk again = shrink(once.minimal, stock_generator(), {});
  return {figure,           original, once.minimal,
          once.evaluations, seconds,  print_case(again.minimal) == print_case(once.minimal),
          once.stopped};
}

int actions_of(const Spec& spec) {
  int count = 0;
  const auto add = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  };
  for (const SequenceDesc& sequence : spec.sequences) add(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) add(interrupt.sequence);
  return count;
}

template <class Value>
double median_of(const std::vector<Measured>& all, Value value) {
  std::vector<double> values;
  for (const Measured& m : all) values.push_back(value(m));
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

template <class Holds>
double percent_of(const std::vector<Measured>& all, Holds holds) {
  const auto count = std::count_if(all.begin(), all.end(), holds);
  return all.empty() ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(all.size());
}

void print(const Measured& m) {
  std::printf("%-8s %4d evaluations %7.3f s  actions %2d -> %d  bytes %5zu -> %4zu  %-11s %s %s\n", m.figure.c_str(),
              m.evaluations, m.seconds, actions_of(m.original.spec), actions_of(m.minimal.spec),
              print_spec(m.original.spec).size(), print_spec(m.minimal.spec).size(), m.stopped.c_str(),
              m.same_again ? "" : "CHANGES AGAIN", print_family(family_of(m.original)).c_str());
  std::fflush(stdout);
}

bool summarize(const std::vector<Measured>& all) {
  const double kept = percent_of(all, [](const Measured& m) { return family_of(m.minimal) == family_of(m.original); });
  const double stays = percent_of(all, [](const Measured& m) { return m.same_again; });
  std::printf("\n%zu failures: median %.0f evaluations, %.3f s; minimal in %.1f %%\n", all.size(),
              median_of(all, [](const Measured& m) { return m.evaluations; }),
              median_of(all, [](const Measured& m) { return m.seconds; }),
              percent_of(all, [](const Measured& m) { return m.stopped == "fixpoint"; }));
  std::printf("at most 2 actions in %.1f %%, family kept in %.1f %%, unchanged when shrunk again %.1f %%\n",
              percent_of(all, [](const Measured& m) { return actions_of(m.minimal.spec) <= 2; }), kept, stays);
  std::printf("median bytes of spec %.0f -> %.0f\n",
              median_of(all, [](const Measured& m) { return static_cast<double>(print_spec(m.original.spec).size()); }),
              median_of(all, [](const Measured& m) { return static_cast<double>(print_spec(m.minimal.spec).size()); }));
  return kept == 100.0 && stays == 100.0;
}

int run(int wanted) {
  std::vector<Measured> all;
  for (int seed = 1; static_cast<int>(all.size()) < wanted && seed < 1000; ++seed)
    for (const Figure& figure : kFigures)
      for (const Case& original : drawn_failures(figure, seed, 10)) {
        if (static_cast<int>(all.size()) == wanted) break;
        all.push_back(measure(figure.name, original));
        print(all.back());
      }
  return summarize(all) ? 0 : 1;
}

}  // namespace

}  // namespace contort

int main(int argc, char** argv) { return contort::run(argc > 1 ? std::atoi(argv[1]) : 200); }
