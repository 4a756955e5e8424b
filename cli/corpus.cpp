// contort corpus: lists stored failures, records notes and decisions about them, and maintains the files.
#include "corpus/corpus.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "cli/causes.h"
#include "cli/commands.h"
#include "cli/corpus_list.h"
#include "cli/corpus_upkeep.h"
#include "cli/input.h"
#include "cli/print.h"
#include "cli/usage_text.h"
#include "corpus/bucket_files.h"
#include "corpus/causes.h"
#include "corpus/lifecycle.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

struct CorpusOptions {
  std::string corpus;
  std::vector<std::string> buckets, causes;
  std::vector<std::string> states;
  std::string check, character;
  std::string owner, ticket, reason, expires, text;
  bool fold_sides = false;
  bool json = false;
};

bool is_wanted(const Bucket& bucket, const CorpusOptions& options) {
  const std::string state(state_name(bucket.state));
  return (options.states.empty() || std::ranges::count(options.states, state) > 0) &&
         (options.check.empty() || bucket.check == options.check) &&
         (options.character.empty() || bucket.family.character == options.character);
}

Json bucket_json(const Corpus& corpus, Bucket bucket, const std::string& today) {
  Json out = Json::parse(print_bucket(bucket));
  out.erase("format");
  out["folder"] = corpus.folder_of(bucket);
  out["gating"] = is_gating(bucket, today);
  if (const Result<Case> minimal = corpus.minimal_of(bucket)) out["cause"] = cause_id_of(*minimal);
  return out;
}

