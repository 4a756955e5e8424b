// contort causes: lists the failures of a corpus, grouped by cause.
#include "cli/causes.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/outputs.h"
#include "cli/print.h"
#include "corpus/baseline.h"
#include "fuzz/run_state.h"
#include "model/core/json_fields.h"
#include "renders/report.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct CausesOptions {
  std::string corpus, baseline;
  bool all = false;
  bool json = false;
};

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + printable(name);
  return text;
}

// An absolute path, so that a command with it works in every folder.
std::string absolute(const std::string& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return error ? path : whole.lexically_normal().string();
}

std::string mark_of(CauseNews news) {
  switch (news) {
    case CauseNews::known: return "      ";
    case CauseNews::fresh: return "NEW   ";
    case CauseNews::more: return "MORE  ";
    case CauseNews::rare: return "RARE  ";
  }
  return "";
}

std::string row_text(const CauseRow& row, std::size_t place, const CausesText& about) {
  const std::string number = std::to_string(place) + ".";
  std::string text = number + std::string(number.size() < 4 ? 4 - number.size() : 1, ' ');
  text += mark_of(row.news) + printable(row.headline) + "\n          ";
  text += row.id + ": severity " + rounded_text(row.severity);
  if (about.cases > 0) text += ", " + count_text(row.cases) + " of " + counted(about.cases, "case", "cases");
  text += ", " + counted(std::ssize(row.members), "failure", "failures") + " (" + joined(row.characters) + ")  ";
  return text + replay_command(absolute(row.members.front().path), about.sources) + "\n";
}

Json row_json(const CauseRow& row) {
  const Case& deepest = row.members.front().minimal;
  const Cause cause = cause_of(deepest);
  Json buckets = Json::array();
  for (const CauseMember& member : row.members)
    buckets.push_back({{"id", member.bucket.id},
                       {"family", print_family(member.bucket.family)},
                       {"state", state_name(member.bucket.state)},
                       {"case", absolute(member.path)}});
  return {{"id", row.id},
          {"headline", row.headline},
          {"severity", row.severity},
          {"news", cause_news_names()[static_cast<std::size_t>(row.news)]},
          {"scope", cause_scope_names()[static_cast<std::size_t>(cause.scope)]},
          {"names", cause.names},
          {"also", cause.also},
          {"simulated", cause.is_simulated},
          {"kind", check_kind_names()[static_cast<std::size_t>(kind_of_check(deepest.expect.check))]},
          {"cases", row.cases},
          {"characters", row.characters},
          {"buckets", buckets}};
}

}  // namespace

std::string causes_text(std::span<const CauseRow> rows, const CausesText& about) {
  std::string text;
  const std::size_t shown = std::min(rows.size(), about.most);
  for (std::size_t i = 0; i < shown; ++i) text += row_text(rows[i], i + 1, about);
  if (shown < rows.size())
    text += "and " + counted(std::ssize(rows) - static_cast<std::int64_t>(shown), "other cause", "other causes") +
            ": contort causes --all " +
            shell_quoted(absolute(about.corpus)) + "\n";
  const auto any = [&](CauseNews news) { return std::ranges::find(rows, news, &CauseRow::news) != rows.end(); };
  if (any(CauseNews::more)) text += "MORE: known, but now more frequent than chance explains.\n";
  if (any(CauseNews::rare)) text += "RARE: not seen before, but too rare to say that anything has changed.\n";
  return text;
}

std::string causes_json(std::span<const CauseRow> rows, const CausesText& about) {
  Json list = Json::array();
  for (const CauseRow& row : rows) list.push_back(row_json(row));
  Json out = {{"format", "contort.causes/1"}, {"cases", about.cases}, {"causes", list}};
  if (about.unsettled > 0) out["unsettled"] = about.unsettled;
  return out.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::set<std::string> causes_named(std::span<const CauseMember> members, const std::string& prefix) {
  std::set<std::string> causes, of_failures;
  for (const CauseMember& member : members) {
    const std::string id = cause_id_of(member.minimal);
    if (prefix.empty()) continue;
    if (id.starts_with(prefix)) causes.insert(id);
    if (member.bucket.id.starts_with(prefix) || folder_name(member.bucket).starts_with(prefix)) of_failures.insert(id);
  }
  return causes.empty() ? of_failures : causes;
}

Issue no_such_cause(const std::string& prefix) {
  return {"corpus.no_cause", "",
          "the id of no cause begins with " + json_fields::quoted(prefix) +
              ", and that of no failure of one; contort causes shows them"};
}

std::vector<CauseMember> unfixed_members(const Corpus& corpus, Context& context) {
  std::vector<Issue> damaged;
  std::vector<Bucket> buckets = corpus.buckets(damaged);
  std::erase_if(buckets, [](const Bucket& bucket) { return bucket.state == BucketState::fixed; });
  std::vector<CauseMember> members = cause_members(corpus, std::move(buckets), damaged);
  for (const Issue& issue : damaged) context.fail(issue);
  return members;
}

namespace {

void run_causes(const CausesOptions& options, Context& context) {
  const Result<Corpus> corpus = Corpus::open(options.corpus);
  if (!corpus) return context.fail(corpus.issue());
  std::vector<CauseMember> members = unfixed_members(*corpus, context);
  const Result<Baseline> known = load_baseline(options.baseline);
  if (!known) return context.fail(known.issue());
  std::vector<Issue> damaged;
  const std::vector<RunRecord> runs = runs_of(*corpus, damaged);
  for (const Issue& issue : damaged) context.fail(issue);
  CausesText about{.corpus = options.corpus, .unsettled = unsettled_failures(*corpus), .sources = context.sources};
  for (const RunRecord& run : runs) about.cases += run.cases;
  const auto buckets = std::ssize(members);
  std::vector<CauseRow> rows = causes_of(std::move(members), runs);
  if (!options.baseline.empty()) mark_news(rows, *known, group_counts_of(runs, known->runs));
  if (options.all) about.most = rows.size();
  if (options.json) return void(std::printf("%s\n", causes_json(rows, about).c_str()));
  std::printf("%s%s, %s\n", causes_text(rows, about).c_str(), counted(std::ssize(rows), "cause", "causes").c_str(),
              counted(buckets, "failure", "failures").c_str());
  if (about.unsettled > 0) std::printf("%s\n", unsettled_text(about.unsettled).c_str());
}

}  // namespace

void add_causes(CLI::App& app, Context& context) {
  auto options = std::make_shared<CausesOptions>();
  CLI::App* command = app.add_subcommand("causes", "Group the failures of a corpus by what causes them");
  command->add_option("corpus", options->corpus, "Folder of the corpus")->required();
  command->add_option("--baseline", options->baseline,
                      "Another corpus, or a file with the output of contort corpus list --json: causes that it does "
                      "not have are new");
  command->add_flag("--all", options->all, "Print every cause, not only the most severe ones");
  command->add_flag("--json", options->json, "Print all causes with their buckets as JSON");
  command->footer("Example: contort causes contort-out/corpus");
  command->callback([options, &context] { run_causes(*options, context); });
}

}  // namespace contort::cli
