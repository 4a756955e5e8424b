#include "cli/against.h"

#include <CLI/CLI.hpp>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <tuple>

#include "cli/input.h"
#include "cli/print.h"
#include "cli/replay_text.h"
#include "cli/tested.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

// A failure that counts, with the data of its bucket.
struct AgainstRow {
  Case minimal;
  std::string path;
  bool is_worse = false;
};

// Returns text such as "0.1.0 0123456789abcdef".
Result<std::string> build_text(const std::string& version, const std::string& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.issue();
  return version + " " + content_id(*bytes).substr(0, 16);
}

// Searches for a name without a slash in the folders of PATH, as shells do. A name that is not found stays unchanged.
std::string program_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  if (name.find('/') != name.npos || path == nullptr) return name;
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = folder + "/" + name; !folder.empty() && ::access(file.c_str(), X_OK) == 0) return file;
  return name;
}

std::vector<std::string> base_command(const std::string& base, const Sources& sources, const Context& context) {
  std::vector<std::string> command = {base};
  for (const std::string& argument : sources.arguments()) command.push_back(argument);
  if (!context.settings_file.empty()) command.insert(command.end(), {"--settings", context.settings_file});
  command.insert(command.end(), {"--today", context.day(), "measure"});
  return command;
}

std::vector<std::string> in_both(const std::vector<std::string>& ours, const std::vector<std::string>& theirs) {
  std::vector<std::string> both;
  for (const std::string& name : ours)
    if (std::ranges::find(theirs, name) != theirs.end()) both.push_back(name);
  return both;
}

std::vector<std::string> not_compared(const AgainstConfig& against) {
  std::vector<std::string> missing = own_hello(CONTORT_VERSION).checks;
  std::erase_if(missing, [&](const std::string& name) {
    return std::ranges::find(against.rules.checks, name) != against.rules.checks.end();
  });
  return missing;
}

bool is_milder_in_base(const Provenance& from) { return from.base_shows == base_shows_name(BaseShows::milder); }

std::optional<AgainstRow> row_of(const std::string& folder) {
  const Result<Bucket> bucket = read_bucket(folder);
  if (!bucket) return std::nullopt;
  const std::string path = folder + "/" + bucket->min;
  Result<Case> minimal = read_case(path);
  if (!minimal) return std::nullopt;
  const bool worse = is_milder_in_base(minimal->provenance);
  return AgainstRow{std::move(minimal).value(), path, worse};
}

// Families that broke come first, then those that got worse; the deepest of each first.
std::vector<AgainstRow> rows_of(const RunResult& result) {
  std::vector<AgainstRow> rows;
  for (const std::vector<std::string>* folders : {&result.new_buckets, &result.known_buckets})
    for (const std::string& folder : *folders)
      if (std::optional<AgainstRow> row = row_of(folder)) rows.push_back(std::move(*row));
  std::ranges::stable_sort(rows, {}, [](const AgainstRow& row) {
    return std::tuple(row.is_worse, -depth_of(row.minimal.expect), family_of(row.minimal), row.path);
  });
  return rows;
}

}  // namespace

std::string sentence_about_base(const Provenance& from) {
  if (from.base_shows.empty()) return "";
  if (is_milder_in_base(from)) return "worse than in the base, which has depth " + decimal(-from.base_margin, 2);
  std::string text = "new since the base; the base passes this case";
  if (from.base_margin > 0.0) text += " by " + decimal(from.base_margin, 2);
  if (from.base_shows == base_shows_name(BaseShows::passes)) text += ", and fails the check elsewhere in it";
  return text;
}

namespace {

std::string text_of_row(const AgainstRow& row, const Sources& sources) {
  return std::string(row.is_worse ? "WORSE  " : "BROKE  ") + printable(failure_text(row.minimal)) +
         "  depth " + decimal(depth_of(row.minimal.expect), 2) + ": " +
         sentence_about_base(row.minimal.provenance) + "  " + replay_command(row.path, sources);
}

std::string firsts_text(const AgainstCounts& counts) {
  std::string text;
  if (counts.first_moved >= 0)
    text += "first case that only moved: " + std::to_string(counts.first_moved) +
            (counts.first_moved_frame < 0 ? "" : ", from frame " + std::to_string(counts.first_moved_frame)) + "\n";
  if (counts.first_refused >= 0)
    text += "first case that the base refused: " + std::to_string(counts.first_refused) + ", " +
            printable(counts.first_refusal) + "\n";
  return text;
}

}  // namespace

