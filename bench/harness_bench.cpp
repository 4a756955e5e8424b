// Measures the cost of the harness: CPU time of `contort fuzz` (drawing, worker processes, journal, hashing, near
// misses) divided by that of generating and checking the same specs in one process. The profile has no failures, so
// nothing is shrunk or stored. Slices alternate; medians are printed.
//
// contort_harness_bench CONTORT [CASES]
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/stage_evaluator.h"
#include "fuzz/draw.h"

namespace contort {
namespace {

double cpu_s(int whose) {
  rusage used{};
  getrusage(whose, &used);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

// The built-in profile tame, with independent cases, because the bare work has no search.
Profile even_tame() {
  Profile profile = load_profile("tame").value();
  profile.guided = 0.0, profile.uniform = 1.0;
  return profile;
}

double bare_s(const Profile& profile, std::int64_t seed, int cases) {
  const double begin = cpu_s(RUSAGE_SELF);
  StageEvaluator evaluator;
  std::size_t failing = 0;
  for (int i = 0; i < cases; ++i) {
    const Result<Stage> stage = build_stage(draw_spec({{"human"}, profile}, stock_generator(), seed, i), stock_library());
    if (stage) failing += !evaluator.run(*stage).findings.empty();
  }
  if (failing > 0) std::printf("%zu of the cases fail: shrinking them counts as harness\n", failing);
  return cpu_s(RUSAGE_SELF) - begin;
}

double fuzz_s(const std::string& contort, const std::string& folder, std::int64_t seed, int cases) {
  const double begin = cpu_s(RUSAGE_CHILDREN);
  std::filesystem::remove_all(folder + "/corpus");
  const std::string command = contort + " fuzz --profile " + folder + "/profile.json --seed " + std::to_string(seed) +
                              " --cases " + std::to_string(cases) + " --jobs 1 --corpus " + folder + "/corpus >" +
                              folder + "/log 2>&1";
  if (std::system(command.c_str()) != 0) std::printf("failed: %s\n", command.c_str());
  return cpu_s(RUSAGE_CHILDREN) - begin;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

int run(const std::string& contort, int cases) {
  const Profile profile = even_tame();
  const std::string folder = (std::filesystem::temp_directory_path() / "contort_harness_bench").string();
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/profile.json") << print_profile(profile);
  std::vector<double> bare, whole, ratios;
  for (std::int64_t seed = 1; seed <= 7; ++seed) {
    bare.push_back(bare_s(profile, seed, cases)), whole.push_back(fuzz_s(contort, folder, seed, cases));
    ratios.push_back(whole.back() / bare.back());
  }
  std::printf("%d cases: draw, build, generate and check %.2f s, contort fuzz %.2f s of CPU time, ratio %.3f\n", cases,
              median(bare), median(whole), median(ratios));
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace contort

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: contort_harness_bench CONTORT [CASES]\n");
    return 2;
  }
  return contort::run(argv[1], argc > 2 ? std::atoi(argv[2]) : 256);
}
