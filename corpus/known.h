// Finds out whether a request is known to go wrong, before anything is played. docs/reference/conditions.md describes
// how rules are learned and what their names mean. This header needs only the standard library, allocates nothing, and
// is copied whole into the header that `contort explain --header` writes for games.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace contort::known {

// One value of a request: a number or a word.
struct Value {
  std::string_view name;    // "reach.target_m.x", "reach.slot"
  double number = 0.0;      // in the unit of the name
  std::string_view word{};  // for slots, parts and choices
};

// A request that has not been played yet.
struct Question {
  std::string_view character;
  std::span<const Value> values;
};

// The number that is compared.
enum class Quantity : std::uint8_t {
  value,
  magnitude,
  per_second,            // divided by the seconds of the action
  magnitude_per_second,
  times_seconds,         // a speed times the seconds, which is a distance
};

enum class Op : std::uint8_t { below, above, is, is_not };

// A comparison of one value.
struct Term {
  std::string_view name;
  Quantity quantity = Quantity::value;
  bool is_mirrored = false;  // on the right side the number counts with the opposite sign
  Op op = Op::below;
  double limit = 0.0;       // for below and above
  std::string_view word{};  // for is and is_not
};

// A conjunction.
struct All {
  std::span<const Term> terms;
};

// A rule. It holds for a request of this character if the request has all needed values and one conjunction holds.
struct KnownRule {
  std::string_view cause;  // id of the cause
  std::string_view text;   // a sentence for people
  std::string_view character;
  std::span<const std::string_view> needs;  // names of values, such as "reach.seconds" if the rule is about the action
                                            // reach
  std::span<const All> any_of;
  double precision = 0.0;  // fraction of fresh requests inside of the rule that failed
  double recall = 0.0;     // fraction of failing fresh requests that are inside of the rule
};

inline const Value* find_value(const Question& question, std::string_view name) {
  for (const Value& value : question.values)
    if (value.name == name) return &value;
  return nullptr;
}

// The value ACTION.`last` of the action that `name` begins with.
inline const Value* value_beside(const Question& question, std::string_view name, std::string_view last) {
  const std::string_view action = name.substr(0, name.find('.'));
  for (const Value& value : question.values)
    if (value.name.size() == action.size() + 1 + last.size() && value.name.starts_with(action) &&
        value.name[action.size()] == '.' && value.name.ends_with(last))
      return &value;
  return nullptr;
}

// Sets `amount` to the number that is compared; returns false if the question does not have it.
inline bool tells_amount(const Question& question, const Term& term, double& amount) {
  const Value* const value = find_value(question, term.name);
  if (value == nullptr) return false;
  amount = value->number;
  if (term.is_mirrored) {
    const Value* const slot = value_beside(question, term.name, "slot");
    if (slot != nullptr && slot->word.ends_with("_right")) amount = -amount;
  }
  const bool is_magnitude =
      term.quantity == Quantity::magnitude || term.quantity == Quantity::magnitude_per_second;
  if (is_magnitude && amount < 0.0) amount = -amount;
  if (term.quantity == Quantity::value || term.quantity == Quantity::magnitude) return true;
  const Value* const seconds = value_beside(question, term.name, "seconds");
  if (seconds == nullptr || !(seconds->number > 0.0)) return false;
  amount = term.quantity == Quantity::times_seconds ? amount * seconds->number : amount / seconds->number;
  return true;
}

inline bool holds(const Term& term, const Question& question) {
  double amount = 0.0;
  switch (term.op) {
    case Op::below: return tells_amount(question, term, amount) && amount < term.limit;
    case Op::above: return tells_amount(question, term, amount) && amount > term.limit;
    case Op::is:
    case Op::is_not: break;
  }
  const Value* const value = find_value(question, term.name);
  return value != nullptr && (value->word == term.word) == (term.op == Op::is);
}

inline bool holds(const All& all, const Question& question) {
  for (const Term& term : all.terms)
    if (!holds(term, question)) return false;
  return true;
}

inline bool holds(const KnownRule& rule, const Question& question) {
  if (rule.character != question.character) return false;
  for (const std::string_view name : rule.needs)
    if (find_value(question, name) == nullptr) return false;
  for (const All& all : rule.any_of)
    if (holds(all, question)) return true;
  return false;
}

// The first rule that holds; nullptr if nothing is known about the question.
inline const KnownRule* find_rule(std::span<const KnownRule> rules, const Question& question) {
  for (const KnownRule& rule : rules)
    if (holds(rule, question)) return &rule;
  return nullptr;
}

}  // namespace contort::known
