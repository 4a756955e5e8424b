#include "generator/intent.h"

#include <algorithm>

#include "generator/actions/hand.h"

namespace contort {

namespace {

IntendedAction intended(const PlannedAction& action) {
  return {action.sequence,   action.clip,  action.action, action.part,     action.named,    action.name,
          action.def->layer, action.start, action.end,    action.blend_in, action.blend_out, action.first_frame,
          action.last_frame};
}

IntendedSequence intended(const PlannedSequence& sequence) {
  IntendedSequence out{sequence.length, {}};
  for (const PlannedClip& clip : sequence.clips) out.clips.push_back({clip.start, clip.end});
  return out;
}

const PlannedAction* planned_of(const Timeline& timeline, const ActionSpan& span) {
  const auto found =
      std::ranges::find_if(timeline.actions, [&](const PlannedAction& action) { return is_of(span, action); });
  return found == timeline.actions.end() ? nullptr : &*found;
}

// The run of the queue in which a span's action moved its part.
const QueueSpan* run_of(const Motion& motion, const ActionSpan& span) {
  const auto found = std::ranges::find_if(motion.queue, [&](const QueueSpan& run) {
    return run.sequence == span.sequence && run.first_frame <= span.first_frame && span.first_frame <= run.last_frame;
  });
  return found == motion.queue.end() ? nullptr : &*found;
}

// The last lag of a part, or of one that hangs on it, in a frame; null where all are where they are wanted.
const Lag* lag_at(const Character& character, std::span<const Lag> lags, int part, int frame) {
  const auto concerns = [&](const Lag& lag) {
    if (frame < lag.first_frame || frame > lag.last_frame) return false;
    int p = lag.part;
    while (p > part) p = carrier_of(character, p);
    return p == part;
  };
  const auto found = std::ranges::find_if(lags, concerns);
  return found == lags.end() ? nullptr : &*found;
}

// Adds the goals of one span of an action, and the frames in which they were not met.
class Goals {
 public:
  Goals(const Stage& stage, const Motion& motion, std::span<const Lag> lags, Intent& out)
      : stage_(stage), motion_(motion), lags_(lags), out_(out) {}

  void add(const ActionSpan& span) {
    const PlannedAction* action = planned_of(stage_.timeline, span);
    const QueueSpan* run = run_of(motion_, span);
    if (action == nullptr || run == nullptr || action->named != span.part) return;
    const Promise promise = action->def->promise;
    if (promise == Promise::arrives) add_arrival(*action, span, *run);
    if (promise == Promise::holds || promise == Promise::aims) add_while_in_force(*action, span, *run);
  }

 private:
  static int content(const QueueSpan& run, int frame) { return run.first_content + frame - run.first_frame; }

  // In the span's last frame, if the action came to its end and does not fade out.
  void add_arrival(const PlannedAction& action, const ActionSpan& span, const QueueSpan& run) {
    const int last = span.last_frame;
    if (content(run, last) < action.last_frame || action.blend_out > 0.0) return;
    if (const Lag* lag = lag_at(*stage_.character, lags_, span.part, last)) {
      out_.unmet.push_back({last, last, span.part, action.name, lag->why});
      return;
    }
    const Part& part = stage_.character->parts()[static_cast<std::size_t>(span.part)];
    const Vec3 target_m(action.params[0], action.params[1], action.params[2]);
    out_.goals.push_back({last, last, span.part, part.reach.front().tip, -1, target_m});
  }

  // In the frames in which the action has come in and does not fade.
  void add_while_in_force(const PlannedAction& action, const ActionSpan& span, const QueueSpan& run) {
    const double came = std::max(action.start, static_cast<double>(run.first_content));
    bool was_held = false, was_unmet = false;
    for (int frame = span.first_frame; frame <= span.last_frame; ++frame) {
      const int now = content(run, frame);
      const bool is_in_force = come_in(action, came, now, frame - span.first_frame, stage_.rate_hz) >= 1.0 &&
                               not_blended_out(action, now) >= 1.0;
      const Lag* lag = is_in_force ? lag_at(*stage_.character, lags_, span.part, frame) : nullptr;
      if (lag != nullptr) add_unmet_frame(action, frame, lag->why, was_unmet);
      const bool is_held = is_in_force && lag == nullptr && action.def->promise == Promise::holds;
      if (is_held) add_held_frame(action, frame, was_held);
      was_held = is_held, was_unmet = lag != nullptr;
    }
  }

  void add_unmet_frame(const PlannedAction& action, int frame, Shortfall why, bool goes_on) {
    if (!goes_on) out_.unmet.push_back({frame, frame, action.named, action.name, why});
    out_.unmet.back().last_frame = frame;
  }

  void add_held_frame(const PlannedAction& action, int frame, bool goes_on) {
    const Part& part = stage_.character->parts()[static_cast<std::size_t>(action.named)];
    const int grip = grip_of(*stage_.character, part), point = static_cast<int>(action.params[0]);
    if (!goes_on) out_.goals.push_back({frame, frame, action.named, grip, point, Vec3(0.0)});
    out_.goals.back().last_frame = frame;
  }

  const Stage& stage_;
  const Motion& motion_;
  std::span<const Lag> lags_;
  Intent& out_;
};

}  // namespace

void say_intent(const Stage& stage, const Motion& motion, std::span<const Lag> lags, Intent& intent) {
  intent.queued = stage.timeline.queued;
  intent.sequences.clear(), intent.actions.clear(), intent.goals.clear(), intent.unmet.clear();
  for (const PlannedSequence& sequence : stage.timeline.sequences) intent.sequences.push_back(intended(sequence));
  for (const PlannedAction& action : stage.timeline.actions) intent.actions.push_back(intended(action));
  Goals goals(stage, motion, lags, intent);
  for (const ActionSpan& span : motion.spans) goals.add(span);
}

Intent intent_of(const Stage& stage, const Motion& motion, std::span<const Lag> lags) {
  Intent intent;
  say_intent(stage, motion, lags, intent);
  return intent;
}

}  // namespace contort
