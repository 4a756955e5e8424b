// The condition under which a cause shows: a rule that was learned from cases that fail and cases that pass, and tried
// on others. docs/reference/conditions.md describes it; fuzz/condition_search.h learns it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/corpus.h"
#include "corpus/known.h"

namespace contort {

inline constexpr std::size_t kMostComparisons = 4;  // the most comparisons in a rule

// Names in the order of the enums.
std::span<const std::string_view> quantity_names();
std::span<const std::string_view> op_names();

struct ConditionTerm {
  std::string name;
  known::Quantity quantity = known::Quantity::value;
  bool is_mirrored = false;
  known::Op op = known::Op::below;
  double limit = 0.0;  // for below and above; any limit in [lowest, highest] separates the same cases
  double lowest = 0.0;
  double highest = 0.0;
  std::string word{};  // for is and is_not
  bool operator==(const ConditionTerm&) const = default;
};

using Conjunction = std::vector<ConditionTerm>;

// The results of fresh cases on both sides of a rule.
struct RuleTrial {
  int inside = 0;
  int inside_failing = 0;
  int outside = 0;
  int outside_failing = 0;
  double inside_share = 0.0;  // fraction of all draws that lie inside, [0, 1]
  bool operator==(const RuleTrial&) const = default;
};

struct Condition {
  std::string cause;           // id
  std::string headline;        // headline of the cause, on this character
  std::string character;       // name in the library
  std::string character_hash;  // hash at the time of learning; if it changes, the rule is void
  std::string tool;            // version of Contort that learned it; if it changes, the rule is void
  std::string learned_from;    // spec_id of the minimal case; if it changes, the rule is void
  std::vector<std::string> needs;   // names of values that a request must have
  std::vector<Conjunction> any_of{};  // one of them must hold; empty: no rule was found
  int drawn = 0;                    // number of cases from which it was learned
  int failing = 0;                  // number of these cases that fail
  RuleTrial trial{};
  bool operator==(const Condition&) const = default;
};

// Fractions of fresh cases in [0, 1]; 0 if no case was tried.
double precision_of(const RuleTrial& trial);
double recall_of(const RuleTrial& trial);
double failing_outside(const RuleTrial& trial);

inline bool has_rule(const Condition& condition) { return !condition.any_of.empty(); }

// "reach.seconds < 0.4 and |aim.azimuth_deg| > 30", with "or" between conjunctions; "always" for no comparison.
std::string rule_text(const std::vector<Conjunction>& any_of);

// A sentence, such as "Fails in 97 % of 60 fresh cases where reach.seconds < 0.4, and in 2 % of 60 others."
std::string condition_text(const Condition& condition);

// The rules of some conditions in the form that known.h compares.
class RuleTable {
 public:
  explicit RuleTable(std::vector<Condition> conditions);
  RuleTable(const RuleTable&) = delete;
  RuleTable& operator=(const RuleTable&) = delete;

  std::span<const known::KnownRule> rules() const { return rules_; }

 private:
  std::vector<Condition> conditions_;  // owns all text
  std::vector<std::string> texts_;
  std::vector<std::vector<std::string_view>> needs_;
  std::vector<std::vector<known::Term>> comparisons_;
  std::vector<std::vector<known::All>> alls_;
  std::vector<known::KnownRule> rules_;
};

// ---- the file rules.json of a corpus

// Parses the text of print_conditions. Codes json.*.
Result<std::vector<Condition>> parse_conditions(std::string_view json);
std::string print_conditions(std::vector<Condition> conditions);  // sorted by cause and character
std::string conditions_schema();

// The conditions of a corpus; none if it has no such file. Codes json.*, and file.outside if the file is a link that
// leads out of the corpus.
Result<std::vector<Condition>> conditions_of(const Corpus& corpus);
// Reads the conditions, changes them and writes them while no other process writes. Returns the stored conditions.
// Codes of conditions_of, and file.unwritable; then nothing changes.
using ConditionsChange = std::function<void(std::vector<Condition>&)>;
Result<std::vector<Condition>> change_conditions(const Corpus& corpus, const ConditionsChange& change);

// The conditions of several corpora. Of two for the same cause and character, the one with the better F1 on fresh cases
// stays, of equally good ones the one whose text comes first, so that the order of merging does not matter.
std::vector<Condition> merged_conditions(std::vector<Condition> all);

}  // namespace contort
