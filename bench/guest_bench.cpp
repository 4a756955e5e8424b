// Measures the protocol of docs/reference/guests.md with a figure of 67 joints that this program serves itself: a
// request of 120 frames, received and converted; the frames per second that one process of `contort fuzz` checks; and
// the throughput of two processes divided by that of one. Medians are printed.
//
// contort_guest_bench CONTORT [CASES]
#include <contort_guest.h>  // as a user of it has it: from adapters/cpp
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "guest/guest_generator.h"
#include "process/clock.h"

namespace contort {
namespace {

constexpr int kJoints = 67;
constexpr int kFrames = 120;
constexpr int kRequests = 400;  // in one round
constexpr int kRounds = 5;

// A chain of balls, each of which sways by a few degrees.
std::string manifest_of(const std::string& format) {
  std::string joints = R"({"name":"j0","position":[0,1,0]})";
  for (int j = 1; j < kJoints; ++j)
    joints += R"(,{"name":"j)" + std::to_string(j) + R"(","parent":"j)" + std::to_string(j - 1) +
              R"(","position":[0,0.02,0]})";
  return R"({"contort":1,"name":"chain","frames":")" + format + R"(","characters":[{"name":"chain","joints":[)" +
         joints + R"(]}],"actions":[{"name":"sway","duration_s":[1,2],)" +
         R"("params":{"angle_deg":{"type":"number","low":-5,"high":5}}}]})";
}

void sway(const contort_guest::Request& request, contort_guest::Motion& motion) {
  for (int frame = 0; frame < motion.frames(); ++frame) {
    double angle_deg = 0.0;
    for (const contort_guest::Use& use : request.uses) {
      const double wave = std::sin(kPi * use.progress(frame / request.rate_hz));
      angle_deg += wave * wave * use.params["angle_deg"].number;
    }
    for (int j = 1; j < kJoints; ++j) motion.turn(frame, j, {1, 0, 0}, angle_deg);
  }
}

double cpu_s(int whose) {
  rusage used{};
  getrusage(whose, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

struct Cost {
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double frames = 0.0;
};

template <class Work>
Cost cost_of(int whose, const Work& work) {
  const double begin_cpu_s = cpu_s(whose), begin_s = steady_s();
  work();
  return {steady_s() - begin_s, cpu_s(whose) - begin_cpu_s, 0.0};
}

// The median of each number separately; the number of rounds is odd.
template <class Round>
Cost median_cost(const Round& round) {
  std::vector<double> wall_s, cpu_s;
  double frames = 0.0;
  for (int i = 0; i < kRounds; ++i) {
    const Cost cost = round();
    wall_s.push_back(cost.wall_s), cpu_s.push_back(cost.cpu_s);
    frames = cost.frames;  // the same in each round
  }
  std::ranges::sort(wall_s), std::ranges::sort(cpu_s);
  return {wall_s[kRounds / 2], cpu_s[kRounds / 2], frames};
}

Spec request() {
  Spec spec;
  spec.character.name = "chain";
  ActionUse use;
  use.action = "sway", use.slot = "body", use.duration_frames = kFrames - 1, use.params["angle_deg"] = 4.0;
  ClipDesc clip;
  clip.actions.push_back(use);
  spec.sequences.push_back({"", 0, {clip}});
  return spec;
}

void print_request(const char* name, const std::string& format, const Cost& cost) {
  constexpr double kMs = 1000.0 / kRequests;
  std::printf("%s, %s: %.3f ms wall with the program's share, %.3f ms CPU of Contort\n", name, format.c_str(),
              kMs * cost.wall_s, kMs * cost.cpu_s);
}

void measure_requests(const std::string& self, const std::string& format) {
  const auto guest = GuestGenerator::start(self + " serve " + format);
  if (!guest) return (void)std::printf("%s\n", to_line(guest.issue()).c_str());
  const Spec spec = request();
  const Result<std::string> first = (*guest)->raw_frames(spec);
  if (!first) return (void)std::printf("%s\n", to_line(first.issue()).c_str());
  print_request("frames as they arrive", format, median_cost([&] {
    return cost_of(RUSAGE_SELF, [&] { for (int i = 0; i < kRequests; ++i) (void)(*guest)->raw_frames(spec); });
  }));
  print_request("frames converted     ", format, median_cost([&] {
    Execution execution;
    return cost_of(RUSAGE_SELF, [&] { for (int i = 0; i < kRequests; ++i) (void)(*guest)->run(spec, execution); });
  }));
}

double frames_in(const std::string& log) {
  std::ifstream file(log);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t found = text.rfind(" frames=");
  return found == std::string::npos ? 0.0 : std::atof(text.c_str() + found + 8);
}

Cost fuzz_cost(const std::string& contort, const std::string& generator, int cases, int jobs) {
  const std::string folder = (std::filesystem::temp_directory_path() / "contort_guest_bench").string();
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const std::string command = contort + " fuzz --generator '" + generator + "' --cases " + std::to_string(cases) +
                              " --jobs " + std::to_string(jobs) + " --corpus " + folder + "/corpus >" + folder +
                              "/log 2>&1";
  Cost cost = cost_of(RUSAGE_CHILDREN, [&] {
    if (std::system(command.c_str()) != 0) std::printf("has findings, whose shrinking counts: %s\n", command.c_str());
  });
  cost.frames = frames_in(folder + "/log");
  std::filesystem::remove_all(folder);
  return cost;
}

// The time of program starts and first motions is removed by subtracting a run with a quarter of the cases.
void measure_jobs(const std::string& contort, const std::string& generator, int cases) {
  Cost costs[2];
  for (int jobs = 1; jobs <= 2; ++jobs) {
    costs[jobs - 1] = median_cost([&] {
      const Cost few = fuzz_cost(contort, generator, cases / 4, jobs), all = fuzz_cost(contort, generator, cases, jobs);
      return Cost{all.wall_s - few.wall_s, all.cpu_s - few.cpu_s, all.frames - few.frames};
    });
    const Cost& cost = costs[jobs - 1];
    std::printf("fuzz with %d workers: %.0f frames/s wall, %.0f per second of CPU time with the program's share\n",
                jobs, cost.frames / cost.wall_s, cost.frames / cost.cpu_s);
  }
  std::printf("two workers over one: %.2f times as many frames a second, %.2f times the CPU time\n",
              costs[0].wall_s / costs[1].wall_s, costs[1].cpu_s / costs[0].cpu_s);
}

}  // namespace
}  // namespace contort

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "serve") return contort_guest::serve(contort::manifest_of(argc > 2 ? argv[2] : "f64"), contort::sway);
  if (first.empty()) {
    std::fprintf(stderr, "usage: contort_guest_bench CONTORT [CASES]\n");
    return 2;
  }
  const std::string self = std::filesystem::canonical("/proc/self/exe").string();
  for (const char* format : {"f32", "f64"}) contort::measure_requests(self, format);
  contort::measure_jobs(first, self + " serve f32", argc > 2 ? std::atoi(argv[2]) : 2000);
}
