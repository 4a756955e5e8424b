#include "renders/variety.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace contort {
namespace {

constexpr double kCheckWeight = 0.30, kSubjectWeight = 0.25, kActionsWeight = 0.20, kPhaseWeight = 0.15,
                 kCharacterWeight = 0.10;
constexpr std::size_t kMostFamilies = 200;  // greatest number of families that are sorted by variety

// Traits with a number for each word, because comparing texts for a million pairs would take seconds.
struct Coded {
  int check = 0, phase = 0, character = 0;
  std::vector<int> subject, actions;  // ascending, without repetition
};

class Coder {
 public:
  Coded code(const FailureTraits& traits) {
    return {number(traits.check), number(traits.phase), number(traits.character), set(words_of(traits.subject)),
            set(traits.actions)};
  }

 private:
  int number(const std::string& word) {
    return numbers_.try_emplace(word, static_cast<int>(numbers_.size())).first->second;
  }

  std::vector<int> set(const std::vector<std::string>& words) {
    std::vector<int> out;
    for (const std::string& word : words) out.push_back(number(word));
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  // The words of a subject: "arm_left", "forearm", "torso", "chest" for "arm_left/forearm ~ torso/chest".
  static std::vector<std::string> words_of(const std::string& subject) {
    std::vector<std::string> words(1);
    for (const char c : subject)
      if (c != ' ' && c != '/' && c != '~' && c != ':')
        words.back() += c;
      else if (!words.back().empty())
        words.emplace_back();
    if (words.back().empty()) words.pop_back();
    return words;
  }

  std::map<std::string, int> numbers_;
};

// Jaccard's distance, a metric of sets: the fraction of all words that only one of the sets has.
double set_distance(const std::vector<int>& a, const std::vector<int>& b) {
  std::size_t common = 0;
  for (auto l = a.begin(), r = b.begin(); l != a.end() && r != b.end();) {
    common += *l == *r;
    const bool left = *l <= *r, right = *r <= *l;
    l += left, r += right;
  }
  const std::size_t all = a.size() + b.size() - common;
  return all == 0 ? 0.0 : 1.0 - static_cast<double>(common) / static_cast<double>(all);
}

double distance(const Coded& a, const Coded& b) {
  return kCheckWeight * (a.check != b.check) + kSubjectWeight * set_distance(a.subject, b.subject) +
         kActionsWeight * set_distance(a.actions, b.actions) + kPhaseWeight * (a.phase != b.phase) +
         kCharacterWeight * (a.character != b.character);
}

// NaN comes last.
bool deeper(const FailureTraits& a, const FailureTraits& b) {
  const double left = std::isnan(a.depth) ? -1.0 : a.depth, right = std::isnan(b.depth) ? -1.0 : b.depth;
  return left != right ? left > right : a.name < b.name;
}

// Returns 0 for rows that gate, 1 for others that need attention, 2 for the rest.
int group_of(const ReportRow& row) {
  if (row.gating) return 0;
  return row.state == "new" || row.state == "open" || row.state == "regressed" ? 1 : 2;
}

FailureTraits traits_of(const ReportRow& row) {
  return {row.check, row.subject, row.phase, row.character, row.actions, row.depth, row.key};
}

using Rows = std::vector<ReportRow>;  // the rows of one family

// Sorts rows that gate first, then by depth. The first row represents the family.
std::vector<Rows> families_of(std::vector<ReportRow>& rows) {
  std::vector<Rows> families;
  std::map<std::string, std::size_t> index;
  for (ReportRow& row : rows) {
    const auto [at, is_new] = index.try_emplace(row.family, families.size());
    if (is_new) families.emplace_back();
    families[at->second].push_back(std::move(row));
  }
  for (Rows& family : families)
    std::stable_sort(family.begin(), family.end(), [](const ReportRow& a, const ReportRow& b) {
      return group_of(a) != group_of(b) ? group_of(a) < group_of(b) : deeper(traits_of(a), traits_of(b));
    });
  return families;
}

}  // namespace

double distance(const FailureTraits& a, const FailureTraits& b) {
  Coder coder;
  const Coded left = coder.code(a);
  return distance(left, coder.code(b));
}

std::vector<std::size_t> furthest_first(std::span<const FailureTraits> all, std::size_t most) {
  // Sorted by depth first, so that ties go to the deeper failure.
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return deeper(all[a], all[b]); });
  Coder coder;
  std::vector<Coded> coded;
  for (const FailureTraits& traits : all) coded.push_back(coder.code(traits));

  std::vector<double> nearest(all.size(), 2.0);  // distance of each failure to the nearest one before it
  for (std::size_t done = 0; done < std::min(most, order.size()); ++done) {
    std::size_t next = done;
    for (std::size_t i = done; i < order.size(); ++i)
      if (nearest[order[i]] > nearest[order[next]]) next = i;
    std::rotate(order.begin() + static_cast<std::ptrdiff_t>(done), order.begin() + static_cast<std::ptrdiff_t>(next),
                order.begin() + static_cast<std::ptrdiff_t>(next) + 1);
    for (std::size_t i = done + 1; i < order.size(); ++i)
      nearest[order[i]] = std::min(nearest[order[i]], distance(coded[order[i]], coded[order[done]]));
  }
  return order;
}

void order_rows(std::vector<ReportRow>& rows) {
  std::vector<Rows> families = families_of(rows);
  rows.clear();
  for (int group = 0; group < 3; ++group) {
    std::vector<std::size_t> members;
    std::vector<FailureTraits> traits;
    for (std::size_t f = 0; f < families.size(); ++f) {
      if (families[f].empty() || group_of(families[f].front()) != group) continue;
      members.push_back(f), traits.push_back(traits_of(families[f].front()));
    }
    for (const std::size_t i : furthest_first(traits, kMostFamilies))
      for (ReportRow& row : families[members[i]]) rows.push_back(std::move(row));
    for (const std::size_t f : members) families[f].clear();
  }
}

}  // namespace contort
