#include "server/triage.h"

#include <algorithm>
#include <filesystem>

#include "corpus/bucket_files.h"
#include "corpus/lifecycle.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "process/program.h"

namespace contort::server {

namespace fs = std::filesystem;
using json_fields::Json;

namespace {

constexpr double kReplay_s = 120.0, kShrink_s = 120.0, kReport_s = 3600.0;
constexpr const char* kRun = "serve";  // name of the run for cases from sessions

Json bucket_json(const Bucket& bucket, const std::string& today) {
  Json json = *json_fields::parse_document(print_bucket(bucket));
  json.erase("format");
  json["bucket"] = folder_name(bucket);
  json["gating"] = is_gating(bucket, today);
  return json;
}

// The last line that is not empty.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \n");
  if (end == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1,
                     end + 1 - (begin == std::string::npos ? 0 : begin + 1));
}

Issue failed(const ProgramResult& ran) {
  if (ran.killed) return {"job.too_long", "", "it took too long, or the server ends"};
  const std::string why = last_line(ran.err);
  return {"job.failed", "", why.empty() ? "it ended with code " + std::to_string(ran.code) : why};
}

Result<ProgramResult> run_job(const std::vector<std::string>& command, double seconds, Jobs::Running& running) {
  Result<ProgramResult> ran = run_program(command, seconds, running.stop);
  if (ran) running.cpu_s += ran->cpu_s;
  return ran;
}

bool is_raw(const Bucket& bucket) {
  return bucket.runs == std::vector<std::string>{kRun} && bucket.state == BucketState::fresh &&
         bucket.min.substr(bucket.min.find('-') + 1) == bucket.orig.substr(bucket.orig.find('-') + 1);
}

}  // namespace

Result<Bucket> Triage::find(const Corpus& corpus, const std::string& name) const {
  std::vector<Issue> damaged;
  for (Bucket& bucket : corpus.buckets(damaged))
    if (folder_name(bucket) == name) return std::move(bucket);
  return Issue{"corpus.no_bucket", "", "there is no such bucket"};
}

Result<std::string> Triage::list(const std::string& today) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  std::vector<Issue> damaged;
  Json buckets = Json::array(), issues = Json::array();
  for (const Bucket& bucket : corpus->buckets(damaged)) buckets.push_back(bucket_json(bucket, today));
  for (const Issue& issue : damaged) issues.push_back(to_line(issue));
  return json_fields::compact_text({{"buckets", buckets}, {"damaged", issues}, {"revision", revision()}});
}

Result<std::string> Triage::show(const std::string& name, const std::string& today) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  const Result<Bucket> bucket = find(*corpus, name);
  if (!bucket) return bucket.issue();
  Json json = bucket_json(*bucket, today);
  json["cases"] = Json::object();
  for (const std::string& file : files_of(*bucket)) {
    const Result<std::string> text = read_inside(corpus->folder_of(*bucket), file, json_fields::kMaxDocumentBytes);
    const Result<Json> stored = text ? json_fields::parse_document(*text) : Result<Json>(text.issue());
    if (stored) json["cases"][file.substr(0, file.find('-'))] = *stored;
  }
  return json_fields::compact_text(json);
}

Result<std::string> Triage::change(const std::string& name, const Corpus::Change& change,
                                   const std::string& today) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  const Result<Bucket> bucket = find(*corpus, name);
  if (!bucket) return bucket.issue();
  const Result<Bucket> next = corpus->change(*bucket, change);
  if (!next) return next.issue();
  return json_fields::compact_text(bucket_json(*next, today));
}

Result<std::string> Triage::keep(const Case& shown) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  const Result<Corpus::Added> added = corpus->add({shown, shown, kRun});
  if (!added) return added.issue();
  return json_fields::compact_text(
      {{"bucket", fs::path(added->bucket).filename().string()}, {"is_new", added->is_new}});
}