void print_json(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

Result<Corpus> open_corpus(const CorpusOptions& options, Context& context) {
  Result<Corpus> corpus = Corpus::open(options.corpus);
  if (!corpus) context.fail(corpus.issue());
  return corpus;
}

// Reports damaged buckets, and returns the others.
std::vector<Bucket> read_buckets(const Corpus& corpus, Context& context) {
  std::vector<Issue> damaged;
  std::vector<Bucket> buckets = corpus.buckets(damaged);
  for (const Issue& issue : damaged) context.fail(issue);
  return buckets;
}

void list(const CorpusOptions& options, Context& context) {
  const Result<Corpus> corpus = open_corpus(options, context);
  if (!corpus) return;
  std::vector<Bucket> buckets = read_buckets(*corpus, context);
  std::erase_if(buckets, [&](const Bucket& bucket) { return !is_wanted(bucket, options); });
  const std::string today = context.day();
  if (options.json) {
    Json out = Json::array();
    for (const Bucket& bucket : buckets) out.push_back(bucket_json(*corpus, bucket, today));
    return print_json(out);
  }
  std::printf("%s", corpus_list_text({*corpus, std::move(buckets), today, options.fold_sides}).c_str());
}

// The bucket whose id or folder name begins with this prefix.
Result<Bucket> find_bucket(const std::vector<Bucket>& buckets, const std::string& prefix) {
  std::vector<Bucket> found;
  for (const Bucket& bucket : buckets)
    if (!prefix.empty() && (bucket.id.starts_with(prefix) || folder_name(bucket).starts_with(prefix)))
      found.push_back(bucket);
  if (found.empty())
    return Issue{"corpus.no_bucket", "", "the id of no failure begins with \"" + prefix + "\"; contort corpus list shows them"};
  if (found.size() == 1) return found.front();
  std::string names;
  for (const Bucket& bucket : found) names += (names.empty() ? "" : ", ") + folder_name(bucket);
  return Issue{"corpus.many_buckets", "", "\"" + prefix + "\" is the beginning of " + names};
}

std::string cause_text(const Case& minimal) {
  return cause_id_of(minimal) + ": " + cause_headline(minimal);
}

void show(const CorpusOptions& options, Context& context) {
  const Result<Corpus> corpus = open_corpus(options, context);
  if (!corpus) return;
  Result<Bucket> listed = find_bucket(read_buckets(*corpus, context), options.buckets.front());
  if (!listed) return context.fail(listed.issue());
  Bucket bucket = std::move(listed).value();
  const Result<Case> minimal = corpus->minimal_of(bucket);
  if (options.json) return print_json(bucket_json(*corpus, bucket, context.day()));
  const auto line = [](const char* name, const std::string& value) {
    if (!value.empty()) std::printf("%-10s %s\n", name, printable(value).c_str());
  };
  if (minimal) line("cause", cause_text(*minimal));
  line("bucket", folder_name(bucket));
  line("state", std::string(state_name(bucket.state)) + (is_gating(bucket, context.day()) ? ", fails the build" : ""));
  line("known", known_text(bucket, context.day()));
  line("note", bucket.note);
  line("family", print_family(bucket.family));
  line("features", bucket.features);
  for (const std::string& build : bucket.passed_in) line("passed in", build);
  for (const std::string& run : bucket.runs) line("run", run);
  if (minimal)
    for (const Family& other : minimal->co_failures) line("comes with", print_family(other));
  // A corpus has no path of the program under test, so the reader must add it to the command.
  Sources sources = context.sources;
  const std::string found_with = minimal ? minimal->provenance.generator : "";
  if (sources.generator.empty() && !found_with.empty()) sources.generator = "COMMAND OF " + found_with;
  line("generator", found_with);
  for (const std::string& file : files_of(bucket))
    line(file.substr(0, file.find('-')).c_str(), replay_command(corpus->folder_of(bucket) + "/" + file, sources));
}

// Returns the buckets of the only cause whose id begins with `prefix`, or that has a failure whose id does. Fixed
// buckets have no cause.
Result<std::vector<Bucket>> buckets_of_cause(const Corpus& corpus, std::vector<Bucket> buckets,
                                             const std::string& prefix) {
  std::erase_if(buckets, [](const Bucket& bucket) { return bucket.state == BucketState::fixed; });
  std::vector<Issue> unread;  // a bucket without a minimal case has no cause
  const std::vector<CauseMember> members = cause_members(corpus, std::move(buckets), unread);
  const std::set<std::string> named = causes_named(members, prefix);
  std::map<std::string, std::vector<Bucket>> of_cause;
  for (const CauseMember& member : members)
    if (const std::string id = cause_id_of(member.minimal); named.contains(id)) of_cause[id].push_back(member.bucket);
  if (of_cause.size() == 1) return of_cause.begin()->second;
  if (of_cause.empty())
    return no_such_cause(prefix);
  std::string ids;
  for (const auto& [id, own] : of_cause) ids += (ids.empty() ? "" : ", ") + id;
  return Issue{"corpus.many_causes", "", "\"" + prefix + "\" is the beginning of " + ids};
}

// Returns all buckets that the options name, by themselves or by their cause, each once.
Result<std::vector<Bucket>> chosen_buckets(const Corpus& corpus, const std::vector<Bucket>& all,
                                           const CorpusOptions& options) {
  if (options.buckets.empty() && options.causes.empty())
    return Issue{"corpus.nothing_named", "", "name failures by their ids, or causes with --cause; contort corpus list shows both"};
  std::vector<Bucket> chosen;
  const auto add = [&](const Bucket& bucket) {
    if (std::ranges::find(chosen, bucket.id, &Bucket::id) == chosen.end()) chosen.push_back(bucket);
  };
  for (const std::string& prefix : options.buckets) {
    const Result<Bucket> bucket = find_bucket(all, prefix);
    if (!bucket) return bucket.issue();
    add(*bucket);
  }
  for (const std::string& prefix : options.causes) {
    const Result<std::vector<Bucket>> members = buckets_of_cause(corpus, all, prefix);
    if (!members) return members.issue();
    for (const Bucket& bucket : *members) add(bucket);
  }
  return chosen;
}

// Changes nothing if one of the buckets is not found or may not be changed.
void change_all(const CorpusOptions& options, Context& context, const Corpus::Change& change) {
  const Result<Corpus> corpus = open_corpus(options, context);
  if (!corpus) return;
  const Result<std::vector<Bucket>> chosen = chosen_buckets(*corpus, read_buckets(*corpus, context), options);
  if (!chosen) return context.fail(chosen.issue());
  for (const Bucket& bucket : *chosen)
    if (const Result<Bucket> next = change(bucket); !next) return context.fail(next.issue());
  for (const Bucket& bucket : *chosen) {
    const Result<Bucket> next = corpus->change(bucket, change);
    if (!next) return context.fail(next.issue(), next.issue().code == "file.unwritable" ? kInternal : kBadInput);
    std::printf("%s is %s: %s\n", folder_name(*next).c_str(), std::string(state_name(next->state)).c_str(),
                printable(known_text(*next, context.day())).c_str());
  }
}

void ack(const CorpusOptions& options, Context& context) {
  change_all(options, context,
             [&](const Bucket& bucket) { return acknowledge(bucket, options.owner, options.ticket); });
}

void put_in_quarantine(const CorpusOptions& options, Context& context) {
  change_all(options, context, [&](const Bucket& bucket) {
    return quarantine(bucket, options.owner, options.reason, options.expires, context.day());
  });
}

void note(const CorpusOptions& options, Context& context) {
  change_all(options, context, [&](const Bucket& bucket) { return Result<Bucket>(annotate(bucket, options.text)); });
}

CLI::App* add(CLI::App& corpus, const std::string& name, const char* help,
              const std::shared_ptr<CorpusOptions>& options, Context& context,
              void (*run)(const CorpusOptions&, Context&)) {
  CLI::App* command = corpus.add_subcommand(name, help);
  command->add_option("CORPUS", options->corpus, "Corpus folder")->required();
  command->callback([options, &context, run] { run(*options, context); });
  return command;
}

void add_listing(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<CorpusOptions>();
  CLI::App* command = add(corpus, "list", "List failures by their cause, with the state of each", options, context, list);
  std::vector<std::string> states;
  for (int s = 0; s <= static_cast<int>(BucketState::invalid); ++s)
    states.emplace_back(state_name(static_cast<BucketState>(s)));
  command->add_option("--state", options->states, "Only failures in this state; may be repeated")
      ->allow_extra_args(false)
      ->check(one_of(states));
  command->add_option("--check", options->check, "Only failures of this check");
  command->add_option("--character", options->character, "Only failures of this character");
  CLI::Option* folded = command->add_flag("--fold-sides", options->fold_sides,
                                          "One line for failures that differ only in left and right");
  command->add_flag("--json", options->json, "Print a JSON list, which --baseline can read")->excludes(folded);
  command->footer("Example: contort corpus list contort-out/corpus --state new --state regressed");
}

void add_showing(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<CorpusOptions>();
  CLI::App* command = add(corpus, "show", "Show all that is known about a failure", options, context, show);
  command->add_option("FAILURE", options->buckets, "Beginning of the failure's id (contort corpus list), or of its folder's name")
      ->required()
      ->expected(1);
  command->add_flag("--json", options->json, "Print as JSON");
  command->footer("Example: contort corpus show contort-out/corpus 0123");
}

void add_choice(CLI::App& command, CorpusOptions& options) {
  command.add_option("FAILURE", options.buckets,
                     "Beginnings of ids of failures (contort corpus list), or of their folders' names");
  command.add_option("--cause", options.causes, "All failures of this cause: the beginning of its id, or of that of one of its failures (contort "
                     "causes); may be repeated")
      ->allow_extra_args(false);
}

void add_ack(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<CorpusOptions>();
  CLI::App* command =
      add(corpus, "ack", "Acknowledge failures: they become open, and no longer gate", options, context, ack);
  add_choice(*command, *options);
  command->add_option("--owner", options->owner, "Person who is responsible")->required();
  command->add_option("--ticket", options->ticket, "Ticket in which the failure is tracked")->required();
  command->footer("Example: contort corpus ack contort-out/corpus 0123 --owner ana --ticket 12");
}

void add_note(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<CorpusOptions>();
  CLI::App* command = add(corpus, "note", "Add a note to failures", options, context, note);
  add_choice(*command, *options);
  command->add_option("--text", options->text, "The note; \"\" removes it")->required();
  command->footer("Example: contort corpus note contort-out/corpus 0123 --text 'only with the heavy torso'");
}

void add_quarantine(CLI::App& corpus, Context& context) {
  auto options = std::make_shared<CorpusOptions>();
  CLI::App* command = add(corpus, "quarantine", "Let failures pass until a given day; they are still replayed", options,
                          context, put_in_quarantine);
  add_choice(*command, *options);
  command->add_option("--owner", options->owner, "Person who is responsible")->required();
  command->add_option("--reason", options->reason, "Reason why it may fail until then")->required();
  command->add_option("--expires", options->expires, "Last day, at most 30 days from today")
      ->required()
      ->type_name("YYYY-MM-DD");
  command->footer(
      "Example: contort corpus quarantine contort-out/corpus 0123 --owner ana --reason \"new gripper\" --expires "
      "2027-03-01");
}

}  // namespace

void add_corpus(CLI::App& app, Context& context) {
  CLI::App* corpus =
      app.add_subcommand("corpus", "List stored failures, acknowledge them, and keep the files in order");
  corpus->require_subcommand(1);
  corpus->fallthrough();
  corpus->footer("Example: contort corpus list contort-out/corpus\n'contort corpus COMMAND --help' explains one.");
  add_listing(*corpus, context);
  add_showing(*corpus, context);
  add_ack(*corpus, context);
  add_note(*corpus, context);
  add_quarantine(*corpus, context);
  add_upkeep(*corpus, context);
}

}  // namespace contort::cli
