#include "model/core/nearest.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace contort {

namespace {

constexpr std::size_t kLongestWord = 64;  // names from files may be megabytes

bool is_same(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

std::string_view unquoted(std::string_view name) {
  const bool is_quoted = name.size() > 1 && name.front() == '"' && name.back() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

}  // namespace

int letters_apart(std::string_view a, std::string_view b) {
  // Optimal string alignment. The rows of the table are for the first i - 2, i - 1 and i letters of a.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last), last.swap(row);
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (is_same(a[i - 1], b[j - 1]) ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && is_same(a[i - 1], b[j - 2]) && is_same(a[i - 2], b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest(std::string_view word, std::span<const std::string> known) {
  std::string best;
  int least = 1 << 20;
  if (word.empty() || word.size() > kLongestWord) return best;
  for (const std::string& one : known) {
    if (one.size() > kLongestWord) continue;
    const int apart = letters_apart(word, one);
    const int allowed = std::max(1, static_cast<int>(std::max(word.size(), one.size())) / 3);
    if (apart < least && apart <= allowed && apart < static_cast<int>(one.size())) best = one, least = apart;
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::string_view names) {
  std::vector<std::string> known;
  while (!names.empty()) {
    const std::size_t comma = std::min(names.find(", "), names.size());
    known.emplace_back(unquoted(names.substr(0, comma)));
    names.remove_prefix(std::min(comma + 2, names.size()));
  }
  const std::string meant = nearest(word, known);
  return meant.empty() ? "" : "; did you mean \"" + meant + "\"?";
}

}  // namespace contort