Result<Jobs::Work> Triage::replay_work(const std::string& name) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  const Result<Bucket> bucket = find(*corpus, name);
  if (!bucket) return bucket.issue();
  std::vector<std::string> command = program_;
  command.insert(command.end(), {"replay", "--json"});
  for (const std::string& file : files_of(*bucket)) command.push_back(corpus->folder_of(*bucket) + "/" + file);
  return Jobs::Work([command](Jobs::Running& running) -> Result<Jobs::Outcome> {
    const Result<ProgramResult> ran = run_job(command, kReplay_s, running);
    if (!ran) return ran.issue();
    const Result<Json> json = json_fields::parse_document(ran->out);
    if (ran->killed || !json) return failed(*ran);
    return Jobs::Outcome{ran->code == 1 ? "it still fails" : "it was replayed", ran->out};
  });
}

Result<Jobs::Work> Triage::shrink_work(const std::string& name) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  if (const Result<Bucket> bucket = find(*corpus, name); !bucket) return bucket.issue();
  return Jobs::Work([this, name](Jobs::Running& running) { return shrink(name, running); });
}

Result<Jobs::Outcome> Triage::shrink(const std::string& name, Jobs::Running& running) const {
  const Result<Corpus> corpus = Corpus::open(folder_);
  if (!corpus) return corpus.issue();
  const Result<Bucket> bucket = find(*corpus, name);
  if (!bucket) return bucket.issue();
  const std::string& file = bucket->orig.empty() ? bucket->min : bucket->orig;
  const std::string input = corpus->folder_of(*bucket) + "/" + file;
  const Result<Case> original = read_case_of(corpus->folder_of(*bucket), file);
  if (!original) return original.issue();
  if (const Result<Done> made = make_folder(scratch_); !made) return made.issue();
  const std::string output = scratch_ + "/shrink-" + bucket->id + ".json";
  std::vector<std::string> command = program_;
  command.insert(command.end(), {"shrink", input, "-o", output, "--json"});
  const Result<ProgramResult> ran = run_job(command, kShrink_s, running);
  const Result<Case> minimal = ran && ran->code == 0 ? read_case(output) : Result<Case>(Issue{});
  std::error_code error;
  fs::remove(output, error);
  if (!ran) return ran.issue();
  if (!minimal) return failed(*ran);
  return store(*corpus, *bucket, *original, *minimal);
}

Result<Jobs::Outcome> Triage::store(const Corpus& corpus, const Bucket& from, const Case& original,
                                    const Case& minimal) const {
  const Result<Corpus::Added> added = corpus.add({minimal, original, kRun});
  if (!added) return added.issue();
  const std::string into = fs::path(added->bucket).filename().string();
  if (into != folder_name(from) && is_raw(from))
    if (const Result<Done> removed = corpus.remove(from); !removed) return removed.issue();
  const std::size_t before = print_spec(original.spec).size(), after = print_spec(minimal.spec).size();
  return Jobs::Outcome{"shrunk from " + std::to_string(before) + " to " + std::to_string(after) + " bytes of spec",
                       json_fields::compact_text(
                           {{"bucket", into}, {"is_new", added->is_new}, {"bytes_before", before}, {"bytes", after}})};
}

Jobs::Work Triage::report_work(const std::string& into) const {
  std::vector<std::string> command = program_;
  command.insert(command.end(), {"report", folder_, "-o", into});
  return [command](Jobs::Running& running) -> Result<Jobs::Outcome> {
    const Result<ProgramResult> ran = run_job(command, kReport_s, running);
    if (!ran) return ran.issue();
    if (ran->killed || ran->code != 0) return failed(*ran);
    return Jobs::Outcome{last_line(ran->out), ""};
  };
}

std::string Triage::revision() const {
  std::string all;
  std::error_code error;
  std::vector<std::string> lines;
  for (const auto& entry : fs::directory_iterator(folder_ + "/buckets", error)) {
    const fs::path file = entry.path() / "bucket.json";
    const auto time = fs::last_write_time(file, error);
    if (error) continue;
    lines.push_back(entry.path().filename().string() + " " + std::to_string(time.time_since_epoch().count()));
  }
  std::ranges::sort(lines);
  for (const std::string& line : lines) all += line + "\n";
  return content_id(all).substr(0, 16);
}

}  // namespace contort::server
