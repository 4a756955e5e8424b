#include "corpus/corpus.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <tuple>

#include "generator/core/files.h"
#include "generator/core/hash.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

const json_fields::Rule kNeeded{.text = json_fields::Text::label, .required = true};
const json_fields::Rule kLabel{.text = json_fields::Text::label, .may_be_empty = true};
const json_fields::Rule kProse{.text = json_fields::Text::prose};
constexpr std::string_view kStates[] = {"new", "open", "fixed", "regressed", "flaky", "quarantined"};

std::string short_id(const Spec& spec) { return spec_id(spec).substr(0, 16); }

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

std::string file_name(const std::string& role, const Case& stored) {
  return role + "-" + short_id(stored.spec) + ".json";
}

}  // namespace

template <class V>
void fields(V& v, const Bucket*) {
  v.constant("format", "contort.bucket/1");
  v.field("id", &Bucket::id, kNeeded, "Hash of family and features.");
  v.field("check", &Bucket::check, {.required = true}, "The check that fails.");
  v.field("family", &Bucket::family, {.text = json_fields::Text::prose, .required = true},
          "Identity of the failure, without numbers.");
  v.field("features", &Bucket::features, kProse, "What the minimal spec needed.");
  v.field("state", &Bucket::state, {.required = true}, "new, open, fixed, regressed, flaky or quarantined.");
  v.field("runs", &Bucket::runs, {.max_count = 100000}, "Runs that put a case here.");
  v.field("min", &Bucket::min, kLabel, "File of the smallest case.");
  v.field("worst", &Bucket::worst, kLabel, "File of the deepest case.");
  v.field("orig", &Bucket::orig, kLabel, "File of the case that min was shrunk from.");
}

std::string features_of(const Spec& spec) {
  std::set<std::string> actions;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions) actions.insert(use.action);
  std::string text = "actions=";
  for (const std::string& action : actions) text += (text.back() == '=' ? "" : ",") + action;
  text += " clips=" + up_to_three(count_clips(spec));
  text += " sequences=" + up_to_three(static_cast<int>(spec.sequences.size()));
  if (!spec.character.parts.empty()) text += " swap";
  if (!spec.character.attachments.empty()) text += " attachment";
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

Result<Case> read_case(const std::string& path) {
  const Result<std::string> text = read_file(path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<Case> stored = parse_case(*text);
  if (stored) return stored;
  Issue issue = stored.issue();
  issue.text = path + ": " + issue.text;
  return issue;
}

Result<Corpus> Corpus::create(const std::string& folder) {
  for (const char* sub : {"/buckets", "/leads", "/runs"})
    if (const Result<Done> made = make_folder(folder + sub); !made) return made.issue();
  // A folder that exists may still be read-only: find out now, not after an hour of fuzzing.
  const std::string probe = folder + "/leads/.probe";
  if (const Result<Done> written = write_file(probe, ""); !written) return written.issue();
  std::error_code ignored;
  fs::remove(probe, ignored);
  return Corpus(folder);
}

Result<Corpus> Corpus::open(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder + "/buckets", error))
    return Issue{"corpus.not_found", "", folder + " holds no corpus (no folder \"buckets\")"};
  return Corpus(folder);
}

std::string Corpus::folder_of(const Bucket& bucket) const {
  return folder_ + "/buckets/" + bucket.check + "-" + bucket.id;
}

