#include "formats/table/root_columns.h"

#include <algorithm>
#include <string>
#include <vector>

#include "formats/table/cells.h"

namespace contort {

namespace {

constexpr std::string_view kBreaks = " _-./[]()";
constexpr std::string_view kRootWords[] = {"root", "base", "pelvis", "hips", "pose", "freejoint"};
constexpr std::string_view kWordsBeside[] = {"field", "floating", "free", "joint", "link", "robot", "state", "world", "odom"};
constexpr std::string_view kPositionWords[] = {"position", "pos", "p", "translation", "trans", "t", "xyz"};
constexpr std::string_view kRotationWords[] = {"orientation", "orient", "quaternion", "quat", "q", "rotation", "rot"};

template <std::size_t n>
bool is_among(const std::string_view (&words)[n], std::string_view word) {
  return std::ranges::find(words, word) != std::end(words);
}

std::vector<std::string> words_of(std::string_view name) {
  const std::string low = in_lower_case(name);
  std::vector<std::string> words;
  for (std::size_t begin = low.find_first_not_of(kBreaks); begin != low.npos;) {
    const std::size_t end = std::min(low.find_first_of(kBreaks, begin), low.size());
    words.push_back(low.substr(begin, end - begin));
    begin = low.find_first_not_of(kBreaks, end);
  }
  return words;
}

// Splits off an axis that is written together with the quantity: "tx", "posx", "qw" and "quatw".
bool part_axis(std::vector<std::string>& words) {
  if (words.empty()) return false;
  const std::string last = words.back();
  if (last.empty() || std::string_view("xyzw").find(last.back()) == std::string_view::npos) return false;
  words.back().pop_back();
  if (words.back().empty()) words.pop_back();
  words.emplace_back(1, last.back());
  return true;
}

bool are_of_root(const std::vector<std::string>& words) {
  const auto is_root = [](const std::string& word) { return is_among(kRootWords, word); };
  return std::ranges::any_of(words, is_root) &&
         std::ranges::all_of(words, [&](const std::string& word) { return is_root(word) || is_among(kWordsBeside, word); });
}

}  // namespace

std::optional<RootNumber> root_number_of(std::string_view column) {
  std::vector<std::string> words = words_of(column);
  if (!part_axis(words)) return std::nullopt;
  const char axis = words.back().front();
  words.pop_back();
  const bool is_rotation = !words.empty() && is_among(kRotationWords, words.back());
  const bool is_position = !words.empty() && is_among(kPositionWords, words.back());
  if (is_rotation || is_position) words.pop_back();
  if (!are_of_root(words) || (axis == 'w' && !is_rotation)) return std::nullopt;
  const int number = axis == 'w' ? 3 : axis - 'x';
  return static_cast<RootNumber>(is_rotation ? number + 3 : number);
}

}  // namespace contort
