// The causes of a corpus: its buckets, grouped and ordered for people. docs/reference/causes.md has the formula of
// severity.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/runs.h"

namespace contort {

// A bucket of a cause, with its minimal case.
struct CauseMember {
  Bucket bucket;
  Case minimal;
  std::string path;  // path of the minimal case
};

// The comparison of a cause with a baseline (baseline.h).
enum class CauseNews : std::uint8_t {
  known,  // the baseline has the cause, or saw its families about as often
  fresh,  // the baseline does not have the cause, and chance does not explain how often it shows
  more,   // the baseline has the cause, and chance does not explain how much more often it shows now
  rare,   // the baseline never saw the cause, and it shows in too few groups to decide whether anything changed
};
std::span<const std::string_view> cause_news_names();  // in the order of the enum: "known", "new", "more often", "rare"
inline bool is_news(CauseNews news) { return news == CauseNews::fresh || news == CauseNews::more; }

struct CauseRow {
  std::string id;
  double severity = 0.0;      // [0, 100]
  std::string headline{};     // names what fails in its deepest member, and where else it fails
  std::int64_t cases = 0;     // number of cases of all runs that showed the most frequent family of its buckets; >= 1
                              // if any case ran
  std::set<std::string> characters{};
  std::vector<CauseMember> members{};  // the deepest first, then by name
  CauseNews news = CauseNews::known;   // mark_news (baseline.h)
};

// Reads the minimal cases of these buckets. Those that cannot be read are reported in `damaged`.
std::vector<CauseMember> cause_members(const Corpus& corpus, std::vector<Bucket> buckets, std::vector<Issue>& damaged);

// Groups members by cause. The most severe cause comes first, equally severe ones by id. `runs` give the number of
// cases of each family.
std::vector<CauseRow> causes_of(std::vector<CauseMember> members, std::span<const RunRecord> runs);

// The ids of the causes of these members.
std::set<std::string> cause_ids(std::span<const CauseMember> members);

// Returns the severity, [0, 100], of a cause with this kind of check, this median depth (in scales of the check), and
// this share of cases that show it.
double severity_of(CheckKind kind, double median_depth, CauseScope scope, double share);

}  // namespace contort
