// The causes of failures on the terminal: after a run, and of a whole corpus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cli/sources.h"
#include "corpus/causes.h"

namespace contort::cli {

struct Context;

// The members of the causes of a corpus: of all buckets that are not fixed. What cannot be read is told, and sets the
// exit code to that of bad input.
std::vector<CauseMember> unfixed_members(const Corpus& corpus, Context& context);

struct CausesText {
  std::int64_t cases = 0;       // of the runs
  std::set<std::string> known{};  // ids of causes that were there before; the others are new
  std::size_t most = 12;        // rows that are printed
  std::string corpus{};         // for the command that shows the others
  const Sources& sources;
};

// Two lines for each cause: its headline, and how severe and frequent it is with the command that shows its deepest
// case again. One line counts the causes that are left out.
std::string causes_text(std::span<const CauseRow> rows, const CausesText& about);

std::string causes_json(std::span<const CauseRow> rows, const CausesText& about);

}  // namespace contort::cli
