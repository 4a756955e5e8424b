#include "fuzz/profile_violations.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "fuzz/compose.h"
#include "fuzz/compose_turns.h"
#include "fuzz/sensible_pose.h"
#include "model/core/index.h"

namespace contort {

namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::ranges::find(names, name) != names.end();
}

// A rule has one limit for all components of a vector, or one for each. NaN stands for a missing value and is never
// outside.
bool is_outside(const DrawRule& rule, const ParamValue& value) {
  const auto beyond = [&](double number, std::size_t i) {
    return number < rule.low[std::min(i, rule.low.size() - 1)] || number > rule.high[std::min(i, rule.high.size() - 1)];
  };
  if (const double* number = std::get_if<double>(&value)) return beyond(*number, 0);
  const Vec3* vector = std::get_if<Vec3>(&value);
  return vector != nullptr && (beyond(vector->x, 0) || beyond(vector->y, 1) || beyond(vector->z, 2));
}

class ProfileViolations {
 public:
  // The character is null if none of the profile's rules needs it.
  ProfileViolations(const Profile& profile, Generator& generator, const Character* character,
                    const Environment& environment)
      : profile_(profile), generator_(generator), character_(character) {
    if (character != nullptr) posed_.emplace(*character, environment);
  }

  int count(const SequenceDesc& sequence) {
    for (const ClipDesc& clip : sequence.clips) {
      if (clip.duration_frames != 0)
        count_if(!profile_.speeds || clip.duration_frames < kShortestStretch || clip.duration_frames > kLongestStretch);
      count_if(!profile_.speeds && clip.speed != 1.0);
      for (const ActionUse& use : clip.actions) count(use);
    }
    if (character_ != nullptr && !profile_.overlaps && is_known_) {
      SequenceDesc in_turns = sequence;
      take_turns(*character_, generator_.offers(*character_), in_turns);
      count_if(in_turns != sequence);
    }
    return count_;
  }

 private:
  void count_if(bool departs) { count_ += departs ? 1 : 0; }

  void count(const ActionUse& use) {
    count_if(!is_among(profile_.actions, use.action) || !is_among(profile_.slots, use.slot) ||
             profile_.never(use.slot, use.action));
    count_if(!profile_.speeds && use.speed != 1.0);
    const OfferedAction* action = nullptr;
    if (character_ != nullptr)
      action = find_offer(generator_.offers(*character_), character_->find_part(use.slot), use.action);
    if (action == nullptr || !action->duration)
      count_if(use.duration_frames < profile_.shortest_frames || use.duration_frames > profile_.longest_frames);
    if (character_ == nullptr) return;
    is_known_ = is_known_ && action != nullptr;
    if (action == nullptr) return;
    count(use, *action);
    const Part& part = character_->parts()[at(character_->find_part(use.slot))];
    if (is_sensible_in(profile_, part, *action)) count_if(!posed_->add(part, action->params, use));
  }

  void count(const ActionUse& use, const OfferedAction& action) {
    const auto rule_for = [&](std::string_view param) { return profile_.rule_for(use.slot, use.action, param); };
    if (const DrawRule* rule = rule_for("blend_in_frames"); rule != nullptr && action.timing == Timing::course)
      count_if(is_outside(*rule, static_cast<double>(use.blend_in_frames)));
    if (const DrawRule* rule = rule_for("blend_out_frames"); rule != nullptr && action.layer != Layer::overwrite)
      count_if(is_outside(*rule, static_cast<double>(use.blend_out_frames)));
    for (const ParamDef& def : action.params) {
      const DrawRule* rule = rule_for(def.name);
      const auto given = use.params.find(def.name);
      const bool is_left_out = def.optional || def.is_characteristic;
      if (rule == nullptr || (given == use.params.end() && is_left_out)) continue;
      count_if(is_outside(*rule, given == use.params.end() ? def.preset : given->second));
    }
  }

  const Profile& profile_;
  Generator& generator_;
  const Character* character_;
  std::optional<PosedFigure> posed_;
  bool is_known_ = true;  // all actions are known, so they can take turns
  int count_ = 0;
};

}  // namespace

int profile_violations(const Spec& spec, const Profile& profile, Generator& generator) {
  const bool asks_character =
      !profile.overlaps || !profile.rules.empty() || !generator.manifest().can.speeds || !profile.wild_poses;
  const Result<Character> character =
      asks_character ? build_character(spec.character, *generator.manifest().library) : Result<Character>(Issue{});
  const Environment environment = beside_rest(spec.environment);
  ProfileViolations found(profile, generator, character ? &*character : nullptr, environment);
  int count = 0;
  for (const SequenceDesc& sequence : spec.sequences) count = found.count(sequence);
  for (const InterruptDesc& interrupt : spec.interrupts) count = found.count(interrupt.sequence);
  return count;
}

std::function<bool(const Spec&)> within(const Profile& profile, const Spec& original, Generator& generator) {
  return [profile, &generator, most = profile_violations(original, profile, generator)](const Spec& spec) {
    return profile_violations(spec, profile, generator) <= most;
  };
}

}  // namespace contort
