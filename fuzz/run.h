// A fuzzing run: draw, evaluate, confirm, shrink, store.
//
// Cases run in rounds of kRound, in worker processes (worker_pool.h): a crash, a hang or too much memory there is a
// finding. A round is folded in the order of its cases. Failures of new families are run again, shrunk and stored. So a
// run of N cases leaves the same corpus, byte for byte, for any number of workers, and whether or not it was killed and
// resumed. Shards leave leads; merging all shards files them in buckets (corpus/merge.h).
#pragma once

#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/runs.h"
#include "process/worker_pool.h"
#include "fuzz/base_build.h"
#include "fuzz/draw.h"
#include "fuzz/lineage.h"
#include "fuzz/shard.h"
#include "fuzz/shrink.h"

namespace contort {

struct RunConfig {
  DrawConfig draw;
  std::vector<Spec> seeds;     // run first and unchanged; all other cases are drawn
  std::int64_t seed = 1;       // [0, 2^53]
  std::int64_t cases = 2000;   // stop after this number, including seeds, of all shards together; < 0: no limit
  double time_s = 0.0;         // stop after this time; 0: no limit
  int jobs = 1;                // worker processes, >= 1
  Shard shard;
  int shrinks_per_family = 2;  // failures of one family that are shrunk; later ones are only counted
  int shrinks_per_case = 4;    // families of one case that are shrunk, the earliest first; the others are only counted
  bool resume = false;         // continue a run with the same options that was stopped
  WorkerLimits limits;         // limits of one case
  ShrinkConfig shrink;
  double shrink_time_s = 0.0;  // stop each shrink after this time; 0: no limit
  CheckSettings checks;
  std::optional<AgainstConfig> against;  // only failures that the base does not show count
  std::string surroundings;  // id of everything on which all cases depend; a different id means a different run
  std::string tool;      // version, for provenance
  std::string generator{};        // name of the program under test, for provenance; "": the built-in generator
  std::string generator_build{};  // its build
  double deadline_s = 0.0;  // on the steady clock; set by the run
};

// Returns true if case `index` is a seed. A seed has no raw numbers, so no other case is made from it.
inline bool is_seed(const RunConfig& config, std::int64_t index) { return index < std::ssize(config.seeds); }

struct RunProgress {
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t failing = 0;  // cases with at least one finding
  int families = 0;
  int buckets_new = 0;
  int shrinking = 0;  // failures that wait or are being shrunk
  double elapsed_s = 0.0;
};

// A case with findings.
struct FailingCase {
  std::int64_t index = 0;
  std::string arm;                    // "guided"
  std::vector<Family> families;       // in the order of their first frames; with a base, only those that count
  Spec spec;
};

struct RunResult {
  RunRecord record;
  double elapsed_s = 0.0;
  std::vector<WaiverUse> waivers;          // for each waiver of the settings, the findings that it hid
  std::vector<std::string> new_buckets;    // folders
  std::vector<std::string> known_buckets;  // folders that existed before this run
  std::vector<std::string> unconfirmed;    // leads whose second run differed
  std::vector<std::string> waiting;        // leads that were not shrunk in time; the next run here shrinks them
  int unsettled = 0;                       // failures of an interrupted run, with which `resume` continues
  bool interrupted = false;                // stopped by `stop`
  Issue issue;                             // the corpus could not be written; code "" if there was no error
};

// Returns the name of the run, "seed_7_0123abcd". It differs for another seed, profile or generator, and for other
// characters, seed specs or limits.
std::string run_name(const RunConfig& config);

// Returns the provenance of a case that the run drew.
Provenance provenance_in(const RunConfig& config, std::int64_t index);

// Makes a case of the run again from its ancestry.
Spec spec_of(const RunConfig& config, Generator& generator, const Lineage& lineage);

// Runs the cases. `progress` is called a few times per second. `stop` is called often; when it returns true, the run
// ends early and keeps its findings. `failing`, if given, is called with each failing case in the order of indices;
// after a resume, with some of them again. The caller must have no other threads.
RunResult run_fuzz(const RunConfig& config, Generator& generator, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop,
                   const std::function<void(const FailingCase&)>& failing = {});

}  // namespace contort