void add_against_options(CLI::App& command, AgainstOptions& options) {
  CLI::Option* base = command.add_option("--against", options.base,
                                         "Another contort program, as a path or a name in PATH, or with --generator another "
                                         "generator: only failures that it does not show count");
  base->type_name("BASE");
  command.add_flag("--moved", options.moved, "Fail also if motions differ from those of the base without a new failure")
      ->needs(base);
  command
      .add_option("--tolerance", options.tolerance,
                  "Depth, in the check's scale, below which a failure of one build alone does not count")
      ->check(CLI::Range(0.0, 1e6))
      ->check(refuse_nan)
      ->capture_default_str()
      ->needs(base);
}

Result<std::string> own_build() { return build_text(CONTORT_VERSION, "/proc/self/exe"); }

namespace {

// The two builds of a comparison: the way to start the base, and their names.
struct Pair {
  std::vector<std::string> command;
  std::string base;
  std::string build;
  MeasureHello hello;  // hello of the base
};

Result<Pair> pair_of_contorts(const std::string& base, const WorkerLimits& limits, const Context& context) {
  const std::string program = program_path(base);
  const std::vector<std::string> command = base_command(program, context.sources, context);
  const Result<std::string> build = own_build();
  if (!build) return build.issue();
  if (const Result<std::string> there = build_text("", program); !there) return there.issue();
  const Result<MeasureHello> hello = greet(command, limits);
  if (!hello) return hello.issue();
  const Result<std::string> named = build_text(hello->version, program);
  if (!named) return named.issue();
  return Pair{command, *named, *build, *hello};
}

Result<std::string> build_of_generator(const Sources& sources) {
  const Result<Tested> tested = load_tested(sources);
  if (!tested) return tested.issue();
  const Manifest& manifest = tested->generator->manifest();
  return manifest.name + " " + manifest.build;
}

// This program measures the motions of both generators.
Result<Pair> pair_of_generators(const std::string& base, const WorkerLimits& limits, const Context& context) {
  Sources other = context.sources;
  other.generator = base;
  const Result<std::string> named = build_of_generator(other), build = build_of_generator(context.sources);
  if (!named) return named.issue();
  if (!build) return build.issue();
  const std::vector<std::string> command = base_command("/proc/self/exe", other, context);
  const Result<MeasureHello> hello = greet(command, limits);
  if (!hello) return hello.issue();
  return Pair{command, *named, *build, *hello};
}

}  // namespace

Result<std::optional<AgainstConfig>> choose_base(const AgainstOptions& options, const WorkerLimits& limits,
                                                 const Context& context) {
  if (options.base.empty()) return std::optional<AgainstConfig>();
  const Result<Pair> pair = context.sources.generator.empty() ? pair_of_contorts(options.base, limits, context)
                                                              : pair_of_generators(options.base, limits, context);
  if (!pair) return pair.issue();
  AgainstConfig against;
  against.start = [command = pair->command, limits] { return std::make_unique<BaseProgram>(command, limits); };
  against.base = pair->base, against.build = pair->build;
  against.rules = {options.tolerance, in_both(own_hello(CONTORT_VERSION).checks, pair->hello.checks)};
  return std::optional(std::move(against));
}

std::string folder_of_pair(const AgainstConfig& against) {
  return "contort-out/against-" + content_id(against.base + "\n" + against.build).substr(0, 8);
}

Result<Done> check_pair(const Corpus& corpus, const std::optional<AgainstConfig>& against) {
  std::vector<Issue> damaged;
  const std::vector<RunRecord> runs = runs_of(corpus, damaged);
  const auto is_of_this_pair = [&](const RunRecord& run) {
    if (run.against.has_value() != against.has_value()) return false;
    return !against || (run.against->base == against->base && run.against->build == against->build);
  };
  const bool is_without_runs = runs.empty() && against && !corpus.buckets(damaged).empty();
  if (std::ranges::all_of(runs, is_of_this_pair) && !is_without_runs) return Done{};
  return Issue{"against.other_corpus", "",
               corpus.folder() + (against ? " holds failures of other builds than these two; name another --corpus"
                                          : " holds what differs between two builds; name another --corpus")};
}

