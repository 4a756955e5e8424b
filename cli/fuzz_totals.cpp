#include "cli/fuzz_totals.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <span>

#include "cli/against.h"
#include "cli/causes.h"
#include "cli/input.h"
#include "cli/print.h"
#include "corpus/search_progress.h"
#include "model/core/json_fields.h"
#include "renders/search_html.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

std::string name_of_folder(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

std::vector<CauseRow> causes_found(const RunResult& result, const Corpus& corpus, const Baseline& baseline) {
  std::set<std::string> fresh, touched;
  for (const std::string& folder : result.new_buckets) fresh.insert(name_of_folder(folder));
  touched = fresh;
  for (const std::string& folder : result.known_buckets) touched.insert(name_of_folder(folder));
  std::vector<Issue> damaged;  // the run has reported unreadable files before
  std::vector<CauseMember> found, before;
  for (CauseMember& member : cause_members(corpus, corpus.buckets(damaged), damaged)) {
    const std::string name = folder_name(member.bucket);
    if (!fresh.contains(name)) before.push_back(member);
    if (touched.contains(name)) found.push_back(std::move(member));
  }
  Baseline known = baseline;
  const std::set<std::string> ids = cause_ids(before);
  known.causes.insert(ids.begin(), ids.end());
  std::set<std::string> counted = baseline.runs;
  counted.insert(result.record.name);
  add(group_counts_of(runs_of(corpus, damaged), counted), known.seen);
  std::vector<CauseRow> rows = causes_of(std::move(found), std::span(&result.record, 1));
  mark_news(rows, known, group_counts_of(std::span(&result.record, 1)));
  return rows;
}

namespace {

// Text such as "3 of them new, 1 more frequent than before, 12 too rare to say".
std::string news_text(std::span<const CauseRow> causes) {
  const auto with = [&](CauseNews news) { return count_text(std::ranges::count(causes, news, &CauseRow::news)); };
  std::string text = with(CauseNews::fresh) + " of them new";
  if (const std::string more = with(CauseNews::more); more != "0") text += ", " + more + " more frequent than before";
  if (const std::string rare = with(CauseNews::rare); rare != "0") text += ", " + rare + " too rare to say";
  return text;
}

// The verdict in one sentence.
std::string verdict(const RunRecord& record, std::span<const CauseRow> causes) {
  if (record.cases == 0) return "No case ran.";
  const std::int64_t judged = record.cases - record.discarded;
  if (judged == 0) return "The generator refused every case, so that nothing was judged.";
  const std::string share =
      clean_share(judged, record.failing) + " of " + counted(judged, "case is clean", "cases are clean");
  if (record.failing == 0) return share + ".";
  const std::string failing = share + "; " + counted(record.failing, "case fails", "cases fail");
  if (causes.empty()) return failing + "; none has a smallest case yet, so no cause is known.";
  return failing + ", by " + counted(std::ssize(causes), "cause", "causes") + ", " + news_text(causes) + ".";
}

void print_causes(const RunResult& result, const TotalsRequest& request) {
  const Result<Corpus> corpus = Corpus::open(request.corpus);
  if (!corpus) return;
  const std::vector<CauseRow> causes = causes_found(result, *corpus, request.baseline);
  std::printf("%s\n%s", verdict(result.record, causes).c_str(),
              causes_text(causes, {.cases = result.record.cases, .corpus = request.corpus, .sources = request.sources})
                  .c_str());
}

constexpr std::size_t kMostUnsteady = 5;  // greatest number of printed ones; the others are only counted
constexpr std::size_t kMostReasons = 5;   // greatest number of printed reasons for refusals

void print_unsteady(const RunResult& result, const TotalsRequest& request) {
  for (std::size_t i = 0; i < std::min(result.unconfirmed.size(), kMostUnsteady); ++i)
    std::printf("NOT CONFIRMED (a second run differed)  %s\n",
                replay_command(result.unconfirmed[i], request.sources).c_str());
  if (result.unconfirmed.size() > kMostUnsteady)
    std::printf("and %zu more that were not confirmed, in %s/leads\n", result.unconfirmed.size() - kMostUnsteady,
                request.corpus.c_str());
}

void print_found(const RunResult& result, const TotalsRequest& request) {
  if (request.against)
    print_comparison(result, *request.against, request.sources);
  else
    print_causes(result, request);
  print_unsteady(result, request);
}

json_fields::Json refusals_json(const RefusalCounts& counts) {
  json_fields::Json list = json_fields::Json::array();
  for (const RefusalCount& count : by_frequency(counts))
    list.push_back({{"reason", count.text}, {"cases", count.cases}});
  return list;
}

void print_totals_json(const RunResult& result, const TotalsRequest& request) {
  const RunRecord& t = result.record;
  json_fields::Json families = json_fields::Json::object(), arms = json_fields::Json::object();
  for (const auto& [family, count] : t.families) families[print_family(family)] = count.cases;
  for (const auto& [arm, count] : t.arms)
    arms[arm] = {{"cases", count.cases}, {"failing", count.failing}, {"families", 0}};
  for (const auto& [family, count] : t.families)
    if (arms.contains(count.first_arm))
      arms[count.first_arm]["families"] = arms[count.first_arm]["families"].get<int>() + 1;
  json_fields::Json out = {{"cases", t.cases},
                           {"frames", t.frames},
                           {"failing", t.failing},
                           {"families", families},
                           {"arms", arms},
                           {"shard", t.shard},
                           {"shards", t.shards},
                           {"new_buckets", result.new_buckets},
                           {"known_buckets", result.known_buckets},
                           {"waiting", result.waiting},
                           {"unsettled", result.unsettled},
                           {"unconfirmed", result.unconfirmed},
                           {"discarded", t.discarded},
                           {"refusals", refusals_json(t.refusals)},
                           {"waivers", json_fields::Json::parse(waivers_json(request.settings, result.waivers))},
                           {"tested", t.tested}};
  if (request.against)
    out["against"] = json_fields::Json::parse(comparison_json(result, *request.against, request.sources));
  if (!request.report.empty()) out["report"] = request.report + "/index.html";
  std::printf("%s\n", out.dump(2, ' ', false, json_fields::Json::error_handler_t::replace).c_str());
}

// The run was stopped by a signal.
std::string stopped_text(int unsettled) {
  const std::string rest = "The same command with --resume continues the run.";
  if (unsettled == 0) return "The run was stopped. " + rest;
  return "The run was stopped before " + counted(unsettled, "failure", "failures") + " could be shrunk. " + rest;
}

std::string kinds_text(std::int64_t count) { return counted(count, "kind of failure", "kinds of failure"); }

void print_counts(const RunResult& result, const TotalsRequest& request) {
  const RunRecord& t = result.record;
  const std::string cases = counted(t.cases, "case", "cases"), frames = counted(t.frames, "frame", "frames");
  const std::string failed = counted(t.failing, "case", "cases") + (request.against ? " broke or got worse" : " failed");
  std::printf("%s (%s) in %.1f s: %s, with %s; stored in %s\n", cases.c_str(), frames.c_str(), result.elapsed_s,
              failed.c_str(), kinds_text(std::ssize(t.families)).c_str(), request.corpus.c_str());
  const auto late =
      std::ranges::count_if(t.families, [](const auto& family) { return family.second.first_indices.empty(); });
  if (late > 0)
    std::printf("%s only counted: of each case only its %d earliest failures are stored. Raise --shrinks-per-case to "
                "store more.\n",
                (kinds_text(late) + (late == 1 ? " is" : " are")).c_str(), request.shrinks_per_case);
}

void print_totals_text(const RunResult& result, const TotalsRequest& request) {
  const RunRecord& t = result.record;
  print_found(result, request);
  for (const std::string& line : waiver_lines(request.settings, result.waivers)) std::printf("%s\n", line.c_str());
  for (const std::string& line : refusal_lines(t.refusals, t.discarded, t.cases, kMostReasons))
    std::printf("%s\n", printable(line).c_str());
  print_counts(result, request);
  if (t.cases > t.discarded && !request.against) std::printf("%s\n", outlook(progress_of(std::span(&t, 1))).c_str());
  if (result.interrupted) std::printf("%s\n", stopped_text(result.unsettled).c_str());
  if (!result.waiting.empty())
    std::printf("Time was up before %s could be shrunk. The next contort fuzz in %s shrinks them.\n",
                counted(std::ssize(result.waiting), "failure", "failures").c_str(), request.corpus.c_str());
  if (t.shards > 1)
    std::printf("shard %d of %d: what it found waits in %s/leads for contort merge\n", t.shard, t.shards,
                request.corpus.c_str());
}

}  // namespace

void print_totals(const RunResult& result, const TotalsRequest& request) {
  request.json ? print_totals_json(result, request) : print_totals_text(result, request);
}

// The last line, whatever else was printed.
void print_result(const RunResult& result) {
  const RunRecord& t = result.record;
  const std::size_t waiting = result.waiting.size() + static_cast<std::size_t>(result.unsettled);
  std::printf(
      "RESULT findings=%lld new=%zu known=%zu waiting=%zu families=%zu unconfirmed=%zu cases=%lld frames=%lld%s\n",
      static_cast<long long>(t.failing), result.new_buckets.size(), result.known_buckets.size(), waiting,
      t.families.size(), result.unconfirmed.size(), static_cast<long long>(t.cases), static_cast<long long>(t.frames),
      comparison_counts(result).c_str());
}

}  // namespace contort::cli
