#include "corpus/corpus.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "corpus/bucket_files.h"
#include "corpus/lifecycle.h"
#include "corpus/lock.h"
#include "generator/core/files.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace fs = std::filesystem;

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
  // A folder that exists may still be read-only: find out now, not after an hour of fuzzing. Without a file, which a kill
  // would leave behind.
  if (::access((folder + "/leads").c_str(), W_OK | X_OK) != 0)
    return Issue{"file.unwritable", "", "cannot write into " + folder + "/leads: " + std::strerror(errno)};
  // Made here, so that whether a corpus was locked yet makes no difference.
  if (const Result<CorpusLock> lock = CorpusLock::take(folder); !lock) return lock.issue();
  return Corpus(folder);
}

Result<Corpus> Corpus::open(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder + "/buckets", error))
    return Issue{"corpus.not_found", "", folder + " holds no corpus (no folder \"buckets\")"};
  return Corpus(folder);
}

std::string Corpus::folder_of(const Bucket& bucket) const { return folder_ + "/buckets/" + folder_name(bucket); }

namespace {

// Being found again is being seen to fail. Only replays count the steady ones of what is flaky.
Bucket found_again(const Bucket& bucket) {
  return bucket.state == BucketState::flaky ? bucket : next_state(bucket, {Shown::fails, ""}, "");
}

void note_run(Bucket& bucket, const std::string& run) {
  const auto at = std::ranges::lower_bound(bucket.runs, run);
  if (at == bucket.runs.end() || *at != run) bucket.runs.insert(at, run);
}

}  // namespace

Result<Corpus::Added> Corpus::add(const Found& found) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  Bucket bucket = bucket_of(found.minimal);
  const std::string folder = folder_of(bucket);
  Added added{folder, true};
  if (std::error_code error; fs::exists(folder + "/bucket.json", error)) {
    const Result<Bucket> present = read_bucket(folder);
    if (!present) return present.issue();  // a person has to look: overwriting it would lose its state
    bucket = found_again(*present);
    added.is_new = false;
  }
  if (const Result<Done> made = make_folder(folder); !made) return made.issue();
  BucketFiles files(folder);
  if (const auto kept = files.put_pair(found.minimal, &found.original, bucket); !kept) return kept.issue();
  for (const Case* shown : {&found.original, &found.minimal})
    if (const auto kept = files.put_worst(*shown, bucket); !kept) return kept.issue();
  if (found.worst)
    if (const auto kept = files.put_worst(*found.worst, bucket); !kept) return kept.issue();
  note_run(bucket, found.run);
  if (const auto written = files.commit(bucket); !written) return written.issue();
  return added;
}

Result<Done> Corpus::take(const Corpus& from, const Bucket& bucket) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  return merge_bucket(from.folder_of(bucket), bucket, folder_of(bucket));
}

Result<Bucket> Corpus::change(const Bucket& bucket, const Change& change) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  const std::string folder = folder_of(bucket);
  const Result<Bucket> present = read_bucket(folder);
  if (!present) return present;
  const Result<Bucket> next = change(*present);
  if (!next || *next == *present) return next;
  if (const Result<Done> written = write_bucket(folder, *next); !written) return written.issue();
  return next;
}

Result<Done> Corpus::remove(const Bucket& bucket) const {
  const Result<CorpusLock> lock = CorpusLock::take(folder_);
  if (!lock) return lock.issue();
  std::error_code error;
  fs::remove_all(folder_of(bucket), error);
  if (error) return Issue{"file.unwritable", "", "cannot remove " + folder_of(bucket) + ": " + error.message()};
  return Done{};
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
