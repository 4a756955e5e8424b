#include "corpus/corpus.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "corpus/bucket_files.h"
#include "corpus/lifecycle.h"
#include "corpus/lock.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "model/core/own_folder.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

Result<Case> case_in(const Result<std::string>& text, const std::string& path) {
  if (!text) return text.issue();
  Result<Case> stored = parse_case(*text);
  if (stored) return stored;
  Issue issue = stored.issue();
  issue.text = path + ": " + issue.text;
  return issue;
}

// A corpus from somebody else may contain links that lead to other folders.
Result<Done> check_own_folders(const std::string& folder) {
  for (const char* own : {"/buckets", "/leads", "/runs", "/invalid", "/.lock"})
    if (const Result<Done> inside = check_inside(folder, folder + own); !inside) return inside;
  return Done{};
}

}  // namespace

Result<Case> read_case(const std::string& path) {
  return case_in(read_file(path, json_fields::kMaxDocumentBytes), path);
}

Result<Case> read_case_of(const std::string& folder, const std::string& file) {
  return case_in(read_inside(folder, file, json_fields::kMaxDocumentBytes), folder + "/" + file);
}

Result<Corpus> Corpus::create(const std::string& folder) {
  std::error_code ignored;
  const bool is_corpus = fs::is_directory(folder + "/buckets", ignored);
  if (const Result<Done> own = check_own_folder(folder, is_corpus, "a corpus"); !own) return own.issue();
  if (const Result<Done> own = check_own_folders(folder); !own) return own.issue();
  for (const char* sub : {"/buckets", "/leads", "/runs"})
    if (const Result<Done> made = make_folder(folder + sub); !made) return made.issue();
  // Reports a read-only folder now, not after an hour of fuzzing. It does so without a test file, which a kill would
  // leave behind.
  if (::access((folder + "/leads").c_str(), W_OK | X_OK) != 0)
    return Issue{"file.unwritable", "", "cannot write into " + folder + "/leads: " + std::strerror(errno)};
  // Makes the lock file here, so that folders do not differ by whether the corpus was locked before.
  if (const Result<CorpusLock> lock = CorpusLock::take(folder); !lock) return lock.issue();
  return Corpus(folder);
}

Result<Corpus> Corpus::open(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder + "/buckets", error))
    return Issue{"corpus.not_found", "",
                 (fs::exists(folder, error) ? folder + " holds no corpus, because it has no folder \"buckets\""
                                            : "there is no corpus " + folder + ", because there is no such folder") +
                     ": check the path; contort fuzz --corpus DIR makes a corpus, and with --cases 0 an empty one"};
  if (const Result<Done> own = check_own_folders(folder); !own) return own.issue();
  return Corpus(folder);
}

std::string Corpus::folder_of(const Bucket& bucket) const { return folder_ + "/buckets/" + folder_name(bucket); }

Result<std::string> Corpus::place_of(const Bucket& bucket) const {
  const std::string folder = folder_of(bucket);
  if (const Result<Done> inside = check_inside(folder_, folder); !inside) return inside.issue();
  return folder;
}

namespace {

// A failure that was found again counts as a failed replay. A flaky bucket stays as it is: only replays count its
// steady results.
Bucket found_again(const Bucket& bucket) {
  return bucket.state == BucketState::flaky ? bucket : next_state(bucket, {Shown::fails, ""}, "");
}

void note_run(Bucket& bucket, const std::string& run) {
  const auto at = std::ranges::lower_bound(bucket.runs, run);
  if (at == bucket.runs.end() || *at != run) bucket.runs.insert(at, run);
}

Result<Done> put_into(const std::string& folder, const Found& found, Bucket bucket) {
  if (const Result<Done> made = make_folder(folder); !made) return made;
  BucketFiles files(folder);
  if (const auto kept = files.put_pair(found.minimal, &found.original, bucket); !kept) return kept;
  for (const Case* shown : {&found.original, &found.minimal})
    if (const auto kept = files.put_worst(*shown, bucket); !kept) return kept;
  if (found.worst)
    if (const auto kept = files.put_worst(*found.worst, bucket); !kept) return kept;
  note_run(bucket, found.run);
  return files.commit(bucket);
}

}  // namespace

