// A bucket is one failure, recognised by its identity, with its state and the notes of people about it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "corpus/case.h"
#include "model/core/result.h"

namespace contort {

// The version of the rules that make family, features and id. A bucket stores the version that named it; `contort
// corpus rekey` names it again.
inline constexpr int kSignatureVersion = 2;

// The coarse features, without numbers, that a minimal spec needs in order to fail. Example: "actions=pose,reach
// clips=1 sequences=1 interrupt swap".
std::string features_of(const Spec& spec);

// The id of a bucket: 12 hex digits of a hash over the family and the features.
std::string bucket_id(const Family& family, const std::string& features);

// Returns true if `a` is cheaper than `b`, for specs that show the same failure: fewer actions, then shorter text,
// then the text itself.
bool cheaper(const Spec& a, const Spec& b);

// docs/reference/corpus.md describes the states and their transitions. In files `fresh` is "new".
enum class BucketState { fresh, open, fixed, regressed, flaky, quarantined, invalid };
std::string_view state_name(BucketState state);

struct Bucket {
  std::string id;
  std::string check;
  Family family;
  std::string features;
  int signature = 1;  // kSignatureVersion of the rules that named the bucket; files of the first version do not have it
  BucketState state = BucketState::fresh;
  BucketState was = BucketState::fresh;  // the state before it became flaky or invalid; meaningless in other states
  std::string owner;                     // open, quarantined: the person who is responsible for the failure
  std::string ticket;                    // the ticket about the failure
  std::string reason;                    // quarantined: the reason why the failure is tolerated
  std::string expires;                   // quarantined: the last day, YYYY-MM-DD
  std::string note;                      // a note by people
  std::vector<std::string> passed_in;    // builds in which the failure was gone since it last showed, in their order
  int streak = 0;                        // number of successive replays that passed (quarantined) or were steady
                                         // (flaky)
  int changes = 0;                // number of changes to the fields above; of two copies the one with more changes is
                                  // kept
  std::vector<std::string> runs;  // names of the runs that stored a case here; runs.h says how often each run saw the
                                  // family
  std::string min;                // file names in the bucket's folder
  std::string worst;
  std::string orig;
  bool operator==(const Bucket&) const = default;
};

// The bucket of a minimal case, by the present rules.
Bucket bucket_of(const Case& minimal);

// The name of the bucket's folder in buckets/, such as "joint_range-0123456789ab".
std::string folder_name(const Bucket& bucket);

// The name of a case file, such as "min-0123456789abcdef.json".
std::string case_file_name(std::string_view role, const Spec& spec);

// Reads bucket.json. Codes json.*, bucket.*, file.*. Code bucket.bad_name if the id or the name of a case has an
// invalid form; these names may come from strangers and become paths.
Result<Bucket> read_bucket(const std::string& folder);

// Reads bucket.json and checks that the bucket may be changed: it lies in the folder of its name (code
// bucket.wrong_folder), and none of its cases is a link that leads out of it (code file.outside).
Result<Bucket> read_own_bucket(const std::string& folder);

// Reads bucket.json; names with an invalid form become empty. For fsck, which repairs them.
Result<Bucket> read_bucket_without_bad_names(const std::string& folder);

// Returns true if a bucket was refused because of its names or links, and not because it cannot be read.
bool is_untrusted(const Issue& issue);

// Writes bucket.json. Also has the codes of read_bucket, if the existing file cannot be read.
Result<Done> write_bucket(const std::string& folder, const Bucket& bucket);
std::string print_bucket(const Bucket& bucket);
std::string bucket_schema();

}  // namespace contort
