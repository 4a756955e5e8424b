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

// The members of the causes of a corpus: of all buckets that are not fixed. Buckets that cannot be read are reported,
// and set the exit code for bad input.
std::vector<CauseMember> unfixed_members(const Corpus& corpus, Context& context);

// The ids of the causes that match `prefix`: causes whose ids begin with it; if there are none, causes of failures
// whose ids or folder names begin with it. Users copy both kinds of ids from one list.
std::set<std::string> causes_named(std::span<const CauseMember> members, const std::string& prefix);

// Code corpus.no_cause.
Issue no_such_cause(const std::string& prefix);

struct CausesText {
  std::int64_t cases = 0;       // number of cases of the runs
  std::size_t most = 12;        // rows that are printed
  std::string corpus{};         // for the command that lists all causes
  std::int64_t unsettled = 0;   // failures of stopped runs, which have no cause yet; for the JSON
  const Sources& sources;
};

// Two lines for each cause: its headline, marked NEW, MORE or RARE (CauseNews), then its severity and frequency with
// the command that shows its deepest case again. One line counts the causes that are left out, and one explains a mark.
std::string causes_text(std::span<const CauseRow> rows, const CausesText& about);

std::string causes_json(std::span<const CauseRow> rows, const CausesText& about);

}  // namespace contort::cli
