#include "corpus/refusals.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "model/generator.h"

namespace contort {

namespace {

constexpr std::size_t kMostReasons = 100;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// "the angle -57.25 is too large" and "the angle 3e-05 is too large" become "the angle # is too large". A digit inside
// a word, as in "arm2", belongs to the name.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const bool follows_word = i > 0 && is_of_word(text[i - 1]);
    const std::size_t digits = text[i] == '-' || text[i] == '+' ? i + 1 : i;
    if (follows_word || digits >= text.size() || !is_digit(text[digits])) {
      out += text[i++];
      continue;
    }
    i = text.find_first_not_of("0123456789.eE+-", digits);
    if (i == std::string::npos) i = text.size();
    while (i > digits + 1 && !is_digit(text[i - 1])) --i;
    out += '#';
  }
  return out;
}

}  // namespace

std::string reason_of(const Issue& refusal) {
  if (refusal.code != kRefusedCode) return to_line(refusal);
  return refusal.text.starts_with(kRefusedText) ? refusal.text.substr(kRefusedText.size()) : refusal.text;
}

void count_refusal(const std::string& reason, std::int64_t index, RefusalCounts& counts) {
  add_refusals({{without_numbers(reason), {1, index, reason}}}, counts);
}

void add_refusals(const RefusalCounts& from, RefusalCounts& sum) {
  for (const auto& [reason, count] : from) {
    const auto known = sum.find(reason);
    if (known == sum.end() && sum.size() >= kMostReasons) continue;
    RefusalCount& all = known != sum.end() ? known->second : sum[reason];
    if (all.cases == 0 || count.first_index < all.first_index)
      all.first_index = count.first_index, all.text = count.text;
    all.cases += count.cases;
  }
}

std::vector<RefusalCount> by_frequency(const RefusalCounts& counts) {
  std::vector<RefusalCount> rows;
  for (const auto& [reason, count] : counts) rows.push_back(count);
  std::ranges::stable_sort(rows, std::ranges::greater(), &RefusalCount::cases);
  return rows;
}

std::vector<std::string> refusal_lines(const RefusalCounts& counts, std::int64_t refused, std::int64_t motions,
                                       std::size_t most) {
  const auto line = [&](std::int64_t cases, const std::string& why) {
    return "refused: " + std::to_string(cases) + " of " + std::to_string(motions) + " motions: " + why;
  };
  std::vector<std::string> lines;
  for (const RefusalCount& count : by_frequency(counts)) {
    if (lines.size() == most) break;
    lines.push_back(line(count.cases, count.text));
    refused -= count.cases;
  }
  if (refused > 0) lines.push_back(line(refused, "for other reasons"));
  return lines;
}

}  // namespace contort
