#include "checks/circumstances.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace contort {

namespace {

constexpr std::array<std::string_view, 6> kPhases = {"impact", "interrupt", "clip_switch",
                                                     "blend",  "mid_clip",  "at_rest"};
constexpr double kImpact_s = 0.5;
constexpr double kInterrupt_s = 0.15;

class Inquiry {
 public:
  Inquiry(const Timeline& timeline, const Motion& motion, int frame)
      : timeline_(timeline), motion_(motion), frame_(frame), moving_(moving_actions()) {}

  Phase phase() const {
    if (after_blow()) return Phase::impact;
    if (after_interrupt()) return Phase::interrupt;
    if (at_switch()) return Phase::clip_switch;
    if (std::ranges::any_of(moving_, [&](auto* a) { return fades(*a); })) return Phase::blend;
    return moving_.empty() ? Phase::at_rest : Phase::mid_clip;
  }

  std::vector<ActiveAction> actions(const Character& character) const {
    std::vector<ActiveAction> out;
    for (const PlannedAction* action : moving_) out.push_back(describe(*action, character));
    // One use may move several parts.
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

 private:
  bool within(int since, double time_s) const {
    return frame_ >= since && frame_ - since <= static_cast<int>(time_s * motion_.rate_hz);
  }

  std::vector<const PlannedAction*> moving_actions() const {
    std::vector<const PlannedAction*> out;
    for (const PlannedAction& action : timeline_.actions)
      if (std::ranges::any_of(motion_.spans, [&](const ActionSpan& s) {
            return s.first_frame <= frame_ && frame_ <= s.last_frame && s.sequence == action.sequence &&
                   s.clip == action.clip && s.action == action.action && s.part == action.part;
          }))
        out.push_back(&action);
    return out;
  }

  ActiveAction describe(const PlannedAction& action, const Character& character) const {
    std::string pointer = "/sequences/" + std::to_string(action.sequence);
    if (action.sequence >= timeline_.queued)
      pointer = "/interrupts/" + std::to_string(action.sequence - timeline_.queued) + "/sequence";
    pointer += "/clips/" + std::to_string(action.clip) + "/actions/" + std::to_string(action.action);
    return {action.name, character.parts()[static_cast<std::size_t>(action.named)].slot, pointer};
  }

  bool after_blow() const {
    return std::ranges::any_of(motion_.response.impacts,
                               [&](const ImpactMark& m) { return within(m.frame, kImpact_s); });
  }

  // An interrupt's sequence begins, or one that was cut goes on or is dropped for the next.
  bool after_interrupt() const {
    for (std::size_t i = 0; i < motion_.queue.size(); ++i) {
      const QueueSpan& span = motion_.queue[i];
      const bool interrupts = span.sequence >= timeline_.queued || span.first_content > 0;
      const bool after_cut = i > 0 && motion_.queue[i - 1].sequence >= timeline_.queued;
      if ((interrupts || after_cut) && within(span.first_frame, kInterrupt_s)) return true;
    }
    return false;
  }

  bool at_switch() const {
    return std::ranges::any_of(motion_.queue, [&](const QueueSpan& span) {
      if (frame_ < span.first_frame - 1 || frame_ > span.last_frame + 1) return false;
      if (span.first_frame > 0 && std::abs(frame_ - span.first_frame) <= 1) return true;
      const int content = span.first_content + frame_ - span.first_frame;
      const auto near = [&](int edge) { return edge > 0 && std::abs(content - edge) <= 1; };
      return std::ranges::any_of(timeline_.sequences[static_cast<std::size_t>(span.sequence)].clips,
                                 [&](const PlannedClip& clip) { return near(clip.start) || near(clip.end); });
    });
  }

  bool fades(const PlannedAction& action) const {
    return std::ranges::any_of(motion_.queue, [&](const QueueSpan& span) {
      if (span.sequence != action.sequence || frame_ < span.first_frame || frame_ > span.last_frame) return false;
      const double content = span.first_content + frame_ - span.first_frame;
      return content < action.start + action.blend_in || content > action.end - action.blend_out;
    });
  }

  const Timeline& timeline_;
  const Motion& motion_;
  int frame_;
  std::vector<const PlannedAction*> moving_;
};

}  // namespace

std::span<const std::string_view> phase_names() { return kPhases; }

std::string_view phase_name(Phase phase) { return kPhases[static_cast<std::size_t>(phase)]; }

Circumstances circumstances_of(const Stage& stage, const Motion& motion, int frame) {
  const Inquiry inquiry(stage.timeline, motion, frame);
  return {inquiry.phase(), inquiry.actions(*stage.character)};
}

Phase phase_of(const Timeline& timeline, const Motion& motion, int frame) {
  return Inquiry(timeline, motion, frame).phase();
}

}  // namespace contort
