// contort explain: learns the conditions under which the causes of a corpus show.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <thread>

#include "cli/against.h"
#include "cli/causes.h"
#include "cli/commands.h"
#include "cli/limits.h"
#include "cli/print.h"
#include "cli/progress_line.h"
#include "cli/tested.h"
#include "corpus/causes.h"
#include "corpus/rules_header.h"
#include "fuzz/condition_search.h"
#include "model/core/output.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

struct ExplainOptions {
  std::string corpus, header;
  std::vector<std::string> causes;
  int draws = 300;
  int jobs = 0;
  LimitOptions limits;
  bool stored_only = false;
  bool again = false;
  bool json = false;
};

// A condition that may have to be learned: of a cause on one character, from its deepest minimal case there.
struct Question {
  std::string cause;
  const Case* minimal = nullptr;
};

std::vector<Question> questions_of(const std::vector<CauseRow>& rows) {
  std::vector<Question> questions;
  for (const CauseRow& row : rows) {
    std::map<std::string, const Case*> deepest;  // by character; the deepest member comes first
    for (const CauseMember& member : row.members) deepest.emplace(member.minimal.spec.character.name, &member.minimal);
    for (const auto& [character, minimal] : deepest)
      if (can_have_condition(*minimal)) questions.push_back({row.id, minimal});
  }
  return questions;
}

Result<std::vector<CauseRow>> asked_for(std::vector<CauseRow> rows, const std::vector<std::string>& prefixes) {
  if (prefixes.empty()) return rows;
  std::vector<CauseMember> members;
  for (const CauseRow& row : rows) members.insert(members.end(), row.members.begin(), row.members.end());
  std::set<std::string> chosen;
  for (const std::string& prefix : prefixes) {
    std::set<std::string> named = causes_named(members, prefix);
    if (named.empty()) return no_such_cause(prefix);
    chosen.merge(named);
  }
  std::erase_if(rows, [&](const CauseRow& row) { return !chosen.contains(row.id); });
  return rows;
}

std::vector<CauseRow> cause_rows(const Corpus& corpus, Context& context) {
  std::vector<Issue> damaged;
  const std::vector<RunRecord> runs = runs_of(corpus, damaged);
  for (const Issue& issue : damaged) context.fail(issue);
  return causes_of(unfixed_members(corpus, context), runs);
}

class Explainer {
 public:
  Explainer(const ExplainOptions& options, const Corpus& corpus, Context& context)
      : options_(options), corpus_(corpus), context_(context) {}

  // Learns missing and void rules, and stores each at once, so that an interruption loses at most one.
  Result<Done> learn(const std::vector<Question>& questions) {
    Generator* generator = context_.load_generator();
    const Result<CheckSettings> settings = context_.load_settings();
    if (generator == nullptr) return Done{};  // the error was printed before
    if (!settings) return settings.issue();
    if (const Result<Done> same = check_generator(corpus_, generator->manifest()); !same) return same;
    const Result<std::string> build = own_build();
    if (!build) return build.issue();
    ConditionSearch search{.draws = options_.draws, .tool = *build};
    const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    search.jobs = options_.jobs > 0 ? options_.jobs : cores;
    const ProgressLine progress;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const Case& minimal = *questions[i].minimal;
      if (!options_.again && is_known(minimal, *build)) continue;
      progress.show(static_cast<double>(i) / static_cast<double>(questions.size()),
                    "learning condition " + std::to_string(i + 1) + " of " + std::to_string(questions.size()));
      const Result<Condition> found = find_condition(minimal, *generator, *settings, search);
      if (!found) {
        progress.clear();
        const bool is_ended = found.issue().code == "explain.program_ended";
        context_.fail(about_cause(questions[i].cause, found.issue()), is_ended ? kInconclusive : kBadInput);
        continue;
      }
      if (const Result<Done> kept = keep(*found); !kept) return kept.issue();
    }
    progress.clear();
    return Done{};
  }

  // Removes the rules of causes that the corpus does not have any more, such as fixed ones.
  Result<Done> forget_others(const std::vector<CauseRow>& rows) {
    const auto is_gone = [&rows](const Condition& condition) {
      return std::ranges::none_of(rows, [&](const CauseRow& row) {
        return row.id == condition.cause && row.characters.contains(condition.character);
      });
    };
    if (std::ranges::none_of(conditions_, is_gone)) return Done{};
    return change([&is_gone](std::vector<Condition>& stored) { std::erase_if(stored, is_gone); });
  }

  Result<Done> read() {
    Result<std::vector<Condition>> stored = conditions_of(corpus_);
    if (!stored) return stored.issue();
    conditions_ = std::move(stored).value();
    return Done{};
  }

  const std::vector<Condition>& conditions() const { return conditions_; }

 private:
  static Issue about_cause(const std::string& cause, Issue issue) {
    issue.text = "cause " + cause + ": " + issue.text;
    return issue;
  }

  bool is_known(const Case& minimal, const std::string& build) const {
    return std::ranges::any_of(conditions_, [&](const Condition& condition) {
      return condition.cause == cause_id_of(minimal) && condition.character == minimal.spec.character.name &&
             condition.learned_from == spec_id(minimal.spec) && condition.tool == build &&
             condition.character_hash == minimal.expect.character_hash;
    });
  }

  Result<Done> keep(const Condition& found) {
    return change([&found](std::vector<Condition>& stored) {
      std::erase_if(stored, [&](const Condition& condition) {
        return condition.cause == found.cause && condition.character == found.character;
      });
      stored.push_back(found);
    });
  }

  Result<Done> change(const ConditionsChange& how) {
    Result<std::vector<Condition>> stored = change_conditions(corpus_, how);
    if (!stored) return stored.issue();
    conditions_ = std::move(stored).value();
    return Done{};
  }

  const ExplainOptions& options_;
  const Corpus& corpus_;
  Context& context_;
  std::vector<Condition> conditions_;
};

