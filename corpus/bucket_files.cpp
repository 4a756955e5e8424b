#include "corpus/bucket_files.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "corpus/corpus.h"
#include "corpus/lifecycle.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

// The cheaper spec comes first. Equal specs from different places differ in their provenance; then the text decides, so
// that the order of adding does not matter.
bool before(const Case& a, const Case& b) {
  return a.spec != b.spec ? cheaper(a.spec, b.spec) : print_case(a) < print_case(b);
}

bool deeper(const Case& a, const Case& b) {
  const double depth_of_a = depth_of(a.expect), depth_of_b = depth_of(b.expect);
  return depth_of_a != depth_of_b ? depth_of_a > depth_of_b : before(a, b);
}

// A minimal case, and the case that it was shrunk from, if there is one.
struct Pair {
  const Case* minimal = nullptr;
  const Case* original = nullptr;
};
bool before(const Pair& a, const Pair& b) {
  if (a.minimal->spec != b.minimal->spec) return cheaper(a.minimal->spec, b.minimal->spec);
  if (a.original == nullptr || b.original == nullptr) {
    if (a.original != b.original) return a.original != nullptr;
  } else if (print_case(*a.original) != print_case(*b.original)) {
    return before(*a.original, *b.original);
  }
  return before(*a.minimal, *b.minimal);
}

}  // namespace

Result<Done> BucketFiles::put_pair(const Case& minimal, const Case* original, Bucket& bucket) {
  const Result<Case> present = read_case_of(folder_, bucket.min);
  const Result<Case> present_original = read_case_of(folder_, bucket.orig);
  const bool whole = present && (present_original || bucket.orig.empty());
  if (whole && !before({&minimal, original}, {&*present, present_original ? &*present_original : nullptr}))
    return Done{};
  if (const Result<Done> done = put("min", minimal, bucket.min); !done) return done;
  if (original != nullptr) return put("orig", *original, bucket.orig);
  if (!bucket.orig.empty()) replaced_.push_back(folder_ + "/" + bucket.orig);
  bucket.orig.clear();
  return Done{};
}

Result<Done> BucketFiles::put_worst(const Case& shown, Bucket& bucket) {
  const Result<Case> worst = read_case_of(folder_, bucket.worst);
  if (worst && !deeper(shown, *worst)) return Done{};
  return put("worst", shown, bucket.worst);
}

Result<Done> BucketFiles::commit(const Bucket& bucket) const {
  if (const Result<Done> written = write_bucket(folder_, bucket); !written) return written;
  std::error_code ignored;
  for (const std::string& path : replaced_) std::filesystem::remove(path, ignored);
  return Done{};
}

Result<Done> BucketFiles::put(std::string_view role, const Case& next, std::string& current) {
  const std::string name = case_file_name(role, next.spec);
  if (const Result<Done> written = write_inside(folder_, name, print_case(next)); !written) return written;
  if (!current.empty() && current != name) replaced_.push_back(folder_ + "/" + current);
  current = name;
  return Done{};
}

namespace {

// Reads the bucket of a folder. If there is none yet, it returns a bucket with the name and state of `source`, but
// without cases.
Result<Bucket> present_bucket(const Bucket& source, const std::string& folder) {
  if (std::error_code error; std::filesystem::exists(folder + "/bucket.json", error)) return read_bucket(folder);
  Bucket bucket = source;
  bucket.min.clear(), bucket.worst.clear(), bucket.orig.clear();
  return bucket;
}

}  // namespace

Result<Done> merge_bucket(const std::string& from, const Bucket& source, const std::string& to) {
  const Result<Case> minimal = read_case_of(from, source.min), worst = read_case_of(from, source.worst);
  const Result<Case> original = source.orig.empty() ? minimal : read_case_of(from, source.orig);
  for (const Result<Case>* stored : {&minimal, &worst, &original})
    if (!*stored) return stored->issue();
  const Result<Bucket> present = present_bucket(source, to);
  if (!present) return present.issue();
  if (const Result<Done> made = make_folder(to); !made) return made;
  Bucket merged = *present;
  merge_state(merged, source);
  merged.runs.clear();
  std::ranges::set_union(present->runs, source.runs, std::back_inserter(merged.runs));
  BucketFiles files(to);
  const Case* shrunk_from = source.orig.empty() ? nullptr : &*original;
  if (const auto kept = files.put_pair(*minimal, shrunk_from, merged); !kept) return kept;
  if (const auto kept = files.put_worst(*worst, merged); !kept) return kept;
  return files.commit(merged);
}

std::vector<std::string> files_of(const Bucket& bucket) {
  std::vector<std::string> files;
  for (const std::string& file : {bucket.min, bucket.worst, bucket.orig})
    if (!file.empty()) files.push_back(file);
  return files;
}

}  // namespace contort
