#include "generator/intent.h"

#include <algorithm>

#include "generator/actions/hand.h"

namespace contort {

namespace {

IntendedAction intended(const PlannedAction& action) {
  return {action.sequence,    action.clip,        action.action, action.part,
          action.named,       action.name,        action.def->layer, action.start,
          action.end,         std::max(0.0, action.blend_in), action.blend_out, action.first_frame,
          action.last_frame,   action.further >= 0};
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

bool has_span(const Motion& motion, const PlannedAction& action) {
  return std::ranges::any_of(motion.spans, [&](const ActionSpan& span) { return is_of(span, action); });
}

// The lag of a part, or of one of its limb, in a frame; null where all are where they are wanted. Parts that hang on a
// trunk have wishes of their own.
const Lag* lag_at(const Character& character, std::span<const Lag> lags, int part, int frame) {
  const auto concerns = [&](const Lag& lag) {
    if (frame < lag.first_frame || frame > lag.last_frame) return false;
    int p = lag.part;
    while (part > 0 && p > part && !is_trunk(character, part)) p = carrier_of(character, p);
    return p == part;
  };
  const auto found = std::ranges::find_if(lags, concerns);
  return found == lags.end() ? nullptr : &*found;
}

// Adds the goals of one span of an action, and the frames in which they were not met.
class Goals {
 public:
  Goals(const Stage& stage, const Motion& motion, const RuleRunner& rules, std::span<const Lag> lags, Intent& out)
      : stage_(stage), motion_(motion), rules_(rules), lags_(lags), out_(out) {}

  void add(const ActionSpan& span) {
    const PlannedAction* action = planned_of(stage_.timeline, span);
    const QueueSpan* run = run_of(motion_, span);
    if (action == nullptr || run == nullptr || action->named != span.part) return;
    const Promise promise = action->def->promise;
    if (promise == Promise::arrives) add_arrival(*action, span, *run);
    if (promise == Promise::none && action->def->timing == Timing::goal)
      add_unmet_end(*action, span, *run);
    const bool is_told = action->def->layer == Layer::ik || action->script != nullptr;
    if (action->def->timing == Timing::course && is_told) add_while_in_force(*action, span);
  }

 private:
  static int content(const QueueSpan& run, int frame) { return run.first_content + frame - run.first_frame; }

  // Returns true if the action ends in the last frame of the span, without fading out.
  static bool is_ended(const PlannedAction& action, const ActionSpan& span, const QueueSpan& run) {
    return content(run, span.last_frame) >= action.last_frame && !(action.blend_out > 0.0);
  }

  // Adds an unmet request if the part lags in the last frame of an action that ended. Returns true if it lags.
  bool add_unmet_end(const PlannedAction& action, const ActionSpan& span, const QueueSpan& run) {
    const int last = span.last_frame;
    if (!is_ended(action, span, run)) return false;
    const Lag* lag = lag_at(*stage_.character, lags_, span.part, last);
    if (lag != nullptr && lag->why) out_.unmet.push_back({last, last, span.part, action.name, *lag->why});
    return lag != nullptr;
  }

  void add_arrival(const PlannedAction& action, const ActionSpan& span, const QueueSpan& run) {
    if (!is_ended(action, span, run) || add_unmet_end(action, span, run)) return;
    const int last = span.last_frame;
    const Part& part = stage_.character->parts()[static_cast<std::size_t>(span.part)];
    const std::span<const double> params = rules_.last_params(action);
    const Vec3 target_m(params[0], params[1], params[2]);
    out_.goals.push_back({last, last, span.part, part.reach.front().tip, -1, target_m});
  }

  // In the frames in which the action has come in and does not fade.
  void add_while_in_force(const PlannedAction& action, const ActionSpan& span) {
    bool was_held = false, was_unmet = false;
    for (int frame = span.first_frame; frame <= span.last_frame; ++frame) {
      const Lag* lag = lag_at(*stage_.character, lags_, span.part, frame);
      const bool is_unmet = lag != nullptr && lag->why.has_value();
      if (is_unmet) add_unmet_frame(action, frame, *lag->why, was_unmet);
      const bool is_held = lag == nullptr && action.def->promise == Promise::holds;
      if (is_held) add_held_frame(action, frame, was_held);
      was_held = is_held, was_unmet = is_unmet;
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
  const RuleRunner& rules_;
  std::span<const Lag> lags_;
  Intent& out_;
};

}  // namespace

void say_intent(const Stage& stage, const Motion& motion, const RuleRunner& rules, std::span<const Lag> lags,
                Intent& intent) {
  intent.queued = stage.timeline.queued;
  intent.sequences.clear(), intent.actions.clear(), intent.goals.clear(), intent.unmet.clear();
  for (const PlannedSequence& sequence : stage.timeline.sequences) intent.sequences.push_back(intended(sequence));
  for (const PlannedAction& action : stage.timeline.actions)
    if (action.further < 0 || has_span(motion, action)) intent.actions.push_back(intended(action));
  Goals goals(stage, motion, rules, lags, intent);
  for (const ActionSpan& span : motion.spans) goals.add(span);
}

}  // namespace contort
