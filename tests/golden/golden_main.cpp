// Prints the golden hashes. `test` builds this with several compilers and optimisation levels, runs it as on several
// CPUs, and compares with expected.txt. With --drawn-specs it prints the specs of the drawn cases instead, for
// wasm_main.cpp.
#include <cstdio>
#include <string_view>
#include <vector>

#include "fuzz/draw.h"
#include "fuzz/parallel.h"
#include "generator/built_in.h"
#include "tests/golden/hashes.h"

namespace contort::golden {

namespace {

Spec drawn(Generator& generator, int i) { return draw_spec({{"human", "mech", "quadruped"}}, generator, 7, i); }

// Prints cases drawn by the fuzzer, on this number of threads, which must not change them.
void print_drawn_on(int jobs) {
  std::vector<std::uint64_t> hashes(kDrawnCases);
  std::vector<BuiltInGenerator> generators(static_cast<std::size_t>(jobs));
  parallel_for(
      jobs, kDrawnCases,
      [&](int worker, int i) {
        BuiltInGenerator& generator = generators[static_cast<std::size_t>(worker)];
        Evaluator evaluator(generator);
        hashes[static_cast<std::size_t>(i)] = hash_of(drawn(generator, i), evaluator);
      },
      [] {});
  print_drawn(jobs, hashes);
}

// An empty line follows each of them.
void print_drawn_specs() {
  BuiltInGenerator generator;
  for (int i = 0; i < kDrawnCases; ++i) std::printf("%s\n\n", print_spec(drawn(generator, i)).c_str());
}

}  // namespace

}  // namespace contort::golden

int main(int count, char** words) {
  using namespace contort::golden;
  if (count == 2 && std::string_view(words[1]) == "--drawn-specs") return print_drawn_specs(), 0;
  print_fixed();
  for (const int jobs : {1, 4}) print_drawn_on(jobs);
}
