// Settings of the checks, as a file has them: limits that are moved or switched off, and waivers of findings that
// somebody has accepted for a time. A moved limit changes how the check judges. A waiver does not: the check runs as
// usual, and the waiver hides its findings until the waiver's last day. Both are reported.
//
//   {"format": "contort.settings/1",
//    "limits": [{"check": "joint_range", "subject": "arm_*/elbow max", "tolerance": 0.05, "reason": "soft stop"}],
//    "waivers": [{"check": "self_collision", "subject": "* ~ torso/chest", "phase": "impact", "reason": "ticket 12",
//                 "owner": "ana", "expires": "2027-03-01"}]}
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/result.h"

namespace contort {

enum class LimitUse { change, ignore };

// A rule that changes or ignores the limits of the matching subjects. If several rules match a subject, the last one
// counts.
struct LimitRule {
  std::string check;          // "joint_range"
  std::string subject = "*";  // "*" is any run of characters
  std::string phase;          // "impact"; empty: in every phase
  LimitUse use = LimitUse::change;
  double tolerance = 0.0;  // change: added to margins, in their unit; below 0 is stricter
  std::string reason;
  bool operator==(const LimitRule&) const = default;
};

struct Waiver {
  std::string check;
  std::string subject = "*";
  std::string phase;     // phase of the worst frame; empty: any
  double deepest = 0.0;  // the depth up to which findings are hidden, in the unit of their margins; 0: any depth
  std::string reason;
  std::string owner;
  std::string expires;  // "2027-03-01": the last day
  bool operator==(const Waiver&) const = default;
};

struct CheckSettings {
  double collision_band_m = 0.1;  // Clearances are measured up to this; bodies that are farther apart are not reported.
  int merge_gap_frames = 2;       // Safe frames between two violations that do not split a finding.
  std::vector<LimitRule> limits;
  std::vector<Waiver> waivers;
  // "2026-11-21", not in the file: the day on which waivers are judged; empty: no waiver has expired.
  std::string today;
  bool operator==(const CheckSettings&) const = default;
};

// Parses a settings file. Codes json.* and settings.*, for unknown fields, checks and phases, and for invalid dates.
Result<CheckSettings> parse_settings(std::string_view text);
std::string settings_schema();

// The tolerance that a rule adds to margins; infinite if the rule ignores the subject.
double tolerance_of(const LimitRule& rule);

// The tolerance that rules without a phase add to a subject's margins: 0 if no rule matches, infinite if it is
// ignored.
double tolerance_of(const CheckSettings& settings, std::string_view check, std::string_view subject);

// Returns true if the text is a calendar date, YYYY-MM-DD.
bool is_day(std::string_view text);

// Returns true if the text matches the pattern, in which "*" is any run of characters.
bool matches(std::string_view pattern, std::string_view text);

}  // namespace contort
