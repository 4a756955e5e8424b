#include "fuzz/against_trial.h"

#include <utility>

namespace contort {

AgainstTrial::AgainstTrial(Trial& inner, const Expectation& expect, BaseBuild& base, const CompareRules& rules,
                           std::function<bool()> alive)
    : inner_(inner),
      check_(expect.check),
      subject_(expect.subject),
      is_ending_(is_abnormal_exit(expect)),
      base_(base),
      rules_(rules),
      alive_(std::move(alive)) {}

Measurement AgainstTrial::ask(const Spec& spec, const std::string& check) const {
  MeasureRequest request;
  request.spec = spec, request.check = check;
  base_.ask(request);
  return base_.answer([this] {
    if (alive_) (void)alive_();
  });
}

// The base runs only specs that fail in this build.
TrialResult AgainstTrial::run(const Spec& spec, int most_frames) {
  TrialResult shown = inner_.run(spec, most_frames);
  if (!shown.fails) return shown;
  const Measurement base = ask(spec, is_ending_ ? "" : check_);
  shown.base_hash = base.motion_hash;
  std::optional<BaseShows> shows = BaseShows::passes_check;
  if (!is_ending_) shows = base_shows(shown.depth, check_, subject_, base, rules_);
  shown.fails = !base.refusal && shows.has_value();
  if (shown.fails) shown.base = *shows;
  return shown;
}

std::vector<Case> AgainstTrial::others(const Spec& spec) {
  std::vector<Case> all = inner_.others(spec);
  if (all.empty()) return all;
  const Measurement base = ask(spec, "");
  std::erase_if(all, [&](const Case& other) {
    if (is_abnormal_exit(other.expect)) return base.refusal.has_value();
    return !base_shows(depth_of(other.expect), other.expect.check, other.expect.subject, base, rules_);
  });
  return all;
}

}  // namespace contort
