#include "generator/layer_stack.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace contort {

namespace {

// Among the actions that move a part now, the one that began last, if that was after what had the layer before. One
// that begins in this very frame has to wait for the next one where another has moved already. Actions of the spec come
// before those that were acquired.
LayerHold next_hold(const Playback& playback, const LayerHold& held, Layer layer, std::size_t part) {
  LayerHold best;
  double best_began = 0.0;
  playback.for_each(part, layer, 0, [&](int run, int action) {
    if (!playback.moves(playback.action(action), playback.run(run))) return;
    const double began = playback.began(playback.action(action), playback.run(run));
    if (began < held.since || (began == held.since && action < held.since_action)) return;
    const bool moved = began < playback.frame(), best_moved = best_began < playback.frame();
    const bool helps = playback.action(action).further >= 0;
    const bool best_helps = best.action >= 0 && playback.action(best.action).further >= 0;
    if (best.action >= 0 && (helps != best_helps ? helps : moved != best_moved ? !moved : began < best_began)) return;
    best.action = action, best.run = run;
    best_began = began;
  });
  best.since = best.action >= 0 ? best_began : held.since;
  best.since_action = best.action >= 0 ? best.action : held.since_action;
  return best;
}

// The action by which the course of legs that the root follows moves another part; none if there is no such course.
LayerHold course_of(const Playback& playback, const LayerHold& root, const LayerHold& held, std::size_t part) {
  LayerHold course;
  if (part == 0 || root.action < 0 || !moves_legs(playback, root)) return course;
  playback.for_each(part, Layer::ik, 0, [&](int run, int action) {
    if (run == root.run && playback.action(action).use == planned(playback, root).use) course.action = action;
  });
  course.run = root.run;
  course.since = held.since, course.since_action = course.action;
  return course;
}

// A leg's own action that fades out while a course goes on has nothing to fade to but the course.
bool gives_way(const Playback& playback, const LayerHold& hold) {
  return hold.action < 0 || (!moves_legs(playback, hold) && left_of(playback, hold) < 1.0);
}

bool is_same(const LayerHold& a, const LayerHold& b) { return a.action == b.action && a.run == b.run; }

// The easing that an action had reached a frame ago, [0, 1].
double eased_before(const Playback& playback, const LayerHold& hold) {
  return blended_in(planned(playback, hold), hold.came, content(playback, hold) - 1);
}

// Returns true if the posture of an action that has lost its layer still was in force in the frame before.
bool was_in_force(const Playback& playback, const LayerHold& hold, std::size_t part) {
  return places_foot(playback, hold, part) ||
         not_blended_out(planned(playback, hold), content(playback, hold) - 1) > 0.0;
}

double come_in_at_ease(int held_frames, int blend_frames) {
  if (blend_frames < 0 || (held_frames <= 0 && blend_frames > 0)) return 0.0;
  return held_frames < blend_frames ? ease(static_cast<double>(held_frames) / blend_frames) : 1.0;
}

}  // namespace

const PlannedAction& planned(const Playback& playback, const LayerHold& hold) { return playback.action(hold.action); }

int content(const Playback& playback, const LayerHold& hold) { return playback.content(playback.run(hold.run)); }

double come_in(const Playback& playback, const LayerHold& hold) {
  if (hold.blend_frames >= 0 || takes_its_time(planned(playback, hold)))
    return come_in_at_ease(playback.frame() - hold.frame, hold.blend_frames);
  return come_in(planned(playback, hold), hold.came, content(playback, hold), playback.frame() - hold.frame,
                 playback.rate_hz());
}

double left_of(const Playback& playback, const LayerHold& hold) {
  const PlannedAction& action = planned(playback, hold);
  if (hold.fade_frames < 0) return not_blended_out(action, content(playback, hold));
  const double left = (action.end - content(playback, hold)) / hold.fade_frames;
  return left < 1.0 ? ease(std::max(0.0, left)) : 1.0;
}

