#include "checks/family.h"

#include <algorithm>

namespace contort {

namespace {

constexpr char kSeparator = '|';

// In the text a separator follows each name. It sorts after every letter of a name, so if one name begins with the
// other, the longer one is less.
std::strong_ordering compare_names(const std::string& left, const std::string& right) {
  const std::size_t both = std::min(left.size(), right.size());
  if (const int order = left.compare(0, both, right, 0, both); order != 0) return order <=> 0;
  return right.size() <=> left.size();
}

}  // namespace

std::strong_ordering Family::operator<=>(const Family& other) const {
  if (const auto order = compare_names(check, other.check); order != 0) return order;
  if (const auto order = compare_names(character, other.character); order != 0) return order;
  return subject.compare(other.subject) <=> 0;
}

std::string print_family(const Family& family) {
  if (family.empty()) return "";
  return family.check + kSeparator + family.character + kSeparator + family.subject;
}

std::optional<Family> parse_family(std::string_view text) {
  const std::size_t first = text.find(kSeparator);
  const std::size_t second = first == std::string_view::npos ? first : text.find(kSeparator, first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  Family family{std::string(text.substr(0, first)), std::string(text.substr(first + 1, second - first - 1)),
                std::string(text.substr(second + 1))};
  if (family.check.empty() || family.character.empty() || family.subject.empty()) return std::nullopt;
  return family;
}

}  // namespace contort
