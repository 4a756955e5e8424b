// The file rules.json of a corpus.
#include <algorithm>
#include <filesystem>

#include "corpus/condition.h"
#include "corpus/lock.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

struct StoredConditions {
  std::vector<Condition> conditions;
};

namespace {

using json_fields::Rule;
using json_fields::Text;

const Rule kRuleLabel{.text = Text::label, .may_be_empty = true};
const Rule kCaseCount{.low = 0, .high = 1e6};

}  // namespace

template <class V>
void fields(V& v, const ConditionTerm*) {
  v.field("name", &ConditionTerm::name, {.text = Text::label, .required = true}, "The value that is compared.");
  v.field("quantity", &ConditionTerm::quantity, {.names = quantity_names()}, "Number that is computed from the value.");
  v.field("mirrored", &ConditionTerm::is_mirrored, {}, "Whether the value has the opposite sign on the right side.");
  v.field("op", &ConditionTerm::op, {.names = op_names(), .required = true}, "Operator of the comparison.");
  v.field("limit", &ConditionTerm::limit, {.low = -1e12, .high = 1e12}, "Limit of the comparisons below and above.");
  v.field("lowest", &ConditionTerm::lowest, {.low = -1e12, .high = 1e12},
          "Lower end of the interval in which the limit may be.");
  v.field("highest", &ConditionTerm::highest, {.low = -1e12, .high = 1e12},
          "Upper end of the interval in which the limit may be.");
  v.field("word", &ConditionTerm::word, kRuleLabel, "Word of the comparisons is and is_not.");
}

template <class V>
void fields(V& v, const RuleTrial*) {
  v.field("inside", &RuleTrial::inside, kCaseCount, "Number of fresh cases for which the rule holds.");
  v.field("inside_failing", &RuleTrial::inside_failing, kCaseCount, "Number of those inside that fail.");
  v.field("outside", &RuleTrial::outside, kCaseCount, "Number of fresh cases for which the rule does not hold.");
  v.field("outside_failing", &RuleTrial::outside_failing, kCaseCount, "Number of those outside that fail.");
  v.field("inside_share", &RuleTrial::inside_share, {.low = 0, .high = 1}, "Share of draws for which the rule holds.");
}

template <class V>
void fields(V& v, const Condition*) {
  v.field("cause", &Condition::cause, {.text = Text::label, .required = true}, "Id of the cause.");
  v.field("headline", &Condition::headline, {.text = Text::prose, .may_be_empty = true}, "Headline of the cause.");
  v.field("character", &Condition::character, {.text = Text::label, .required = true}, "Name of the character.");
  v.field("character_hash", &Condition::character_hash, kRuleLabel, "Hash of the minimal case's character.");
  v.field("tool", &Condition::tool, {.text = Text::prose, .may_be_empty = true}, "Build that learned the rule.");
  v.field("learned_from", &Condition::learned_from, kRuleLabel, "Content id of the minimal spec.");
  v.field("needs", &Condition::needs, {.max_count = 64, .text = Text::label}, "Values that a request must have.");
  v.field("any_of", &Condition::any_of, {.max_count = kMostComparisons},
          "Conjunctions of comparisons, of which one has to hold; an empty list: no rule was found.");
  v.field("drawn", &Condition::drawn, kCaseCount, "Number of drawn cases from which the rule was learned.");
  v.field("failing", &Condition::failing, kCaseCount, "Number of those cases that fail.");
  v.field("trial", &Condition::trial, {}, "Result of trying the rule on fresh cases.");
}

template <class V>
void fields(V& v, const StoredConditions*) {
  v.constant("format", "contort.rules/1");
  v.field("rules", &StoredConditions::conditions, {.max_count = 10'000}, "Rules, one for each cause and character.");
}

namespace {

constexpr const char* kRulesFile = "rules.json";

std::string path_in(const Corpus& corpus) { return corpus.folder() + "/" + kRulesFile; }

}  // namespace

Result<std::vector<Condition>> parse_conditions(std::string_view json) {
  Result<StoredConditions> stored = json_fields::read_document<StoredConditions>(json, "rules");
  if (!stored) return stored.issue();
  return std::move(stored).value().conditions;
}

std::string print_conditions(std::vector<Condition> conditions) {
  std::ranges::stable_sort(conditions, [](const Condition& a, const Condition& b) {
    return std::tie(a.cause, a.character) < std::tie(b.cause, b.character);
  });
  return json_fields::write_pretty(StoredConditions{std::move(conditions)});
}

std::string conditions_schema() { return json_fields::write_schema<StoredConditions>("Contort rules"); }

Result<std::vector<Condition>> conditions_of(const Corpus& corpus) {
  std::error_code error;
  if (std::filesystem::symlink_status(path_in(corpus), error).type() == std::filesystem::file_type::not_found)
    return std::vector<Condition>{};
  const Result<std::string> text = read_inside(corpus.folder(), kRulesFile, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<std::vector<Condition>> conditions = parse_conditions(*text);
  if (!conditions) return about_file(path_in(corpus), conditions.issue());
  return conditions;
}

Result<std::vector<Condition>> change_conditions(const Corpus& corpus, const ConditionsChange& change) {
  const Result<CorpusLock> lock = CorpusLock::take(corpus.folder());
  if (!lock) return lock.issue();
  Result<std::vector<Condition>> read = conditions_of(corpus);
  if (!read) return read;
  std::vector<Condition> conditions = std::move(read).value();
  change(conditions);
  if (const Result<Done> written = write_file(path_in(corpus), print_conditions(conditions)); !written)
    return written.issue();
  return conditions;
}

}  // namespace contort