Result<Done> check_same_pair(std::span<const Corpus> corpora) {
  std::optional<std::string> pair;  // pair of all runs so far; "": no comparison
  std::vector<Issue> damaged;
  for (const Corpus& corpus : corpora)
    for (const RunRecord& run : runs_of(corpus, damaged)) {
      const std::string own = run.against ? run.against->base + "\n" + run.against->build : "";
      if (pair.value_or(own) != own)
        return Issue{"against.other_corpus", "",
                     corpus.folder() + " holds runs of other builds than the corpora before it; merge the corpora of one "
                                       "pair of builds, or of no comparison, at a time"};
      pair = own;
    }
  return Done{};
}

namespace {

constexpr std::size_t kMostRows = 20;  // greatest number of printed rows; the others are only counted

}  // namespace

void print_comparison(const RunResult& result, const AgainstConfig& against,
                      const Sources& sources) {
  const std::vector<AgainstRow> rows = rows_of(result);
  for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i)
    std::printf("%s\n", text_of_row(rows[i], sources).c_str());
  if (rows.size() > kMostRows) std::printf("and %zu more, in contort report CORPUS -o DIR\n", rows.size() - kMostRows);
  const std::vector<std::string> missing = not_compared(against);
  for (const std::string& name : missing) std::printf("not compared: %s, a check that the base lacks\n", name.c_str());
  const AgainstCounts& counts = *result.record.against;
  std::printf("%s", firsts_text(counts).c_str());
  std::printf(
      "compared with %s: %lld cases broke, %lld got worse, %lld were mended, %lld only moved, %lld were refused, "
      "%lld are the same\n",
      counts.base.c_str(), static_cast<long long>(counts.broke), static_cast<long long>(counts.worse),
      static_cast<long long>(counts.mended), static_cast<long long>(counts.moved),
      static_cast<long long>(counts.refused), static_cast<long long>(counts.same));
}

std::string comparison_json(const RunResult& result, const AgainstConfig& against,
                            const Sources& sources) {
  const AgainstCounts& counts = *result.record.against;
  Json rows = Json::array();
  for (const AgainstRow& row : rows_of(result))
    rows.push_back({{"family", print_family(family_of(row.minimal))},
                    {"change", row.is_worse ? "worse" : "broke"},
                    {"depth", depth_of(row.minimal.expect)},
                    {"base_shows", row.minimal.provenance.base_shows},
                    {"base_margin", row.minimal.provenance.base_margin},
                    {"index", row.minimal.provenance.index},
                    {"case", row.path},
                    {"command", replay_command(row.path, sources)}});
  const Json first_moved = {{"index", counts.first_moved}, {"frame", counts.first_moved_frame}};
  const Json first_refused = {{"index", counts.first_refused}, {"reason", counts.first_refusal}};
  return json_fields::compact_text({{"base", counts.base},
                                    {"build", counts.build},
                                    {"same", counts.same},
                                    {"moved", counts.moved},
                                    {"broke", counts.broke},
                                    {"worse", counts.worse},
                                    {"mended", counts.mended},
                                    {"refused", counts.refused},
                                    {"first_moved", counts.first_moved < 0 ? Json() : first_moved},
                                    {"first_refused", counts.first_refused < 0 ? Json() : first_refused},
                                    {"not_compared", not_compared(against)},
                                    {"rows", rows}});
}

std::string comparison_counts(const RunResult& result) {
  if (!result.record.against) return "";
  const AgainstCounts& counts = *result.record.against;
  return " broke=" + std::to_string(counts.broke) + " worse=" + std::to_string(counts.worse) +
         " mended=" + std::to_string(counts.mended) + " moved=" + std::to_string(counts.moved) +
         " refused=" + std::to_string(counts.refused) + " same=" + std::to_string(counts.same);
}

bool comparison_gates(const RunResult& result, const AgainstOptions& options) {
  if (!result.record.against) return false;
  const AgainstCounts& counts = *result.record.against;
  return counts.broke + counts.worse > 0 || (options.moved && counts.moved + counts.mended > 0);
}

bool compared_nothing(const RunResult& result) {
  if (!result.record.against) return false;
  return result.record.cases > 0 && result.record.against->refused + result.record.discarded == result.record.cases;
}

}  // namespace contort::cli
