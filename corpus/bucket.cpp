#include "corpus/bucket.h"

#include <set>
#include <tuple>

#include "generator/core/files.h"
#include "generator/core/hash.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Rule;
using json_fields::Text;

constexpr std::string_view kStateNames[] = {"new", "open", "fixed", "regressed", "flaky", "quarantined", "invalid"};

const Rule kNeeded{.text = Text::label, .required = true};
const Rule kLabel{.text = Text::label, .may_be_empty = true};
const Rule kProse{.text = Text::prose};
const Rule kCount{.low = 0, .high = 1e9};

int count_actions(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  return count;
}

int count_clips(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences) count += static_cast<int>(sequence.clips.size());
  return count;
}

std::string up_to_three(int count) { return count < 3 ? std::to_string(count) : "3+"; }

// Of the queue and of what interrupts it, sorted.
std::set<std::string> actions_of(const Spec& spec) {
  std::set<std::string> names;
  const auto add = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions) names.insert(use.action);
  };
  for (const SequenceDesc& sequence : spec.sequences) add(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) add(interrupt.sequence);
  return names;
}

}  // namespace

template <class V>
void fields(V& v, const Bucket*) {
  v.constant("format", "contort.bucket/1");
  v.field("id", &Bucket::id, kNeeded, "Hash of family and features.");
  v.field("check", &Bucket::check, {.required = true}, "The check that fails.");
  v.field("family", &Bucket::family, {.text = Text::prose, .required = true},
          "Identity of the failure, without numbers.");
  v.field("features", &Bucket::features, kProse, "What the minimal spec needed.");
  v.field("signature", &Bucket::signature, {.low = 1, .high = 1e6}, "Version of the rules that made the id.");
  v.field("state", &Bucket::state, {.names = kStateNames, .required = true}, "What is to be done about it.");
  v.field("was", &Bucket::was, {.names = kStateNames}, "State before it was flaky or invalid.");
  v.field("owner", &Bucket::owner, kLabel, "Who looks after it.");
  v.field("ticket", &Bucket::ticket, kLabel, "Where that is written down.");
  v.field("reason", &Bucket::reason, kProse, "Why it is quarantined.");
  v.field("expires", &Bucket::expires, kLabel, "Last day of the quarantine, YYYY-MM-DD.");
  v.field("note", &Bucket::note, {.text = Text::prose, .may_be_empty = true}, "What people say about it.");
  v.field("passed_in", &Bucket::passed_in, {.max_count = 2, .text = Text::label},
          "Builds in which it was gone since it failed last.");
  v.field("streak", &Bucket::streak, kCount, "Replays in a row: passed while quarantined, steady while flaky.");
  v.field("changes", &Bucket::changes, kCount, "How often the state and what belongs to it changed.");
  v.field("runs", &Bucket::runs, {.max_count = 100000}, "Runs that put a case here.");
  v.field("min", &Bucket::min, kLabel, "File of the smallest case.");
  v.field("worst", &Bucket::worst, kLabel, "File of the deepest case.");
  v.field("orig", &Bucket::orig, kLabel, "File of the case that min was shrunk from.");
}

std::string features_of(const Spec& spec) {
  std::string text = "actions=";
  for (const std::string& action : actions_of(spec)) text += (text.back() == '=' ? "" : ",") + action;
  text += " clips=" + up_to_three(count_clips(spec));
  text += " sequences=" + up_to_three(static_cast<int>(spec.sequences.size()));
  const std::pair<bool, const char*> needed[] = {
      {!spec.interrupts.empty(), "interrupt"},
      {!spec.character.parts.empty(), "swap"},
      {!spec.character.attachments.empty(), "attachment"},
      {!std::holds_alternative<PlaneGround>(spec.environment.ground), "ground"},
      {!spec.environment.obstacles.empty(), "obstacle"},
      {!spec.dynamics.loads.empty(), "load"},
      {!spec.dynamics.impacts.empty(), "impact"},
  };
  for (const auto& [is_needed, name] : needed)
    if (is_needed) text += std::string(" ") + name;
  if (spec.dynamics.mode != Mode::kinematic)
    text += " " + std::string(mode_names()[static_cast<std::size_t>(spec.dynamics.mode)]);
  return text;
}

std::string bucket_id(const std::string& family, const std::string& features) {
  return content_id(family + "\n" + features).substr(0, 12);
}

bool cheaper(const Spec& a, const Spec& b) {
  const auto cost = [](const Spec& spec, const std::string& text) {
    return std::make_tuple(count_actions(spec), text.size(), text);
  };
  return cost(a, print_spec(a)) < cost(b, print_spec(b));
}

std::string_view state_name(BucketState state) { return kStateNames[static_cast<std::size_t>(state)]; }

Bucket bucket_of(const Case& minimal) {
  Bucket bucket;
  bucket.check = minimal.expect.check;
  bucket.family = family_of(minimal);
  bucket.features = features_of(minimal.spec);
  bucket.id = bucket_id(bucket.family, bucket.features);
  bucket.signature = kSignatureVersion;
  return bucket;
}

std::string folder_name(const Bucket& bucket) { return bucket.check + "-" + bucket.id; }

std::string case_file_name(std::string_view role, const Spec& spec) {
  return std::string(role) + "-" + spec_id(spec).substr(0, 16) + ".json";
}

Result<Bucket> read_bucket(const std::string& folder) {
  const std::string path = folder + "/bucket.json";
  const Result<std::string> text = read_file(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<Bucket> bucket = json_fields::read_document<Bucket>(*text, "bucket");
  if (bucket) return bucket;
  return Issue{bucket.issue().code, bucket.issue().pointer, path + ": " + bucket.issue().text};
}

Result<Done> write_bucket(const std::string& folder, const Bucket& bucket) {
  const std::string text = print_bucket(bucket);
  // What nobody can read again would be lost: a name of 300 letters, say.
  if (const Result<Bucket> again = json_fields::read_document<Bucket>(text, "bucket"); !again) return again.issue();
  return write_file(folder + "/bucket.json", text);
}

std::string print_bucket(const Bucket& bucket) { return json_fields::write_pretty(bucket); }
std::string bucket_schema() { return json_fields::write_schema<Bucket>("Contort bucket"); }

}  // namespace contort
