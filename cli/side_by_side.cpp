#include "cli/side_by_side.h"

#include <cstdio>
#include <filesystem>

#include "cli/input.h"
#include "cli/tested.h"
#include "corpus/corpus.h"
#include "corpus/replay.h"
#include "process/ended.h"
#include "renders/divergence.h"

namespace contort::cli {

namespace {

// The result of a case in one of the two programs.
struct SideResult {
  std::string verdict;              // verdict, or the way in which the program ended
  std::optional<Execution> motion;  // empty if the program made no motion
};

SideResult play(const Case& stored, Evaluator& evaluator) {
  try {
    const Replay result = replay(stored, evaluator);
    SideResult side{std::string(verdict_name(result.verdict)), {}};
    if (result.verdict != Verdict::refused && !is_abnormal_exit(result.now)) side.motion = evaluator.execution();
    return side;
  } catch (const ProgramEnded& ended) {
    return {ended.ending().kind == Ending::Kind::timeout ? "timeout" : "ends: " + ended.ending().signal, {}};
  }
}

std::string difference_of(const SideResult& a, const SideResult& b) {
  if (!a.motion || !b.motion) return "no two motions to compare";
  const Result<Divergence> divergence = find_divergence({*a.motion->character, a.motion->motion},
                                                        {*b.motion->character, b.motion->motion}, kSamePlace_m);
  if (!divergence) return divergence.issue().text;
  return divergence->none() ? "" : divergence_text(*divergence, kSamePlace_m, a.motion->motion.rate_hz);
}

std::vector<std::string> cases_in(const std::string& path, Context& context) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return {path};
  const Result<Corpus> corpus = Corpus::open(path);
  if (!corpus) return context.fail(corpus.issue()), std::vector<std::string>{};
  std::vector<std::string> cases;
  std::vector<Issue> damaged;
  for (const Bucket& bucket : corpus->buckets(damaged)) cases.push_back(corpus->folder_of(bucket) + "/" + bucket.min);
  for (const Issue& issue : damaged) context.fail(issue);
  return cases;
}

struct SideCounts {
  int cases = 0;
  int other_verdicts = 0;
  int other_motions = 0;
};

void compare_case(const std::string& path, Evaluator& a, Evaluator& b, SideCounts& counts, Context& context) {
  const Result<Case> stored = read_case_input(path);
  if (!stored) return context.fail(stored.issue());
  const SideResult here = play(*stored, a), there = play(*stored, b);
  const std::string difference = difference_of(here, there);
  ++counts.cases;
  counts.other_verdicts += here.verdict != there.verdict ? 1 : 0;
  counts.other_motions += difference.empty() ? 0 : 1;
  std::printf("%-12s  against: %-12s  %s  %s\n", here.verdict.c_str(), there.verdict.c_str(), path.c_str(),
              difference.empty() ? "equal motions" : difference.c_str());
}

}  // namespace

void replay_side_by_side(const std::vector<std::string>& paths, const std::string& other, Generator& generator,
                         Context& context) {
  Sources sources = context.sources;
  sources.generator = other;
  const Result<Tested> base = load_tested(sources);
  if (!base) return context.fail(base.issue());
  const Result<CheckSettings> settings = context.load_settings_without_waivers();
  if (!settings) return context.fail(settings.issue());
  std::printf("generator: %s %s\nagainst:   %s %s\n", generator.manifest().name.c_str(),
              generator.manifest().build.c_str(), base->generator->manifest().name.c_str(),
              base->generator->manifest().build.c_str());
  Evaluator a(generator, *settings), b(*base->generator, *settings);
  SideCounts counts;
  for (const std::string& path : paths)
    for (const std::string& one : cases_in(path, context)) compare_case(one, a, b, counts, context);
  std::printf("RESULT cases=%d other_verdicts=%d other_motions=%d\n", counts.cases, counts.other_verdicts,
              counts.other_motions);
  if (counts.other_verdicts + counts.other_motions > 0 && context.exit_code == kClean) context.exit_code = kFindings;
}

}  // namespace contort::cli
