#include "checks/waive.h"

#include <algorithm>

namespace contort {

namespace {

bool is_meant(const Waiver& waiver, const Finding& finding, std::string_view phase) {
  if (waiver.check != finding.check || !matches(waiver.subject, finding.subject)) return false;
  if (!waiver.phase.empty() && waiver.phase != phase) return false;
  return !(waiver.deepest > 0.0) || finding.worst_margin >= -waiver.deepest;
}

}  // namespace

Waived waive(const std::vector<Waiver>& waivers, const std::vector<Finding>& findings, const std::vector<Phase>& phases,
             std::string_view today) {
  Waived out{std::vector<int>(findings.size(), -1), std::vector<WaiverUse>(waivers.size())};
  for (std::size_t w = 0; w < waivers.size(); ++w) {
    out.uses[w].expired = !today.empty() && waivers[w].expires < today;  // dates compare like texts
    for (std::size_t f = 0; f < findings.size(); ++f) {
      const std::string_view phase = phases.empty() ? std::string_view() : phase_name(phases[f]);
      if (out.by[f] >= 0 || !is_meant(waivers[w], findings[f], phase)) continue;
      ++out.uses[w].hidden;
      if (!out.uses[w].expired) out.by[f] = static_cast<int>(w);
    }
  }
  return out;
}

void add_uses(const std::vector<WaiverUse>& uses, std::vector<WaiverUse>& total) {
  total.resize(std::max(total.size(), uses.size()));
  for (std::size_t w = 0; w < uses.size(); ++w) {
    total[w].hidden += uses[w].hidden;
    total[w].expired = uses[w].expired;
  }
}

}  // namespace contort
