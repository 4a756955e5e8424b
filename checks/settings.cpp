#include "checks/settings.h"

#include <algorithm>
#include <array>
#include <limits>

#include "checks/check.h"
#include "checks/circumstances.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"

namespace contort {

namespace {

using json_fields::Text;

constexpr std::array<std::string_view, 2> kUses = {"change", "ignore"};

bool is_digits(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

int number_of(std::string_view digits) {
  int value = 0;
  for (const char c : digits) value = 10 * value + (c - '0');
  return value;
}

int days_of(int year, int month) {
  constexpr std::array<int, 12> kDays = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  return kDays[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap ? 1 : 0);
}

bool is_check(std::string_view name) {
  const auto is_named = [&](const CheckDef& check) { return check.name == name; };
  return std::ranges::any_of(all_checks(), is_named);
}

std::string check_names_text() {
  std::string text;
  for (const CheckDef& check : all_checks()) text += std::string(check.name) + ", ";
  return text;
}

bool is_phase(std::string_view name) {
  return name.empty() || std::ranges::any_of(phase_names(), [&](std::string_view phase) { return phase == name; });
}

template <class Rule>
Result<Done> check_names(const Rule& rule, const std::string& pointer) {
  if (!is_check(rule.check))
    return Issue{"settings.unknown_check", pointer + "/check",
                 "no check is called " + json_fields::quoted(rule.check) + "; `contort list checks` names them" +
                     did_you_mean(rule.check, check_names_text())};
  if (!is_phase(rule.phase))
    return Issue{"settings.unknown_phase", pointer + "/phase", "no phase is called " + json_fields::quoted(rule.phase)};
  return Done{};
}

}  // namespace

template <class V>
void fields(V& v, const LimitRule*) {
  v.field("check", &LimitRule::check, {.required = true}, "Name of a check.");
  v.field("subject", &LimitRule::subject, {.text = Text::label},
          "Pattern of the subjects; * stands for any characters.");
  v.field("phase", &LimitRule::phase, {.may_be_empty = true}, "Phase in which the limit applies; empty: every phase.");
  v.field("use", &LimitRule::use, {.names = kUses}, "change: move the limit; ignore: judge nothing.");
  v.field("tolerance", &LimitRule::tolerance, {.low = -1e6, .high = 1e6},
          "For change: number that is added to margins, in the check's unit; a negative one is stricter.");
  v.field("reason", &LimitRule::reason, {.text = Text::prose, .required = true}, "Reason for the change.");
}

template <class V>
void fields(V& v, const Waiver*) {
  v.field("check", &Waiver::check, {.required = true}, "Name of a check.");
  v.field("subject", &Waiver::subject, {.text = Text::label}, "Pattern of the subjects; * stands for any characters.");
  v.field("phase", &Waiver::phase, {.may_be_empty = true}, "Phase of the worst frame; empty: any.");
  v.field("deepest", &Waiver::deepest, {.low = 0, .high = 1e6},
          "Greatest depth that is hidden, in the check's unit; 0: every depth.");
  v.field("reason", &Waiver::reason, {.text = Text::prose, .required = true}, "Reason for hiding the finding.");
  v.field("owner", &Waiver::owner, {.text = Text::label, .required = true},
          "Person who is responsible for the waiver.");
  v.field("expires", &Waiver::expires, {.text = Text::label, .required = true}, "Last day, YYYY-MM-DD.");
}

template <class V>
void fields(V& v, const CheckSettings*) {
  v.constant("format", "contort.settings/1");
  v.field("collision_band_m", &CheckSettings::collision_band_m, {.low = 0.001, .high = 10},
          "Distance up to which clearances are measured.");
  v.field("merge_gap_frames", &CheckSettings::merge_gap_frames, {.low = 0, .high = 600},
          "Safe frames between two violations that do not split a finding.");
  v.field("limits", &CheckSettings::limits, {.max_count = 1000}, "Limits that are moved or switched off.");
  v.field("waivers", &CheckSettings::waivers, {.max_count = 1000}, "Findings that are hidden for a time.");
}

bool is_day(std::string_view text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const std::string_view year = text.substr(0, 4), month = text.substr(5, 2), day = text.substr(8, 2);
  if (!is_digits(year) || !is_digits(month) || !is_digits(day)) return false;
  const int m = number_of(month), d = number_of(day);
  return m >= 1 && m <= 12 && d >= 1 && d <= days_of(number_of(year), m);
}

Result<CheckSettings> parse_settings(std::string_view text) {
  Result<CheckSettings> settings = json_fields::read_document<CheckSettings>(text, "settings");
  if (!settings) return settings;
  for (std::size_t i = 0; i < settings->limits.size(); ++i)
    if (const Result<Done> known = check_names(settings->limits[i], "/limits/" + std::to_string(i)); !known)
      return known.issue();
  for (std::size_t i = 0; i < settings->waivers.size(); ++i) {
    const std::string pointer = "/waivers/" + std::to_string(i);
    if (const Result<Done> known = check_names(settings->waivers[i], pointer); !known) return known.issue();
    if (!is_day(settings->waivers[i].expires))
      return Issue{"settings.no_day", pointer + "/expires",
                   json_fields::quoted(settings->waivers[i].expires) + " is not a date; write YYYY-MM-DD"};
  }
  return settings;
}

std::string settings_schema() { return json_fields::write_schema<CheckSettings>("Contort check settings"); }

double tolerance_of(const LimitRule& rule) {
  return rule.use == LimitUse::ignore ? std::numeric_limits<double>::infinity() : rule.tolerance;
}

double tolerance_of(const CheckSettings& settings, std::string_view check, std::string_view subject) {
  double tolerance = 0.0;
  for (const LimitRule& rule : settings.limits)
    if (rule.check == check && rule.phase.empty() && matches(rule.subject, subject)) tolerance = tolerance_of(rule);
  return tolerance;
}

// Backtracks to the last star only: linear for common patterns, quadratic at worst.
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, resumed = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, resumed = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1, t = ++resumed;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace contort
