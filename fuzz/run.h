// A fuzzing run: draw, evaluate, confirm, shrink, store.
//
// Cases run in batches. Within a batch threads take cases in any order; the batch is then folded in index order, new
// failures are shrunk (again in parallel, again folded in order) and stored. So a run of N cases leaves the same
// corpus, byte for byte, for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "fuzz/draw.h"
#include "fuzz/shrink.h"

namespace contort {

struct RunConfig {
  DrawConfig draw;
  std::int64_t seed = 1;       // [0, 2^53]
  std::int64_t cases = 2000;   // stop after so many; < 0: no limit
  double time_s = 0.0;         // stop after so long; 0: no limit
  int jobs = 1;                // threads, >= 1
  int batch = 256;             // cases in a batch; part of what a run means: another size may store other examples
  int shrinks_per_family = 2;  // failures of one family that are shrunk; later ones are only counted
  ShrinkConfig shrink;
  CheckSettings checks;
  std::string tool;  // version, for provenance
};

struct RunProgress {
  std::int64_t cases = 0;
  std::int64_t frames = 0;
  std::int64_t failing = 0;  // cases with at least one finding
  int families = 0;
  int buckets_new = 0;
  int shrinking = 0;  // failures being shrunk now
  double elapsed_s = 0.0;
};

struct RunResult {
  RunProgress totals;
  std::int64_t discarded = 0;                    // drawn specs that did not build: a fault of the draw
  std::map<std::string, std::int64_t> families;  // cases by family
  std::map<std::string, std::int64_t> tested;    // "action pose on arm", "character mech": what was drawn
  std::vector<WaiverUse> waivers;                // of the settings: findings that each one hid
  std::vector<std::string> new_buckets;          // folders
  std::vector<std::string> known_buckets;        // folders that were there before this run
  std::vector<std::string> unconfirmed;          // leads whose second run differed: nondeterminism, ours to explain
  bool interrupted = false;                      // stopped by `stop`
  Issue issue;                                   // the corpus could not be written; code "" where all went well
};

// `progress` is called from the calling thread, now and then. `stop` is asked between cases; when it answers true the
// run ends early and keeps what it found.
RunResult run_fuzz(const RunConfig& config, const Library& library, const Corpus& corpus,
                   const std::function<void(const RunProgress&)>& progress, const std::function<bool()>& stop);

}  // namespace contort
