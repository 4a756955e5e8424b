#include "checks/circumstances.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "checks/plan.h"

namespace contort {

namespace {

constexpr std::array<std::string_view, 6> kPhases = {"impact", "interrupt", "clip_switch",
                                                     "blend",  "mid_clip",  "at_rest"};
constexpr double kImpact_s = 0.5;
constexpr double kInterrupt_s = 0.15;

// Assigns the phases of all frames, from the calmest to the most violent. Each phase overwrites those before.
class PhasePainter {
 public:
  PhasePainter(const Intent& intent, const Motion& motion)
      : intent_(intent),
        motion_(motion),
        phases_(static_cast<std::size_t>(std::max(0, motion.frame_count)), Phase::at_rest) {}

  std::vector<Phase> painted() && {
    for (const ActionSpan& span : motion_.spans) paint(Phase::mid_clip, span.first_frame, span.last_frame);
    for (const IntendedAction& action : intent_.actions)
      for (const ActionSpan& span : motion_.spans)
        if (is_of(span, action)) paint_fades(action, span);
    for (const QueueSpan& span : motion_.queue) paint_switches(span);
    paint_interrupts();
    for (const ImpactMark& mark : motion_.response.impacts)
      paint(Phase::impact, mark.frame, mark.frame + frames(kImpact_s));
    return std::move(phases_);
  }

 private:
  int frames(double time_s) const { return static_cast<int>(time_s * motion_.rate_hz); }

  void paint(Phase phase, int first, int last) {
    for (int f = std::max(0, first); f <= std::min(last, motion_.frame_count - 1); ++f)
      phases_[static_cast<std::size_t>(f)] = phase;
  }

  // The frames of a span in which its action blends in or out.
  void paint_fades(const IntendedAction& action, const ActionSpan& span) {
    for (const QueueSpan& of : motion_.queue) {
      if (of.sequence != action.sequence) continue;
      for (int f = std::max(span.first_frame, of.first_frame); f <= std::min(span.last_frame, of.last_frame); ++f) {
        const double content = of.first_content + f - of.first_frame;
        if (content < action.start + action.blend_in || content > action.end - action.blend_out)
          paint(Phase::blend, f, f);
      }
    }
  }

  void paint_switches(const QueueSpan& span) {
    const auto paint_at = [&](int frame) {
      paint(Phase::clip_switch, std::max(frame, span.first_frame) - 1, std::min(frame, span.last_frame) + 1);
    };
    if (span.first_frame > 0) paint_at(span.first_frame);
    for (const IntendedClip& clip : intent_.sequences[static_cast<std::size_t>(span.sequence)].clips)
      for (const int edge : {clip.start, clip.end}) {
        const int frame = edge - span.first_content + span.first_frame;
        if (edge > 0 && frame >= span.first_frame - 2 && frame <= span.last_frame + 2) paint_at(frame);
      }
  }

  // The frames after an interrupt's sequence begins, and after a sequence that was cut continues or is dropped.
  void paint_interrupts() {
    for (std::size_t i = 0; i < motion_.queue.size(); ++i) {
      const QueueSpan& span = motion_.queue[i];
      const bool interrupts = span.sequence >= intent_.queued || span.first_content > 0;
      const bool after_cut = i > 0 && motion_.queue[i - 1].sequence >= intent_.queued;
      if (interrupts || after_cut) paint(Phase::interrupt, span.first_frame, span.first_frame + frames(kInterrupt_s));
    }
  }

  const Intent& intent_;
  const Motion& motion_;
  std::vector<Phase> phases_;
};

ActiveAction describe(const IntendedAction& action, const Intent& intent, const Character& character) {
  std::string pointer = "/sequences/" + std::to_string(action.sequence);
  if (action.sequence >= intent.queued)
    pointer = "/interrupts/" + std::to_string(action.sequence - intent.queued) + "/sequence";
  pointer += "/clips/" + std::to_string(action.clip) + "/actions/" + std::to_string(action.action);
  return {action.name, character.parts()[static_cast<std::size_t>(action.named)].slot, pointer};
}

std::vector<ActiveAction> active_actions(const Intent& intent, const Character& character, const Motion& motion,
                                         int frame) {
  std::vector<ActiveAction> out;
  for (const IntendedAction& action : intent.actions)
    if (std::ranges::any_of(motion.spans, [&](const ActionSpan& span) {
          return span.first_frame <= frame && frame <= span.last_frame && is_of(span, action);
        }))
      out.push_back(describe(action, intent, character));
  // one use may move several parts
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

std::span<const std::string_view> phase_names() { return kPhases; }

std::string_view phase_name(Phase phase) { return kPhases[static_cast<std::size_t>(phase)]; }

std::vector<Phase> phases_of(const Intent& intent, const Motion& motion) {
  return PhasePainter(intent, motion).painted();
}

Phase phase_of(const Intent& intent, const Motion& motion, int frame) {
  return phases_of(intent, motion)[static_cast<std::size_t>(frame)];
}

Circumstances circumstances_of(const Intent& intent, const Character& character, const Motion& motion, int frame) {
  return {phase_of(intent, motion, frame), active_actions(intent, character, motion, frame)};
}

}  // namespace contort
