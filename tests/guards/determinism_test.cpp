// Keeps code out of the source that gives other bits on other machines: platform maths, clocks, randomness, order,
// variables of the environment. It is a list of names, so it finds calls and not effects: it misses a Quat made from
// Euler angles, or a glm function found through its arguments under a name that is not listed. The golden hashes find
// these.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "tests/guards/source_text.h"

namespace contort::guards {
namespace {

using Names = std::set<std::string, std::less<>>;

// glibc picks the code of these by CPU. With the suffixes f and l, and as __builtin_…
const Names kPlatformMaths = {"sin",    "cos",    "tan",  "asin",  "acos",  "atan",  "atan2", "sincos",
                              "sinh",   "cosh",   "tanh", "asinh", "acosh", "atanh", "exp",   "exp2",
                              "expm1",  "log",    "log2", "log10", "log1p", "pow",   "cbrt",  "hypot",
                              "tgamma", "lgamma", "erf",  "erfc",  "polar"};

// glm's that call the above. Also refused without glm:: where they are called: arguments of glm types find them.
const Names kGlmMaths = {"slerp", "angleAxis", "eulerAngles", "angle", "axis", "rotate", "mix", "yaw", "pitch", "roll"};
// Refused with glm:: only, as the headers of these are not ours to include by chance.
const Names kGlmOther = {"rotation",      "squad",       "intermediate", "shortMix",      "fastMix",
                         "orientedAngle", "rotateX",     "rotateY",      "rotateZ",       "perspective",
                         "eulerAngleX",   "eulerAngleY", "eulerAngleZ",  "eulerAngleXYZ", "eulerAngleYXZ",
                         "axisAngle",     "interpolate", "yawPitchRoll", "linearRand",    "gaussRand",
                         "sphericalRand", "ballRand",    "diskRand",     "circularRand",  "axisAngleMatrix"};

const Names kChance = {"random_device",
                       "mt19937",
                       "mt19937_64",
                       "minstd_rand",
                       "minstd_rand0",
                       "knuth_b",
                       "default_random_engine",
                       "random_shuffle",
                       "shuffle",
                       "sample",
                       "rand",
                       "srand",
                       "uniform_int_distribution",
                       "uniform_real_distribution",
                       "normal_distribution",
                       "bernoulli_distribution",
                       "discrete_distribution",
                       "generate_canonical"};
const Names kChanceCalls = {"rand", "srand", "rand_r", "drand48", "lrand48", "getrandom", "getentropy"};

const Names kClock = {"chrono", "time", "clock", "localtime", "gmtime", "timespec_get", "this_thread"};
const Names kClockCalls = {"gettimeofday", "clock_gettime", "steady_s", "localtime_r",
                           "gmtime_r",     "usleep",        "nanosleep"};

// The standard does not define their order, value or grouping.
const Names kOrder = {"unordered_map", "unordered_set", "unordered_multimap", "unordered_multiset",
                      "hash",          "reduce",        "transform_reduce",   "execution"};

// A variable of the environment would change motions on one machine and not on another.
const Names kSurroundings = {"getenv", "secure_getenv", "setenv", "putenv", "environ"};

const Names kChanceHeaders = {"random", "glm/gtc/random.hpp"};
const Names kClockHeaders = {"chrono", "ctime", "time.h", "sys/time.h"};
const Names kOrderHeaders = {"unordered_map", "unordered_set", "execution"};

struct Scope {
  bool maths = false, chance = false, clock = false, order = false;
};

// The files in which the clock may be looked at: for watchdogs and time budgets, and to wait for threads.
constexpr std::array<std::string_view, 9> kClockFiles = {
    "process/clock.cpp",   "process/worker_pool.cpp", "process/line_program.cpp", "process/broker.cpp",
    "process/program.cpp", "fuzz/case_work.cpp",      "fuzz/parallel.cpp",        "fuzz/run.cpp",
    "fuzz/trial.cpp"};

Scope scope_of(std::string_view path) {
  constexpr std::array<std::string_view, 7> kFolders = {"model/",  "formats/", "generator/", "process/",
                                                        "checks/", "corpus/",  "fuzz/"};
  if (std::ranges::none_of(kFolders, [&](std::string_view folder) { return path.starts_with(folder); })) return {};
  const bool clock = std::ranges::find(kClockFiles, path) != kClockFiles.end();
  return {.maths = !path.starts_with("model/core/detmath."), .chance = true, .clock = !clock, .order = true};
}

// One identifier of the code and its surroundings.
struct Use {
  std::string name;
  std::string qualifier;  // "std" in std::sin; "::" in ::sin; "" without
  bool member = false;    // after . or ->
  bool declared = false;  // after a type or a name: double exp(…), Vec3 axis(…)
  bool called = false;    // before (
};

Use use_at(const std::string& code, std::size_t start, std::size_t end) {
  const auto skip_back = [&code](std::size_t at) {
    while (at > 0 && std::isspace(static_cast<unsigned char>(code[at - 1])) != 0) --at;
    return at;
  };
  const auto word_before = [&code](std::size_t at) {
    std::size_t from = at;
    while (from > 0 && is_word(code[from - 1])) --from;
    return code.substr(from, at - from);
  };
  Use use;
  use.name = code.substr(start, end - start);
  const std::size_t after = code.find_first_not_of(" \t\n", end);
  use.called = after != std::string::npos && code[after] == '(';
  const std::size_t before = skip_back(start);
  if (before >= 2 && code.compare(before - 2, 2, "::") == 0) {
    use.qualifier = word_before(skip_back(before - 2));
    static const Names kNoQualifiers = {"return", "else", "case", "throw"};  // return ::sin(x)
    if (use.qualifier.empty() || kNoQualifiers.contains(use.qualifier)) use.qualifier = "::";
  } else if (before >= 1 && code[before - 1] == '.') {
    use.member = true;
  } else if (before >= 2 && code.compare(before - 2, 2, "->") == 0) {
    use.member = true;
  } else {
    static const Names kNotTypes = {"return", "else", "case", "throw",     "do",
                                    "and",    "or",   "not",  "co_return", "co_yield"};
    const std::string word = word_before(before);
    use.declared = !word.empty() && !kNotTypes.contains(word);
  }
  return use;
}

std::string without_decoration(std::string name) {
  if (name.starts_with("__builtin_")) name.erase(0, 10);
  const bool suffixed = name.size() > 1 && (name.back() == 'f' || name.back() == 'l') && !kPlatformMaths.contains(name);
  return suffixed && kPlatformMaths.contains(name.substr(0, name.size() - 1)) ? name.substr(0, name.size() - 1) : name;
}

// Why the use is refused, or "".
std::string refusal(const Use& use, const Scope& scope) {
  const bool std_name = use.qualifier == "std" || use.qualifier == "::";
  const bool platform = std_name || use.qualifier == "glm";
  const bool bare_call = use.qualifier.empty() && use.called && !use.member && !use.declared;
  if (scope.maths) {
    const std::string plain = without_decoration(use.name);
    if (kPlatformMaths.contains(plain) && (platform || bare_call))
      return "its bits change with the CPU; use det::" + plain;
    if (kGlmMaths.contains(use.name) && (use.qualifier == "glm" || bare_call)) {
      return "glm's uses platform maths, and arguments find it; see model/core/math.h, or choose another name";
    }
    if (kGlmOther.contains(use.name) && use.qualifier == "glm") return "glm's uses platform maths";
  }
  if (scope.chance && ((kChance.contains(use.name) && std_name) || (kChanceCalls.contains(use.name) && bare_call))) {
    return "chance comes from the seed, through our own generator";
  }
  if (scope.clock && ((kClock.contains(use.name) && std_name) || (kClockCalls.contains(use.name) && bare_call))) {
    return "no clock: time is a frame";
  }
  if (scope.order && kSurroundings.contains(use.name) && (std_name || bare_call))
    return "the environment differs from machine to machine; pass a setting";
  if (scope.order && kOrder.contains(use.name) && std_name) return "its order or value is not fixed by the standard";
  return "";
}

std::vector<Violation> determinism_violations(const std::string& path, std::string_view text) {
  const Scope scope = scope_of(path);
  std::vector<Violation> violations;
  for (const Include& include : includes_of(text)) {
    if ((scope.chance && kChanceHeaders.contains(include.name)) ||
        (scope.clock && kClockHeaders.contains(include.name)) ||
        (scope.order && kOrderHeaders.contains(include.name))) {
      violations.push_back({path, include.line, "<" + include.name + "> makes motions differ"});
    }
  }
  const std::string code = code_of(text);
  int line = 1;
  for (std::size_t at = 0; at < code.size(); ++at) {
    if (code[at] == '\n') ++line;
    if (!is_word(code[at])) continue;
    const std::size_t start = at;
    while (at < code.size() && is_word(code[at])) ++at;
    const Use use = use_at(code, start, at);
    const std::string why = refusal(use, scope);
    if (!why.empty()) violations.push_back({path, line, use.name + ": " + why});
    --at;
  }
  return violations;
}

TEST(Determinism, TheProjectKeepsPlatformDifferencesOut) {
  std::vector<Violation> violations;
  int files_in_scope = 0;
  for (const SourceFile& file : project_files()) {
    if (!is_cpp(file.path) && !file.path.ends_with(".inc")) continue;
    if (scope_of(file.path).order) ++files_in_scope;
    std::ranges::copy(determinism_violations(file.path, file.text), std::back_inserter(violations));
  }
  EXPECT_GT(files_in_scope, 20);
  EXPECT_TRUE(violations.empty()) << to_text(violations);
}

struct Example {
  const char* path;
  const char* code;
};

TEST(Determinism, RefusesPlantedViolations) {
  constexpr Example kBad[] = {
      {"generator/actions/walk.cpp", "y = std::sin(t);"},
      {"model/core/math.cpp", "y = std::sin(t);"},
      {"generator/actions/walk.cpp", "y = sin(t);"},
      {"generator/actions/walk.cpp", "return cos (t);"},
      {"generator/actions/walk.cpp", "return ::cosf(t);"},
      {"generator/actions/walk.cpp", "y = 2*tan(t);"},
      {"generator/actions/walk.cpp", "y = x.y+atan2(a, b);"},
      {"generator/actions/walk.cpp", "y = std::\n  powf(a, b);"},
      {"generator/actions/walk.cpp", "auto f = std::exp;"},
      {"generator/actions/walk.cpp", "using std::log;"},
      {"generator/actions/walk.cpp", "y = __builtin_acos(x);"},
      {"generator/actions/walk.cpp", "y = std::hypot(a, b);"},
      {"generator/motion/ik.cpp", "q = glm::angleAxis(a, v);"},
      {"generator/motion/ik.cpp", "q = angleAxis(a, v);"},
      {"generator/motion/ik.cpp", "q = glm::slerp(a, b, t);"},
      {"generator/motion/ik.cpp", "q = glm::mix(a, b, t);"},
      {"generator/motion/ik.cpp", "e = glm::eulerAngles(q);"},
      {"generator/motion/ik.cpp", "v = glm :: rotate(q, v);"},
      {"generator/motion/ik.cpp", "return angle(q);"},
      {"generator/motion/ik.cpp", "v = glm::axis(q);"},
      {"generator/motion/ik.cpp", "m = glm::perspective(a, b, c, d);"},
      {"checks/joint_range.cpp", "y = acos(x);"},
      {"fuzz/mutate.cpp", "y = std::pow(2.0, x);"},
      {"corpus/bucket.cpp", "y = std::log2(x);"},
      {"model/core/random.h", "std::mt19937 engine;"},
      {"model/core/random.h", "#include <random>\n"},
      {"fuzz/draw.cpp", "std::uniform_int_distribution<int> d;"},
      {"fuzz/draw.cpp", "int i = rand();"},
      {"fuzz/draw.cpp", "std::srand(1);"},
      {"checks/check.cpp", "auto t = std::chrono::steady_clock::now();"},
      {"corpus/store.cpp", "#include <chrono>\n"},
      {"fuzz/compose.cpp", "const auto start = std::chrono::steady_clock::now();"},
      {"corpus/merge.cpp", "if (steady_s() > 3.0) return;"},
      {"corpus/store.cpp", "auto t = std::time(nullptr);"},
      {"corpus/store.cpp", "auto t = ::time(nullptr);"},
      {"corpus/store.cpp", "clock_gettime(CLOCK_REALTIME, &t);"},
      {"generator/dynamics/simulate.cpp", "if (std::getenv(\"TRACE\")) print();"},
      {"checks/judge.cpp", "const char* set = getenv(name);"},
      {"model/core/hash.cpp", "std::unordered_map<int, int> m;"},
      {"fuzz/run.cpp", "#include <unordered_set>\n"},
      {"corpus/store.cpp", "h = std::hash<std::string>{}(s);"},
  };
  for (const Example& bad : kBad) {
    EXPECT_EQ(determinism_violations(bad.path, bad.code).size(), 1U) << bad.path << " with " << bad.code;
  }
}

TEST(Determinism, AllowsWhatIsRight) {
  constexpr Example kGood[] = {
      {"generator/actions/walk.cpp", "y = det::sin(t) + contort::det::atan2(a, b);"},
      {"generator/actions/walk.cpp", "y = std::sqrt(x) + std::fabs(x) + std::floor(x) + glm::dot(a, b) + std::abs(x);"},
      {"generator/actions/walk.cpp", "// std::sin(x)\nconst char* s = \"cos(x)\";"},
      {"generator/actions/walk.cpp", "const Vec3 axis(0, 1, 0); const double angle = joint.angle(); p->rotate(q);"},
      {"generator/actions/walk.cpp", "single(x); cosine(x); log_line(x); my_exp(x); Foo::log(x);"},
      {"generator/actions/walk.cpp",
       "v = glm::normalize(glm::cross(a, b)); q = glm::conjugate(q); m = glm::mat3_cast(q);"},
      {"model/core/detmath.cpp", "double sin(double x) { return sincos(x).sin; }"},
      {"process/clock.cpp", "const auto start = std::chrono::steady_clock::now();"},
      {"renders/camera.cpp", "y = std::tan(x);"},
      {"cli/fuzz.cpp", "#include <chrono>\nstd::unordered_map<int, int> m;"},
      {"tests/core/detmath_test.cpp", "y = std::sin(x);"},
      {"corpus/store.cpp", "const double time = 3; int clock = 2; span.time; motion.time(3);"},
  };
  for (const Example& good : kGood) {
    const std::vector<Violation> violations = determinism_violations(good.path, good.code);
    EXPECT_TRUE(violations.empty()) << to_text(violations);
  }
}

}  // namespace
}  // namespace contort::guards
