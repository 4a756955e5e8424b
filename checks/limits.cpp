#include "checks/limits.h"

#include <algorithm>

#include "checks/circumstances.h"

namespace contort {

void apply_limits(const CheckDef& check, const CheckInput& in, MarginFold& fold) {
  std::vector<LimitRule> rules = in.settings.limits;
  std::erase_if(rules, [&](const LimitRule& rule) {
    return rule.check != check.name || (in.intent == nullptr && !rule.phase.empty());
  });
  if (rules.empty()) return;
  const bool has_phases = std::ranges::any_of(rules, [](const LimitRule& rule) { return !rule.phase.empty(); });
  const std::size_t phase_count = has_phases ? phase_names().size() : 1;
  const int subjects = check.subject_count(in.character);
  std::vector<double> tolerances(static_cast<std::size_t>(subjects) * phase_count, 0.0);
  for (int s = 0; s < subjects; ++s) {
    const std::string name = check.subject(in.character, s).name;
    for (const LimitRule& rule : rules)
      for (std::size_t p = 0; matches(rule.subject, name) && p < phase_count; ++p)
        if (rule.phase.empty() || rule.phase == phase_names()[p])
          tolerances[static_cast<std::size_t>(s) * phase_count + p] = tolerance_of(rule);
  }
  std::vector<std::uint8_t> phases;
  if (has_phases)
    for (const Phase phase : phases_of(*in.intent, in.motion)) phases.push_back(static_cast<std::uint8_t>(phase));
  fold.tolerate(std::move(tolerances), std::move(phases), static_cast<int>(phase_count));
}

}  // namespace contort