constexpr char kNoCondition[] =
    "No condition can be learned: rules are for findings in motions, and not for crashes, timeouts, too much memory, "
    "recordings and swapped parts.";

void print(const std::vector<CauseRow>& rows, const std::vector<Condition>& conditions) {
  std::size_t place = 0, with_rule = 0;
  for (const CauseRow& row : rows) {
    std::printf("%zu. %s\n   %s\n", ++place, printable(row.headline).c_str(), row.id.c_str());
    bool is_learned = false, has_one = false;
    for (const Condition& condition : conditions)
      if (condition.cause == row.id) {
        std::printf("   %s: %s\n", printable(condition.character).c_str(), condition_text(condition).c_str());
        is_learned = true, has_one |= has_rule(condition);
      }
    const bool can_be = std::ranges::any_of(
        row.members, [](const CauseMember& member) { return can_have_condition(member.minimal); });
    if (!is_learned) std::printf("   %s\n", can_be ? "No condition was learned." : kNoCondition);
    with_rule += has_one ? 1 : 0;
  }
  std::printf("RESULT causes=%zu with_rule=%zu\n", rows.size(), with_rule);
}

void print_json(const std::vector<CauseRow>& rows, const std::vector<Condition>& conditions) {
  std::vector<Condition> of_rows;
  for (const Condition& condition : conditions)
    if (std::ranges::find(rows, condition.cause, &CauseRow::id) != rows.end()) of_rows.push_back(condition);
  std::printf("%s", print_conditions(std::move(of_rows)).c_str());
}

void run_explain(const ExplainOptions& options, Context& context) {
  take_limits(options.limits, context.sources);
  const Result<Corpus> corpus = Corpus::open(options.corpus);
  if (!corpus) return context.fail(corpus.issue());
  const Result<std::vector<CauseRow>> rows = asked_for(cause_rows(*corpus, context), options.causes);
  if (!rows) return context.fail(rows.issue());
  Explainer explainer(options, *corpus, context);
  if (const Result<Done> read = explainer.read(); !read) return context.fail(read.issue());
  if (const Result<Done> writable = options.header.empty() ? Done{} : check_output(options.header); !writable)
    return context.fail(writable.issue(), exit_of(writable.issue()));
  if (!options.stored_only && options.causes.empty())
    if (const Result<Done> forgot = explainer.forget_others(*rows); !forgot)
      return context.fail(forgot.issue(), exit_of(forgot.issue()));
  if (!options.stored_only)
    if (const Result<Done> learned = explainer.learn(questions_of(*rows)); !learned)
      return context.fail(learned.issue(), exit_of(learned.issue()));
  if (!options.header.empty())
    if (const Result<Done> written = write_output(options.header, rules_header(explainer.conditions(), options.corpus));
        !written)
      return context.fail(written.issue(), exit_of(written.issue()));
  options.json ? print_json(*rows, explainer.conditions()) : print(*rows, explainer.conditions());
}

}  // namespace

void add_explain(CLI::App& app, Context& context) {
  auto options = std::make_shared<ExplainOptions>();
  CLI::App* command = app.add_subcommand("explain", "Learn under which conditions the causes of a corpus show");
  command->add_option("corpus", options->corpus, "Folder of the corpus")->required();
  command->add_option("--cause", options->causes, "Only causes whose id, or that of one of whose failures, begins like this (contort causes); may be "
                      "repeated");
  command->add_option("--draws", options->draws, "Cases that a rule is learned from")
      ->check(CLI::Range(60, 100'000))
      ->capture_default_str();
  command->add_option("--jobs", options->jobs, "Threads (default: one per core)")->check(CLI::Range(1, 1024));
  add_program_limit_options(*command, options->limits);
  CLI::Option* stored = command->add_flag("--stored", options->stored_only, "Print what is stored, and learn nothing");
  command->add_flag("--again", options->again, "Learn all conditions anew, also those that are still valid")
      ->excludes(stored);
  command->add_option("--header", options->header, "Also write all rules of the corpus as a C++ header to this file")
      ->type_name("FILE");
  command->add_flag("--json", options->json, "Print the conditions as JSON (contort.rules/1)");
  command->footer("Example: contort explain contort-out/corpus --cause 29fa");
  command->callback([options, &context] { run_explain(*options, context); });
}

}  // namespace contort::cli
