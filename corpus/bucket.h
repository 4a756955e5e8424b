// A bucket: what is one failure, told by its identity, and what people and replays know about it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/case.h"
#include "model/core/result.h"

namespace contort {

// Rules by which family, features and id are made. A bucket says by which it was named; `contort corpus rekey` names it
// anew.
inline constexpr int kSignatureVersion = 2;

// Coarse features of a minimal spec: what it needed in order to fail, without numbers.
// "actions=pose,reach clips=1 sequences=1 interrupt swap".
std::string features_of(const Spec& spec);

// 12 hex digits over the family and the features.
std::string bucket_id(const Family& family, const std::string& features);

// Order of cost between specs that show the same: fewer actions, then shorter text, then the text.
bool cheaper(const Spec& a, const Spec& b);

// docs/corpus.md has what leads from one to another. In files `fresh` is "new".
enum class BucketState { fresh, open, fixed, regressed, flaky, quarantined, invalid };
std::string_view state_name(BucketState state);

struct Bucket {
  std::string id;
  std::string check;
  Family family;
  std::string features;
  int signature = 1;  // kSignatureVersion of who named it; files of the first rules do not say it
  BucketState state = BucketState::fresh;
  BucketState was = BucketState::fresh;  // before it was flaky or invalid; meaningless in other states
  std::string owner;                     // open, quarantined: who looks after it
  std::string ticket;                    // where that is written down
  std::string reason;                    // quarantined: why it may fail
  std::string expires;                   // quarantined: the last day, YYYY-MM-DD
  std::string note;                      // what people say about it
  std::vector<std::string> passed_in;    // builds in which it was gone, one after the other, since it failed last
  int streak = 0;                        // quarantined: replays in a row that passed; flaky: that were steady
  int changes = 0;                // of all this since the bucket is there; of two copies the one with more counts
  std::vector<std::string> runs;  // that put a case here, by name; how often each saw the family is in runs.h
  std::string min;                // file names in the bucket's folder
  std::string worst;
  std::string orig;
  bool operator==(const Bucket&) const = default;
};

// The bucket that a minimal case belongs to, by today's rules.
Bucket bucket_of(const Case& minimal);

// "joint_range-0123456789ab": the bucket's folder in buckets/.
std::string folder_name(const Bucket& bucket);

// "min-0123456789abcdef.json"
std::string case_file_name(std::string_view role, const Spec& spec);

// bucket.json; codes json.*, bucket.*, file.*. Code bucket.bad_name where the id or the name of a case has not its
// form: strangers write them, and they become paths.
Result<Bucket> read_bucket(const std::string& folder);

// The same, and the bucket may be worked with: it lies in the folder of its name (code bucket.wrong_folder), and its
// cases are no links that lead out of it (code file.outside).
Result<Bucket> read_own_bucket(const std::string& folder);

// Reads bucket.json; names that are not of their form are empty. For fsck, which mends them.
Result<Bucket> read_bucket_without_bad_names(const std::string& folder);

// Whether a bucket was refused for where its names or links lead, and not because it cannot be read.
bool is_untrusted(const Issue& issue);

// Also codes of read_bucket, where it could not be read again.
Result<Done> write_bucket(const std::string& folder, const Bucket& bucket);
std::string print_bucket(const Bucket& bucket);
std::string bucket_schema();

}  // namespace contort
