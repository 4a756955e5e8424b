// The reasons for which a generator refuses requests that its manifest allows, and how often it gives each.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/result.h"

namespace contort {

struct RefusalCount {
  std::int64_t cases = 0;
  std::int64_t first_index = 0;  // index of the first case with this reason
  std::string text;              // the reason in the words of that case
  bool operator==(const RefusalCount&) const = default;
};

// Counts by reason. Reasons that differ only in their numbers count as one, whose name has # for each number.
using RefusalCounts = std::map<std::string, RefusalCount>;

// Returns the generator's own words, without what our messages say before them.
std::string reason_of(const Issue& refusal);

// Counts a refused case. There are at most 100 reasons: cases that give a further one are not counted.
void count_refusal(const std::string& reason, std::int64_t index, RefusalCounts& counts);
void add_refusals(const RefusalCounts& from, RefusalCounts& sum);

// Returns the reasons, the most frequent one first.
std::vector<RefusalCount> by_frequency(const RefusalCounts& counts);

// Returns lines such as "refused: 12 of 24 motions: the angle is too large": at most `most` reasons, and a line that
// counts all others. `refused` is the number of all cases that were refused.
std::vector<std::string> refusal_lines(const RefusalCounts& counts, std::int64_t refused, std::int64_t motions,
                                       std::size_t most);

}  // namespace contort
