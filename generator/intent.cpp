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

// `at_end`: in the span's last frame, if the action came to its end and does not fade out.
void add_at_end(const Stage& stage, const PlannedAction& action, const ActionSpan& span, const QueueSpan& run,
                Intent& out) {
  const int content = run.first_content + span.last_frame - run.first_frame;
  if (content < action.last_frame || action.blend_out > 0.0) return;
  const Part& part = stage.character->parts()[static_cast<std::size_t>(span.part)];
  const Vec3 target_m(action.params[0], action.params[1], action.params[2]);
  out.goals.push_back({span.last_frame, span.last_frame, span.part, part.reach.front().tip, -1, target_m});
}

// In the frames in which the action has come in and does not fade.
void add_while_in_force(const Stage& stage, const PlannedAction& action, const ActionSpan& span, const QueueSpan& run,
                        Intent& out) {
  const Part& part = stage.character->parts()[static_cast<std::size_t>(span.part)];
  const double came = std::max(action.start, static_cast<double>(run.first_content));
  Goal goal{0, -1, span.part, grip_of(*stage.character, part), static_cast<int>(action.params[0]), Vec3(0.0)};
  for (int frame = span.first_frame; frame <= span.last_frame; ++frame) {
    const int content = run.first_content + frame - run.first_frame;
    if (come_in(action, came, content, frame - span.first_frame, stage.rate_hz) < 1.0) continue;
    if (not_blended_out(action, content) < 1.0) continue;
    if (goal.last_frame < 0) goal.first_frame = frame;
    goal.last_frame = frame;
  }
  if (goal.last_frame >= 0) out.goals.push_back(goal);
}

void add_goals(const Stage& stage, const Motion& motion, const ActionSpan& span, Intent& out) {
  const PlannedAction* action = planned_of(stage.timeline, span);
  const QueueSpan* run = run_of(motion, span);
  if (action == nullptr || run == nullptr || action->named != span.part) return;
  if (action->def->promise == Promise::arrives) add_at_end(stage, *action, span, *run, out);
  if (action->def->promise == Promise::holds) add_while_in_force(stage, *action, span, *run, out);
}

}  // namespace

void say_intent(const Stage& stage, const Motion& motion, Intent& intent) {
  intent.queued = stage.timeline.queued;
  intent.sequences.clear(), intent.actions.clear(), intent.goals.clear();
  for (const PlannedSequence& sequence : stage.timeline.sequences) intent.sequences.push_back(intended(sequence));
  for (const PlannedAction& action : stage.timeline.actions) intent.actions.push_back(intended(action));
  for (const ActionSpan& span : motion.spans) add_goals(stage, motion, span, intent);
}

Intent intent_of(const Stage& stage, const Motion& motion) {
  Intent intent;
  say_intent(stage, motion, intent);
  return intent;
}

}  // namespace contort