namespace {

Result<Bucket> read_bucket(const std::string& folder) {
  const Result<std::string> text = read_file(folder + "/bucket.json", json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<Bucket> bucket = json_fields::read_document<Bucket>(*text, "bucket");
  if (!bucket) {
    Issue issue = bucket.issue();
    issue.text = folder + "/bucket.json: " + issue.text;
    return issue;
  }
  if (std::find(std::begin(kStates), std::end(kStates), bucket->state) == std::end(kStates))
    return Issue{"bucket.unknown_state", "/state", folder + "/bucket.json: \"" + bucket->state + "\" is no state"};
  return bucket;
}

// The cheaper spec comes first. Equal specs that were found in different places differ in their provenance: then the
// text decides, so that no order of adding does.
bool before(const Case& a, const Case& b) {
  return a.spec != b.spec ? cheaper(a.spec, b.spec) : print_case(a) < print_case(b);
}

double depth_of(const Case& stored) {
  return std::isnan(stored.expect.worst_margin) ? std::numeric_limits<double>::infinity() : stored.expect.depth;
}

bool deeper(const Case& a, const Case& b) {
  return depth_of(a) != depth_of(b) ? depth_of(a) > depth_of(b) : before(a, b);
}

// A minimal case and the one that it was shrunk from stay together.
struct Pair {
  const Case& minimal;
  const Case& original;
};
bool before(const Pair& a, const Pair& b) {
  if (a.minimal.spec != b.minimal.spec) return cheaper(a.minimal.spec, b.minimal.spec);
  if (print_case(a.original) != print_case(b.original)) return before(a.original, b.original);
  return before(a.minimal, b.minimal);
}

// The case files of a bucket. What is replaced stays until bucket.json names the new ones.
class BucketFiles {
 public:
  explicit BucketFiles(std::string folder) : folder_(std::move(folder)) {}

  Result<Done> put_pair(const Pair& next, Bucket& bucket) {
    const Result<Case> minimal = read_case(folder_ + "/" + bucket.min);
    const Result<Case> original = read_case(folder_ + "/" + bucket.orig);
    if (minimal && original && !before(next, {*minimal, *original})) return Done{};
    if (const Result<Done> done = put("min", next.minimal, bucket.min); !done) return done;
    return put("orig", next.original, bucket.orig);
  }

  Result<Done> put_worst(const Case& next, Bucket& bucket) {
    const Result<Case> worst = read_case(folder_ + "/" + bucket.worst);
    if (worst && !deeper(next, *worst)) return Done{};
    return put("worst", next, bucket.worst);
  }

  void remove_replaced() const {
    std::error_code ignored;
    for (const std::string& path : replaced_) fs::remove(path, ignored);
  }

 private:
  Result<Done> put(const std::string& role, const Case& next, std::string& current) {
    const std::string name = file_name(role, next);
    if (const Result<Done> written = write_file(folder_ + "/" + name, print_case(next)); !written) return written;
    if (!current.empty() && current != name) replaced_.push_back(folder_ + "/" + current);
    current = name;
    return Done{};
  }

  std::string folder_;
  std::vector<std::string> replaced_;
};

}  // namespace

Result<Corpus::Added> Corpus::add(const Found& found) const {
  Bucket bucket;
  bucket.check = found.minimal.expect.check;
  bucket.family = family_of(found.minimal);
  bucket.features = features_of(found.minimal.spec);
  bucket.id = bucket_id(bucket.family, bucket.features);
  const std::string folder = folder_of(bucket);
  Added added{folder, true};
  if (std::error_code error; fs::exists(folder + "/bucket.json", error)) {
    Result<Bucket> present = read_bucket(folder);
    if (!present) return present.issue();  // a person has to look: overwriting it would lose its state
    bucket = std::move(present).value();
    added.is_new = false;
  }
  if (const Result<Done> made = make_folder(folder); !made) return made.issue();
  BucketFiles files(folder);
  if (const auto kept = files.put_pair({found.minimal, found.original}, bucket); !kept) return kept.issue();
  for (const Case* shown : {&found.original, &found.minimal})
    if (const auto kept = files.put_worst(*shown, bucket); !kept) return kept.issue();
  if (found.worst)
    if (const auto kept = files.put_worst(*found.worst, bucket); !kept) return kept.issue();
  if (const auto at = std::ranges::lower_bound(bucket.runs, found.run); at == bucket.runs.end() || *at != found.run)
    bucket.runs.insert(at, found.run);
  if (const auto written = write_file(folder + "/bucket.json", json_fields::write_pretty(bucket)); !written)
    return written.issue();
  files.remove_replaced();
  return added;
}

std::vector<Bucket> Corpus::buckets(std::vector<Issue>& damaged) const {
  std::vector<std::string> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_ + "/buckets", error))
    if (entry.is_directory()) folders.push_back(entry.path().string());
  if (error) damaged.push_back({"corpus.unreadable", "", folder_ + "/buckets: " + error.message()});
  std::sort(folders.begin(), folders.end());
  std::vector<Bucket> all;
  for (const std::string& folder : folders) {
    Result<Bucket> bucket = read_bucket(folder);
    if (bucket)
      all.push_back(std::move(bucket).value());
    else
      damaged.push_back(bucket.issue());
  }
  return all;
}

}  // namespace contort
