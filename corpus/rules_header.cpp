#include "corpus/rules_header.h"

#include <algorithm>
#include <cstdio>

#include "corpus/known_header.h"

namespace contort {

namespace {

// A C++ string literal. Characters that could end it, or begin an escape or a trigraph, are written in octal.
std::string literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    char escaped[5];
    std::snprintf(escaped, sizeof escaped, "\\%03o", static_cast<unsigned>(byte));
    const bool is_plain = byte >= 0x20 && byte != 0x7f && c != '"' && c != '\\' && c != '?';
    out += is_plain ? std::string(1, c) : escaped;
  }
  return out + "\"";
}

// The shortest text that reads back to the same bits.
std::string number(double value) {
  char text[32];
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

// "Op::below"
template <class E>
std::string enumerator(const std::string& type, std::span<const std::string_view> names, E value) {
  return type + "::" + std::string(names[static_cast<std::size_t>(value)]);
}

std::string comparison_line(const known::Term& comparison) {
  return "    {" + literal(comparison.name) + ", " +
         enumerator("Quantity", quantity_names(), comparison.quantity) + ", " +
         (comparison.is_mirrored ? "true" : "false") + ", " + enumerator("Op", op_names(), comparison.op) + ", " +
         number(comparison.limit) + ", " + literal(comparison.word) + "},\n";
}

// An array of constants; no line if it is empty, because C++ has no empty arrays.
std::string array(const std::string& type, const std::string& name, const std::string& lines) {
  return lines.empty() ? "" : "inline constexpr " + type + " " + name + "[] = {\n" + lines + "};\n";
}

std::string name_or_nothing(const std::string& name, bool is_there) { return is_there ? name : "{}"; }

// The arrays of one rule, and the line that refers to them.
void add_rule(const known::KnownRule& rule, const std::string& number_text, std::string& arrays, std::string& lines) {
  std::string needs, alls;
  for (const std::string_view name : rule.needs) needs += "    " + literal(name) + ",\n";
  for (std::size_t i = 0; i < rule.any_of.size(); ++i) {
    const std::string name = "kComparisons" + number_text + "_" + std::to_string(i);
    std::string comparisons;
    for (const known::Term& comparison : rule.any_of[i].terms) comparisons += comparison_line(comparison);
    arrays += array("Term", name, comparisons);
    alls += "    {" + name_or_nothing(name, !comparisons.empty()) + "},\n";
  }
  arrays += array("std::string_view", "kNeeds" + number_text, needs);
  arrays += array("All", "kAlls" + number_text, alls);
  lines += "    {" + literal(rule.cause) + ", " + literal(rule.text) + ",\n     " + literal(rule.character) + ", " +
           name_or_nothing("parts::kNeeds" + number_text, !needs.empty()) + ", parts::kAlls" + number_text + ", " +
           number(rule.precision) + ", " + number(rule.recall) + "},\n";
}

}  // namespace

std::string rules_header(const std::vector<Condition>& conditions, const std::string& from) {
  const RuleTable table(conditions);
  std::string arrays, lines;
  for (std::size_t i = 0; i < table.rules().size(); ++i) add_rule(table.rules()[i], std::to_string(i), arrays, lines);
  std::string text = "// Written by contort explain --header: the rules of " + literal(from) + ".\n\n";
  text += std::string(known_header().front().text) + "\nnamespace contort::known {\n\n";
  text += "namespace parts {\n" + arrays + "}  // namespace parts\n\n";
  text += array("KnownRule", "kRuleList", lines);
  text += "inline constexpr std::span<const KnownRule> kRules = " + name_or_nothing("kRuleList", !lines.empty());
  text += ";\n\n";
  return text + "}  // namespace contort::known\n";
}

}  // namespace contort
