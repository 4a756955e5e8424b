#include "fuzz/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace contort {

namespace {

using SubjectName = std::pair<std::string, std::string>;  // check and subject

constexpr double kTimesDeeper = 2.0;       // a failure of both builds got worse if it is this many times as deep
constexpr std::size_t kMostRefusal = 500;  // bytes of a reason that are kept
constexpr double kScalesDeeper = 1.0;      // and deeper by at least this many scales of its check

double depth_of_margin(double margin) {
  return std::isfinite(margin) ? -margin : std::numeric_limits<double>::infinity();
}

std::map<SubjectName, double> depths_of(const Measurement& measured, bool with_waived) {
  std::map<SubjectName, double> depths;
  for (const SubjectMargin& finding : measured.findings)
    if (with_waived || !finding.waived) depths[{finding.check, finding.subject}] = depth_of_margin(finding.margin);
  return depths;
}

std::optional<double> find_depth(const std::map<SubjectName, double>& depths, const SubjectName& name) {
  const auto found = depths.find(name);
  return found == depths.end() ? std::nullopt : std::optional(found->second);
}

bool is_compared(const std::string& check, const CompareRules& rules) {
  return std::ranges::find(rules.checks, check) != rules.checks.end();
}

// The first frame that differs. A trace has four digits per frame of a running hash, which stays different after the
// first difference. A shorter motion differs at its end.
int first_different_frame(const std::string& ours, const std::string& base) {
  if (ours.empty() || base.empty() || ours == base) return -1;
  const std::size_t both = std::min(ours.size(), base.size());
  const auto end = ours.begin() + static_cast<std::ptrdiff_t>(both);
  return static_cast<int>((std::mismatch(ours.begin(), end, base.begin()).first - ours.begin()) / 4);
}

}  // namespace

std::string_view base_shows_name(BaseShows shows) {
  switch (shows) {
    case BaseShows::passes_check: return "passes_check";
    case BaseShows::passes: return "passes";
    case BaseShows::milder: return "milder";
  }
  return "";
}

std::optional<Change> change_between(std::optional<double> depth, std::optional<double> base_depth, double tolerance) {
  if (depth && !base_depth) return *depth > tolerance ? std::optional(Change::broke) : std::nullopt;
  if (!depth && base_depth) return *base_depth > tolerance ? std::optional(Change::mended) : std::nullopt;
  if (!depth || std::isinf(*base_depth)) return std::nullopt;
  const bool is_worse = *depth >= kTimesDeeper * *base_depth && *depth >= *base_depth + kScalesDeeper;
  return is_worse ? std::optional(Change::worse) : std::nullopt;
}

std::optional<double> depth_in(const Measurement& measured, const std::string& check, const std::string& subject,
                               bool with_waived) {
  return find_depth(depths_of(measured, with_waived), {check, subject});
}

namespace {

void add_change(Change change, const Family& family, Comparison& comparison) {
  switch (change) {
    case Change::broke: return comparison.broke.push_back(family);
    case Change::worse: return comparison.worse.push_back(family);
    case Change::mended: return comparison.mended.push_back(family);
  }
}

// A failure that a waiver hides in the base still counts there, so it is not new in this build. A failure that is
// hidden in this build does not count in either direction.
void compare_families(const std::string& character, const Measurement& ours, const Measurement& base,
                      const CompareRules& rules, Comparison& comparison) {
  const std::map<SubjectName, double> open = depths_of(ours, false), all = depths_of(ours, true);
  const std::map<SubjectName, double> of_base = depths_of(base, true);
  std::set<SubjectName> names;
  for (const auto* depths : {&all, &of_base})
    for (const auto& [name, depth] : *depths) names.insert(name);
  for (const SubjectName& name : names) {
    const bool is_waived = all.contains(name) && !open.contains(name);
    if (is_waived || !is_compared(name.first, rules)) continue;
    if (const auto change = change_between(find_depth(open, name), find_depth(of_base, name), rules.tolerance))
      add_change(*change, {name.first, character, name.second}, comparison);
  }
}

}  // namespace

Comparison compare(const std::string& character, const Measurement& ours, const Measurement& base,
                   const CompareRules& rules) {
  Comparison comparison;
  if (comparison.refusal = refusal_text(base); !comparison.refusal.empty()) return comparison;
  comparison.base_hash = base.motion_hash;
  comparison.moved = ours.motion_hash != base.motion_hash;
  if (comparison.moved) comparison.first_difference = first_different_frame(ours.trace, base.trace);
  compare_families(character, ours, base, rules, comparison);
  return comparison;
}

std::optional<BaseShows> base_shows(double depth, const std::string& check, const std::string& subject,
                                    const Measurement& base, const CompareRules& rules) {
  if (base.refusal || !is_compared(check, rules)) return std::nullopt;
  const std::optional<Change> change = change_between(depth, depth_in(base, check, subject, true), rules.tolerance);
  if (!change) return std::nullopt;
  if (*change == Change::worse) return BaseShows::milder;
  const bool has_other = std::ranges::any_of(base.findings, [&](const SubjectMargin& f) { return f.check == check; });
  return has_other ? BaseShows::passes : BaseShows::passes_check;
}

std::string refusal_text(const Measurement& base) {
  if (!base.refusal) return "";
  std::string text = to_line(*base.refusal);
  if (text.size() <= kMostRefusal) return text;
  std::size_t end = kMostRefusal;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // does not cut a UTF-8 character
  return text.substr(0, end) + "…";
}

}  // namespace contort