Result<Corpus::Added> Corpus::add(const Found& found) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  Bucket bucket = bucket_of(found.minimal);
  const Result<std::string> place = place_of(bucket);
  if (!place) return place.issue();
  const std::string& folder = *place;
  Added added{folder, true};
  if (std::error_code ignored; fs::exists(fs::symlink_status(folder + "/bucket.json", ignored))) {
    const Result<Bucket> present = read_own_bucket(folder);
    if (!present) return present.issue();  // overwriting it would lose its state, so a person must decide
    bucket = found_again(*present);
    added.is_new = false;
  }
  std::error_code error;
  const bool was_there = fs::exists(folder, error);
  if (const Result<Done> kept = put_into(folder, found, bucket); !kept) {
    // A folder without bucket.json would be reported as damage, so a new folder is removed if writing failed.
    if (!was_there) fs::remove_all(folder, error);
    return kept.issue();
  }
  return added;
}

Result<Done> Corpus::take(const Corpus& from, const Bucket& bucket) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  for (const Corpus* corpus : {&from, this})
    if (const Result<std::string> place = corpus->place_of(bucket); !place) return place.issue();
  return merge_bucket(from.folder_of(bucket), bucket, folder_of(bucket));
}

Result<Bucket> Corpus::change(const Bucket& bucket, const Change& change) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  const Result<std::string> folder = place_of(bucket);
  if (!folder) return folder.issue();
  const Result<Bucket> present = read_own_bucket(*folder);
  if (!present) return present;
  const Result<Bucket> next = change(*present);
  if (!next || *next == *present) return next;
  if (const Result<Done> written = write_bucket(*folder, *next); !written) return written.issue();
  return next;
}

Result<Done> Corpus::remove(const Bucket& bucket) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  const Result<std::string> folder = place_of(bucket);
  if (!folder) return folder.issue();
  std::error_code error;
  fs::remove_all(*folder, error);
  if (error) return Issue{"file.unwritable", "", "cannot remove " + *folder + ": " + error.message()};
  return Done{};
}

std::vector<Bucket> Corpus::buckets_under_lock(std::vector<Issue>& damaged) const {
  std::vector<std::string> folders;
  std::error_code error, ignored;
  for (const auto& entry : fs::directory_iterator(folder_ + "/buckets", error))
    if (entry.is_directory(ignored)) folders.push_back(entry.path().string());
  if (error) damaged.push_back({"corpus.unreadable", "", folder_ + "/buckets: " + error.message()});
  std::sort(folders.begin(), folders.end());
  std::vector<Bucket> all;
  for (const std::string& folder : folders) {
    const Result<Done> inside = check_inside(folder_, folder);
    Result<Bucket> bucket = inside ? read_own_bucket(folder) : Result<Bucket>(inside.issue());
    if (bucket)
      all.push_back(std::move(bucket).value());
    else
      damaged.push_back(bucket.issue());
  }
  return all;
}

// Reads without the lock first. Only if something seems damaged, such as a folder that is just being made, it waits for
// writers and reads again.
std::vector<Bucket> Corpus::buckets(std::vector<Issue>& damaged) const {
  std::vector<Issue> at_first;
  std::vector<Bucket> all = buckets_under_lock(at_first);
  if (at_first.empty()) return all;
  const Result<CorpusLock> lock = CorpusLock::share(folder_);
  return buckets_under_lock(damaged);
}

namespace {

std::vector<Corpus::Stored> read_all(const std::string& folder, const std::vector<std::string>& files) {
  std::vector<Corpus::Stored> all;
  for (const std::string& file : files) all.push_back({folder + "/" + file, read_case_of(folder, file)});
  return all;
}

bool are_readable(const std::vector<Corpus::Stored>& all) {
  return std::ranges::all_of(all, [](const Corpus::Stored& one) { return one.stored.ok(); });
}

}  // namespace

std::vector<Corpus::Stored> Corpus::cases_of(Bucket& bucket) const {
  std::vector<Stored> all = read_all(folder_of(bucket), files_of(bucket));
  if (are_readable(all)) return all;
  const Result<CorpusLock> lock = CorpusLock::share(folder_);
  if (const Result<Bucket> present = read_own_bucket(folder_of(bucket))) bucket = *present;
  return read_all(folder_of(bucket), files_of(bucket));
}

Result<Case> Corpus::minimal_of(Bucket& bucket) const {
  Result<Case> minimal = read_case_of(folder_of(bucket), bucket.min);
  if (minimal) return minimal;
  const Result<CorpusLock> lock = CorpusLock::share(folder_);
  if (const Result<Bucket> present = read_own_bucket(folder_of(bucket))) bucket = *present;
  return read_case_of(folder_of(bucket), bucket.min);
}

}  // namespace contort
