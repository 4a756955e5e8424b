#include "corpus/sides.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace contort {

namespace {

constexpr std::string_view kLeft = "left", kRight = "right", kAnd = " ~ ";

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Returns true if the word stands at this place by itself: "bright" has no side.
bool has_word_at(std::string_view text, std::size_t at, std::string_view word) {
  if (!text.substr(at).starts_with(word)) return false;
  const std::size_t end = at + word.size();
  return (at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]));
}

std::string exchanged(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool left = has_word_at(text, at, kLeft), right = has_word_at(text, at, kRight);
    out += left ? kRight : right ? kLeft : text.substr(at, 1);
    at += left ? kLeft.size() : right ? kRight.size() : 1;
  }
  return out;
}

}  // namespace

Family other_side(const Family& family) {
  std::string subject = exchanged(family.subject);
  if (const std::size_t between = subject.find(kAnd); between != std::string::npos) {
    const std::string a = subject.substr(0, between), b = subject.substr(between + kAnd.size());
    subject = std::min(a, b) + std::string(kAnd) + std::max(a, b);
  }
  return {family.check, family.character, subject};
}

std::vector<std::vector<std::size_t>> without_sides(const std::vector<Bucket>& buckets) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::pair<Family, std::string>, std::size_t> group_of;
  for (std::size_t i = 0; i < buckets.size(); ++i) {
    const Family& family = buckets[i].family;
    const std::pair key{std::min(family, other_side(family)), buckets[i].features};
    const auto [at, is_new] = group_of.try_emplace(key, groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(i);
  }
  return groups;
}

}  // namespace contort
