// Finds the findings that waivers hide, and the waivers that hide nothing.
#pragma once

#include <string_view>
#include <vector>

#include "checks/circumstances.h"
#include "checks/fold.h"
#include "checks/settings.h"

namespace contort {

struct WaiverUse {
  int hidden = 0;        // findings
  bool expired = false;  // an expired waiver hides nothing; `hidden` counts the findings that it would have hidden
  bool operator==(const WaiverUse&) const = default;
};

struct Waived {
  std::vector<int> by;          // for each finding: index of the waiver that hides it, or -1
  std::vector<WaiverUse> uses;  // for each waiver
  bool operator==(const Waived&) const = default;
};

// Applies waivers to findings. `phases` has the phase of each finding's worst frame; it is empty for animations made
// elsewhere, which have no phases. `today` is a date such as "2026-11-21". A finding whose margin is NaN is hidden
// only by a waiver without `deepest`.
Waived waive(const std::vector<Waiver>& waivers, const std::vector<Finding>& findings, const std::vector<Phase>& phases,
             std::string_view today);

// Adds the counts of one motion to the total. An empty total counts as zeros.
void add_uses(const std::vector<WaiverUse>& uses, std::vector<WaiverUse>& total);

}  // namespace contort
