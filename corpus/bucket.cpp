#include "corpus/bucket.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include "corpus/family_fields.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;
using json_fields::Rule;
using json_fields::Text;

constexpr std::string_view kStateNames[] = {"new", "open", "fixed", "regressed", "flaky", "quarantined", "invalid"};

constexpr std::size_t kIdDigits = 12;
constexpr std::string_view kNames[] = {"/id", "/min", "/worst", "/orig"};  // fields that become parts of paths

const Rule kId{.text = Text::hex, .digits = kIdDigits, .required = true};
// The names of the roles differ, so that removing an original never removes the minimal case or bucket.json.
Rule case_of(std::string_view begins) {
  return {.text = Text::file, .begins = begins, .ends = ".json", .may_be_empty = true};
}
const Rule kLabel{.text = Text::label, .may_be_empty = true};
const Rule kProse{.text = Text::prose};
const Rule kCount{.low = 0, .high = 1e9};

// Returns the number of actions in the queue and in interrupts.
int count_actions(const Spec& spec) {
  int count = 0;
  const auto add = [&](const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips) count += static_cast<int>(clip.actions.size());
  };
  for (const SequenceDesc& sequence : spec.sequences) add(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) add(interrupt.sequence);
  return count;
}

int count_clips(const Spec& spec) {
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences) count += static_cast<int>(sequence.clips.size());
  return count;
}

std::string up_to_three(int count) { return count < 3 ? std::to_string(count) : "3+"; }

// The names of all actions in the queue and in its interrupts, sorted.
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
  v.field("id", &Bucket::id, kId, "Hash of family and features.");
  v.field("check", &Bucket::check, {.required = true}, "The check that fails.");
  v.field("family", &Bucket::family, {.text = Text::prose, .required = true},
          "Identity of the failure, without numbers.");
  v.field("features", &Bucket::features, kProse, "Features that the minimal spec needs.");
  v.field("signature", &Bucket::signature, {.low = 1, .high = 1e6},
          "Version of the rules by which the id was computed.");
  v.field("state", &Bucket::state, {.names = kStateNames, .required = true}, "State of the failure.");
  v.field("was", &Bucket::was, {.names = kStateNames}, "State before the failure became flaky or invalid.");
  v.field("owner", &Bucket::owner, kLabel, "Person who is responsible for the failure.");
  v.field("ticket", &Bucket::ticket, kLabel, "Ticket or address of the ticket.");
  v.field("reason", &Bucket::reason, kProse, "Reason for the quarantine.");
  v.field("expires", &Bucket::expires, kLabel, "Last day of the quarantine, YYYY-MM-DD.");
  v.field("note", &Bucket::note, {.text = Text::prose, .may_be_empty = true}, "Note for people.");
  v.field("passed_in", &Bucket::passed_in, {.max_count = 2, .text = Text::label},
          "Builds that have passed since the last failure.");
  v.field("streak", &Bucket::streak, kCount,
          "Number of replays in a row that passed (quarantined) or gave equal results (flaky).");
  v.field("changes", &Bucket::changes, kCount, "Number of changes of the state and of its fields.");
  v.field("runs", &Bucket::runs, {.max_count = 100000}, "Runs that put a case here.");
  v.field("min", &Bucket::min, case_of("min-"), "File of the smallest case.");
  v.field("worst", &Bucket::worst, case_of("worst-"), "File of the deepest case.");
  v.field("orig", &Bucket::orig, case_of("orig-"), "File of the case that min was shrunk from.");
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

std::string bucket_id(const Family& family, const std::string& features) {
  return content_id(print_family(family) + "\n" + features).substr(0, kIdDigits);
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

namespace {

bool is_bad_name(const Issue& issue) {
  return issue.code == "bucket.bad_text" && std::ranges::count(kNames, issue.pointer) > 0;
}

Result<std::string> read_text(const std::string& folder) {
  return read_inside(folder, "bucket.json", json_fields::kMaxDocumentBytes);
}

Issue in_file(const std::string& path, Issue issue) {
  const bool is_bad = is_bad_name(issue);
  issue.text = path + ": " + issue.text;
  if (is_bad) issue.text += "; contort corpus fsck --repair mends it from the cases that are in the folder";
  if (is_bad) issue.code = "bucket.bad_name";
  return issue;
}

}  // namespace

Result<Bucket> read_bucket(const std::string& folder) {
  const Result<std::string> text = read_text(folder);
  if (!text) return text.issue();
  Result<Bucket> bucket = json_fields::read_document<Bucket>(*text, "bucket");
  if (bucket) return bucket;
  return in_file(folder + "/bucket.json", bucket.issue());
}

Result<Bucket> read_own_bucket(const std::string& folder) {
  Result<Bucket> bucket = read_bucket(folder);
  if (!bucket) return bucket;
  if (const std::string own = folder_name(*bucket); std::filesystem::path(folder).filename() != own)
    return Issue{"bucket.wrong_folder", "",
                 folder + " holds the bucket " + own + ", whose folder has that name; contort corpus fsck --repair " +
                     "moves it there, or aside where there is one"};
  for (const std::string& file : {bucket->min, bucket->worst, bucket->orig})
    if (const Result<Done> inside = check_inside(folder, folder + "/" + file); !inside) return inside.issue();
  return bucket;
}

Result<Bucket> read_bucket_without_bad_names(const std::string& folder) {
  const Result<std::string> text = read_text(folder);
  if (!text) return text.issue();
  Result<Json> tree = json_fields::parse_document(*text);
  if (!tree) return tree.issue();
  Json left = *tree;
  const std::string no_id(kIdDigits, '0');  // stands for a missing id, because the field is required
  for (;;) {
    Result<Bucket> read = json_fields::read_document<Bucket>(left.dump(), "bucket");
    if (!read && !is_bad_name(read.issue())) return read;
    if (!read) {
      const std::string field = read.issue().pointer.substr(1);
      field == "id" ? static_cast<void>(left[field] = no_id) : static_cast<void>(left.erase(field));
      continue;
    }
    Bucket bucket = std::move(read).value();
    if (bucket.id == no_id) bucket.id.clear();
    return bucket;
  }
}

bool is_untrusted(const Issue& issue) {
  return is_outside(issue) || issue.code == "bucket.bad_name" || issue.code == "bucket.wrong_folder";
}

Result<Done> write_bucket(const std::string& folder, const Bucket& bucket) {
  const std::string text = print_bucket(bucket);
  // Reads the text back first: a bucket that cannot be read again, such as one with a name of 300 letters, would be
  // lost.
  if (const Result<Bucket> again = json_fields::read_document<Bucket>(text, "bucket"); !again) return again.issue();
  return write_inside(folder, "bucket.json", text);
}

std::string print_bucket(const Bucket& bucket) { return json_fields::write_pretty(bucket); }
std::string bucket_schema() { return json_fields::write_schema<Bucket>("Contort bucket"); }

}  // namespace contort