double covered(const Playback& playback, const LayerHold& hold) {
  const double left = 1.0 - hold.eased;
  return left > 1e-9 ? (come_in(playback, hold) - hold.eased) / left : 1.0;
}

bool moves_legs(const Playback& playback, const LayerHold& hold) {
  return planned(playback, hold).def->spread == Spread::legs;
}

bool is_cut(const Playback& playback, const LayerHold& hold) {
  return hold.action >= 0 && planned(playback, hold).cuts && playback.frame() <= hold.frame + 1;
}

bool places_foot(const Playback& playback, const LayerHold& hold, std::size_t part) {
  return moves_legs(playback, hold) && part != 0 && (hold.eased >= 1.0 || come_in(playback, hold) >= 1.0);
}

LayerStack::Change LayerStack::advance(const Playback& playback, std::size_t part, const LayerHold& root) {
  LayerHold ik = next_hold(playback, ik_, Layer::ik, part);
  const LayerHold course = course_of(playback, root, ik_, part);
  Change change;
  if (course.action >= 0 && gives_way(playback, ik)) {
    ik = course;
    change.returns = !is_same(ik, ik_);
  }
  // An action that begins in this frame has moved nothing yet: the one before it ends as if none followed.
  change.ik_follows = ik_.action >= 0 && ik.action >= 0 && ik.since < playback.frame();
  change.settles = ik_.action >= 0 && ik.action != ik_.action && !change.ik_follows &&
                   was_in_force(playback, ik_, part);
  if (change.settles && overwrite_.action >= 0) overwrite_.eased = eased_before(playback, overwrite_);
  const LayerHold overwrite = next_hold(playback, overwrite_, Layer::overwrite, part);
  change.overwrite_begins = take_over(playback, part, overwrite, overwrite_);
  change.ik_begins = take_over(playback, part, ik, ik_);
  change.returns |= change.ik_begins && comes_to_course(playback, part);
  if (change.returns) ik_.eased = 1.0, ik_.blend_frames = 0;
  change.ik_restarts = restart(playback) && !change.ik_begins;
  return change;
}

bool LayerStack::restart(const Playback& playback) {
  const bool is_due = std::exchange(restarts_, false) && ik_.action >= 0;
  if (!is_due) return false;
  ik_.frame = playback.frame(), ik_.came = content(playback, ik_);
  ik_.eased = 0.0, ik_.blend_frames = -1;
  ++ik_.restarts;
  return true;
}

// Gives a layer to the action that has it now; true if that begins.
bool LayerStack::take_over(const Playback& playback, std::size_t part, const LayerHold& next, LayerHold& hold) const {
  if (is_same(next, hold)) return false;
  LayerHold taken = next;
  if (next.action >= 0) {
    const PlannedAction& action = planned(playback, next);
    taken.frame = playback.frame();
    taken.came = playback.comes(action, playback.run(next.run));
    taken.eased = action.def->timing == Timing::goal ? eased_before(playback, taken)
                                                     : static_cast<double>(stands_for(playback, next, part));
    // An action that had to wait for a frame does not jump by what it would have come in meanwhile.
    if (moves_legs(playback, next) && action.blend_in > 0.0 && content(playback, next) > taken.came)
      taken.blend_frames = static_cast<int>(std::ceil(action.blend_in));
  }
  hold = taken;
  return next.action >= 0;
}

// Returns true if the action that has just taken the layer ik is a course of legs, and finds the leg or foot elsewhere.
bool LayerStack::comes_to_course(const Playback& playback, std::size_t part) const {
  return part != 0 && moves_legs(playback, ik_) && !planned(playback, ik_).cuts && ik_.eased < 1.0;
}

// Returns true if a leg or foot is where the last course of legs put it. No action that blends its joints has moved it
// since.
bool LayerStack::stands_for(const Playback& playback, const LayerHold& next, std::size_t part) const {
  return moves_legs(playback, next) && part != 0 && overwrite_.since_action < 0 &&
         (ik_.since_action < 0 || playback.action(ik_.since_action).def->spread == Spread::legs);
}

}  // namespace contort
