// contort fuzz --against: the base, the corpus of a pair of builds, and the rows about differences
// (docs/reference/against.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "corpus/corpus.h"
#include "fuzz/run.h"

namespace contort::cli {

struct AgainstOptions {
  std::string base;        // the other program, a path or a name in PATH; "": no comparison
  bool moved = false;      // motions that only differ gate too
  double tolerance = 0.1;  // depth below which a failure of one build alone does not count
};

void add_against_options(CLI::App& command, AgainstOptions& options);

// Starts the base once to check that it answers. Returns nothing without --against. Codes file.unreadable, against.*.
Result<std::optional<AgainstConfig>> choose_base(const AgainstOptions& options, const WorkerLimits& limits,
                                                 const Context& context);

// Version and content hash of this program.
Result<std::string> own_build();

// "contort-out/against-0123abcd": the corpus of this pair of builds.
std::string folder_of_pair(const AgainstConfig& against);

// Refuses a corpus of another pair of builds; without a comparison, a corpus of any pair. Code against.other_corpus.
Result<Done> check_pair(const Corpus& corpus, const std::optional<AgainstConfig>& against);

// Refuses to merge runs of different pairs of builds, or of a pair and of none, into one corpus. Code
// against.other_corpus.
Result<Done> check_same_pair(std::span<const Corpus> corpora);

// Prints rows, counts and the names of checks that were not compared, for people.
void print_comparison(const RunResult& result, const AgainstConfig& against,
                      const Sources& sources);

// The same as print_comparison, as a JSON object.
std::string comparison_json(const RunResult& result, const AgainstConfig& against,
                            const Sources& sources);

// " broke=1 worse=0 mended=2 moved=3 refused=0 same=250", for the last line; "" without a comparison.
std::string comparison_counts(const RunResult& result);

// Returns true if a family broke or got worse, or if a motion differs and --moved is given.
bool comparison_gates(const RunResult& result, const AgainstOptions& options);

// A sentence about a minimal case of such a corpus: "new since the base; the base passes this case by 0.84"; "" of
// other cases.
std::string sentence_about_base(const Provenance& from);

// Returns true if the base refused every case, so that nothing was compared.
bool compared_nothing(const RunResult& result);

}  // namespace contort::cli
