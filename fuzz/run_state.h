// The state of a run, with which a killed run can continue: DIR/runs/<record>.state, written between some rounds and
// removed at the end. Work since the last write is repeated, with the same result.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "corpus/runs.h"
#include "fuzz/islands.h"
#include "fuzz/messages.h"
#include "fuzz/stages.h"

namespace contort {

// The cases of one epoch of an island (stages.h).
struct CaseGroup {
  std::vector<Family> shown;  // by at least one of them, sorted
  bool operator==(const CaseGroup&) const = default;
};

struct RunState {
  std::string plan;       // the options of the run; other options mean another run
  std::int64_t next = 0;  // first case of the next round
  RunRecord record;
  std::vector<Island> islands = std::vector<Island>(kIslands);
  std::vector<Ingredients> ingredients = std::vector<Ingredients>(kIslands);
  std::vector<CaseGroup> groups = std::vector<CaseGroup>(kIslands);  // the present one of each island
  std::vector<SettleTask> wanted;          // failures that are not processed yet
  std::vector<std::string> new_buckets;    // names of folders
  std::vector<std::string> known_buckets;  // names of folders
  std::vector<std::string> unconfirmed;    // paths of leads, in the corpus
  std::vector<WaiverUse> waivers;
};

std::string state_path(const Corpus& corpus, const RunRecord& record);
Result<Done> keep_state(const Corpus& corpus, const RunState& state);

// Returns no state if none was kept. A state in a corpus from somebody else is not trusted, so paths in it must stay in
// the corpus. Codes state.wrong_format (of another version), state.other_plan, state.other_run, file.*, json.*.
Result<std::optional<RunState>> load_state(const Corpus& corpus, const RunRecord& record, const std::string& plan);
void drop_state(const Corpus& corpus, const RunRecord& record);

// Returns the number of failures that stopped runs found and neither shrunk nor stored. `resume` continues with them.
// States that cannot be read are skipped; load_state reports them.
std::int64_t unsettled_failures(const Corpus& corpus);

// A lock, so that only one process at a time executes a run. It is held until it is destroyed or the process ends.
class RunLock {
 public:
  // Code run.busy.
  static Result<RunLock> take(const Corpus& corpus, const RunRecord& record);
  RunLock(RunLock&& other) noexcept;
  RunLock& operator=(RunLock&&) = delete;
  ~RunLock();

 private:
  RunLock(int file, std::string path) : file_(file), path_(std::move(path)) {}
  int file_;
  std::string path_;
};

}  // namespace contort
