#include "generator/generate.h"

#include <algorithm>

#include "generator/actions/hand.h"
#include "generator/happened.h"
#include "generator/motion/blend.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/root_blend.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

using Hold = GenerateScratch::Hold;

constexpr double kCutFade_s = 0.15;  // of an additive that an interrupt cuts

class Generation {
 public:
  Generation(const Stage& stage, GenerateScratch& scratch, Motion& motion)
      : stage_(stage), timeline_(stage.timeline), character_(*stage.character), s_(scratch), motion_(motion) {}

  void run() {
    prepare();
    for (int frame = 0; frame < stage_.most_frames && !finished(frame); ++frame) make_frame(frame);
    motion_.coords.resize(static_cast<std::size_t>(motion_.frame_count) *
                          static_cast<std::size_t>(motion_.coord_count));
    motion_.root.resize(static_cast<std::size_t>(motion_.frame_count));
    motion_.queue.assign(s_.queue.history().begin(), s_.queue.history().end());
  }

 private:
  void prepare() {
    const auto frames = static_cast<std::size_t>(stage_.most_frames);
    motion_.rate_hz = stage_.rate_hz;
    motion_.frame_count = 0;
    motion_.coord_count = character_.coord_count();
    motion_.coords.resize(frames * static_cast<std::size_t>(character_.coord_count()));
    motion_.root.resize(frames);
    motion_.spans.clear();
    motion_.aims.clear();
    // Every action may be cut once by every interrupt.
    motion_.spans.reserve(timeline_.actions.size() * (1 + timeline_.interrupts.size()));
    s_.queue.start(timeline_.sequences, timeline_.interrupts, timeline_.queued);
    s_.signals.assign(timeline_.interrupts.size(), 0);
    s_.stacks.assign(character_.parts().size(), {});
    s_.feedback.assign(character_.parts().size(), {});
    s_.additive_spans.assign(timeline_.actions.size(), -1);
    s_.aim_spans.assign(timeline_.actions.size(), -1);
    s_.added.assign(character_.parts().size(), 0);
    s_.world.resize(character_.joints().size());
    s_.bodies.assign(static_cast<std::size_t>(timeline_.use_count), {});
    s_.base.coords.assign(character_.rest_coords().begin(), character_.rest_coords().end());
    s_.base.root = stage_.start * character_.rest_root();
    s_.stands_at = stage_.start;
    stand_up();
    s_.plain = s_.from_overwrite = s_.from_ik = s_.target = s_.shown = s_.base;
  }

  // At rest on level ground; elsewhere hips and feet fit themselves to what is beneath.
  void stand_up() {
    const Vec3& at = stage_.start.p_m;
    Gait gait;
    gait.begin(character_, stage_.legs, stage_.environment, stage_.start, {});
    soles_ = gait.first_soles();
    if ((stage_.environment.is_level() && !stage_.bends) || stage_.legs.empty()) {
      s_.base.root.p_m.y += stage_.environment.height_at(at.x, at.z);
      return;
    }
    const GaitFrame frame = gait.stand(0.0);
    s_.base.root = frame.root;
    forward_kinematics(character_, s_.base.root, s_.base.coords, s_.world);
    for (std::size_t i = 0; i < stage_.legs.size(); ++i)
      place_foot(character_, stage_.legs[i], s_.world, frame.feet[i].world_from_sole, s_.base.coords);
  }

  // The queue ran dry hold_frames ago.
  bool finished(int frame) const {
    if (frame == 0 || !s_.queue.idle()) return false;
    const std::span<const QueueSpan> history = s_.queue.history();
    return frame > (history.empty() ? 0 : history.back().last_frame) + stage_.hold_frames;
  }

  void make_frame(int frame) {
    frame_ = frame;
    s_.queue.advance(frame, s_.signals);
    std::ranges::fill(s_.feedback, Feedback{}), std::ranges::fill(s_.added, 0);
    for (const int p : timeline_.part_order) move_part(static_cast<std::size_t>(p));
    for (std::size_t p = 0; p < s_.stacks.size(); ++p) mark_aim(p);
    signal();
    std::copy(s_.shown.coords.begin(), s_.shown.coords.end(), motion_.row(frame).begin());
    motion_.root[static_cast<std::size_t>(frame)] = s_.shown.root;
    motion_.frame_count = frame + 1;
  }

  // Tells the queue what happened in this frame; it hears of it in the next one.
  void signal() {
    for (std::size_t i = 0; i < timeline_.interrupts.size(); ++i) {
      const PlannedInterrupt& interrupt = timeline_.interrupts[i];
      if (PlayQueue::knows(interrupt.when.event)) continue;
      s_.signals[i] = happened(interrupt, stage_, s_.feedback, s_.shown.root);
    }
  }

  void move_part(std::size_t p) {
    GenerateScratch::Stack& stack = s_.stacks[p];
    const Hold ik = winner(stack.ik, Layer::ik, p);
    // One that starts in this frame has moved nothing yet: what had the layer ends as if nobody came.
    const bool follows = stack.ik.action >= 0 && ik.action >= 0 && ik.since < frame_;
    if (stack.ik.action >= 0 && ik.action != stack.ik.action && !follows &&
        (places_foot(stack.ik, p) || not_blended_out(planned(stack.ik), content(run_of(stack.ik), frame_ - 1)) > 0.0))
      settle(p, stack.overwrite);
    take_over(stack.overwrite, winner(stack.overwrite, Layer::overwrite, p), p, s_.base, s_.from_overwrite);
    if (stack.overwrite.action >= 0) move(p, stack.overwrite, s_.from_overwrite, s_.from_overwrite, s_.base);
    take_over(stack.ik, ik, p, follows ? s_.plain : s_.base, s_.from_ik);
    if (stack.ik.action >= 0) {
      move(p, stack.ik, s_.from_ik, s_.base, s_.plain);
      if (p == 0 && places_legs(stack.ik)) remember_place(body_of(stack.ik).frame);
      fade(p, stack.ik);
    } else {
      copy_part(character_, p, s_.base, s_.plain);
    }
    copy_part(character_, p, s_.plain, s_.shown);
    add_additives(p);
    place(p, s_.shown);
  }

  // ---- who has a layer

  const PlannedAction& planned(const Hold& hold) const {
    return timeline_.actions[static_cast<std::size_t>(hold.action)];
  }
  const QueueSpan& run_of(const Hold& hold) const {
    return s_.queue.history()[static_cast<std::size_t>(hold.run)];
  }
  // The frame of its own sequence.
  static int content(const QueueSpan& run, int frame) { return run.first_content + frame - run.first_frame; }
  int content(const Hold& hold) const { return content(run_of(hold), frame_); }

  // When an action began to move, on the motion's time line: at its start, or when its sequence went on.
  static double began(const PlannedAction& action, const QueueSpan& run) {
    const double own = std::max(action.start, static_cast<double>(run.first_content));
    return own - run.first_content + run.first_frame;
  }

  // Whether the action moves its part in this frame of a run.
  bool moves(const PlannedAction& action, const QueueSpan& run) const {
    const int now = content(run, frame_);
    return now >= action.first_frame && now <= action.last_frame;
  }

  // Calls visit(run index, action index) for the actions of a layer that move a part now. Runs overlap in one frame.
  template <class Visit>
  void for_moving(std::size_t p, Layer layer, Visit visit) const {
    const std::span<const QueueSpan> history = s_.queue.history();
    std::size_t first = history.size();
    while (first > 0 && history[first - 1].last_frame >= frame_) --first;
    for (std::size_t r = first; r < history.size(); ++r)
      for (const int a : timeline_.of_part[static_cast<std::size_t>(history[r].sequence) * character_.parts().size() + p])
        if (timeline_.actions[static_cast<std::size_t>(a)].def->layer == layer &&
            moves(timeline_.actions[static_cast<std::size_t>(a)], history[r]))
          visit(static_cast<int>(r), a);
  }

  // The one that started last and did so after what had the layer before. Who starts in this very frame comes after
  // those that have moved already.
  Hold winner(const Hold& held, Layer layer, std::size_t p) const {
    Hold best;
    double best_began = 0.0;
    for_moving(p, layer, [&](int run, int action) {
      const double start = began(timeline_.actions[static_cast<std::size_t>(action)],
                                 s_.queue.history()[static_cast<std::size_t>(run)]);
      if (start < held.since || (start == held.since && action < held.since_action)) return;
      const bool moved = start < frame_, best_moved = best_began < frame_;
      if (best.action >= 0 && (moved != best_moved ? !moved : start < best_began)) return;
      best.action = action, best.run = run;
      best_began = start;
    });
    best.since = best.action >= 0 ? best_began : held.since;
    best.since_action = best.action >= 0 ? best.action : held.since_action;
    return best;
  }

  // Gives the layer to whom it belongs now; a new one starts from the present posture.
  void take_over(Hold& hold, Hold next, std::size_t p, const Posture& present, Posture& from) {
    if (next.action == hold.action && next.run == hold.run) {
      if (hold.action >= 0) motion_.spans[static_cast<std::size_t>(hold.span)].last_frame = frame_;
      return;
    }
    if (next.action >= 0) begin(next, p, present, from);
    hold = next;
  }

  void begin(Hold& hold, std::size_t p, const Posture& present, Posture& from) {
    copy_part(character_, p, present, from);
    const PlannedAction& action = planned(hold);
    hold.came = std::max(action.start, static_cast<double>(run_of(hold).first_content));
    hold.eased = action.def->timing == Timing::goal ? blended_in(action, hold.came, content(hold) - 1)
                                                    : static_cast<double>(stands_for(hold, p));
    if (p == 0 && places_legs(hold)) s_.bodies[static_cast<std::size_t>(action.use)].seen_soles = soles_;
    hold.span = add_span(action);
    hold.frame = frame_;
  }

  int add_span(const PlannedAction& action) {
    motion_.spans.push_back({frame_, frame_, action.sequence, action.clip, action.action, action.part});
    return static_cast<int>(motion_.spans.size()) - 1;
  }

  // An ik action has ended: what it reached is the base now, and an overwrite beneath goes on from there.
  void settle(std::size_t p, Hold& overwrite) {
    copy_part(character_, p, s_.plain, s_.base);
    if (p == 0) base_stands_at_ = s_.stands_at;
    if (overwrite.action < 0) return;
    copy_part(character_, p, s_.plain, s_.from_overwrite);
    overwrite.eased = blended_in(planned(overwrite), overwrite.came, content(overwrite) - 1);
  }

  // ---- what it does

  ActionTime time_of(const PlannedAction& action, double came, int content_frame) const {
    const double duration_s = (action.end - action.start) / action.scale / stage_.rate_hz;
    const double u = progress(action, content_frame);
    const double missed_s =
        std::min(duration_s, action.speed * (came - action.start) / action.scale / stage_.rate_hz);
    return {u, u * duration_s, duration_s, u * duration_s - missed_s, duration_s - missed_s};
  }

  void apply(const PlannedAction& action, std::size_t p, const Posture& from, double came, int took_over,
             double came_in, int content_frame) {
    const Part& part = character_.parts()[p];
    if (action.def->layer != Layer::overwrite) place(p, s_.target);  // a chain may hang on a joint of its own part
    const ActionTime time = time_of(action, came, content_frame);
    action.def->rule({character_, part, action.params, s_.world, time, stage_.start, stage_.environment, stage_.legs,
                      s_.stands_at, action.aim.get(), action.keys.get(), action.easy_grip_m, from, frame_, took_over,
                      came_in, s_.bodies[static_cast<std::size_t>(action.use)], s_.feedback[p]},
                     s_.target);
  }

  // out = from `from` towards what the rule makes of `beneath`.
  void move(std::size_t p, const Hold& hold, const Posture& from, const Posture& beneath, Posture& out) {
    copy_part(character_, p, beneath, s_.target);
    const double eased = come_in(hold);
    apply(planned(hold), p, from, hold.came, hold.frame, eased, content(hold));
    const double left = 1.0 - hold.eased;
    const double weight = left > 1e-9 ? (eased - hold.eased) / left : 1.0;
    blend(p, hold, from, s_.target, weight, out);
  }

  int frames_of(double seconds) const { return std::max(1, static_cast<int>(seconds * stage_.rate_hz)); }

  double come_in(const Hold& hold) const {
    return contort::come_in(planned(hold), hold.came, content(hold), frame_ - hold.frame, stage_.rate_hz);
  }

  // Legs under a root that blends put their feet where they belong: blended angles would have them slide.
  bool places_foot(const Hold& hold, std::size_t p) const {
    return places_legs(hold) && p != 0 && hold.eased >= 1.0;
  }
  bool places_legs(const Hold& hold) const { return planned(hold).def->spread == Spread::legs; }

  void fade(std::size_t p, const Hold& hold) {
    if (places_foot(hold, p)) return;
    const double left = not_blended_out(planned(hold), content(hold));
    if (places_legs(hold) && left < 1.0) bring_base_along();
    blend(p, hold, s_.base, s_.plain, left, s_.plain);
  }

  void blend(std::size_t p, const Hold& hold, const Posture& a, const Posture& b, double weight, Posture& out) const {
    const Rigid root = b.root;  // out may be b
    blend_part(character_, p, a, b, weight, out);
    if (p == 0 && places_legs(hold)) out.root = blend_root(below(), a.root, root, weight);
  }

  // Whether a leg or foot is where the last course of legs put it. No action that blends its joints has moved it since.
  bool stands_for(const Hold& next, std::size_t p) const {
    const GenerateScratch::Stack& stack = s_.stacks[p];
    const int last = stack.ik.since_action;
    return places_legs(next) && p != 0 && stack.overwrite.since_action < 0 &&
           (last < 0 || timeline_.actions[static_cast<std::size_t>(last)].def->spread == Spread::legs);
  }

  void remember_place(const GaitFrame& frame) {
    s_.stands_at = frame.stands_at;
    for (std::size_t i = 0; i < stage_.legs.size(); ++i) soles_[i] = frame.feet[i].world_from_sole;
  }

  // Who has gone somewhere stays there: what is faded to comes along.
  void bring_base_along() {
    s_.base.root = brought_along(below(), s_.base.root, base_stands_at_, s_.stands_at);
    base_stands_at_ = s_.stands_at;
  }
  const WholeBody& body_of(const Hold& hold) const { return s_.bodies[static_cast<std::size_t>(planned(hold).use)]; }

  LegsBelow below() const { return {character_, stage_.legs, stage_.environment}; }


  // An additive that is cut would be gone from one frame to the next: it runs on while it fades, and fades in again where
  // it goes on.
  void add_additives(std::size_t p) {
    const int fade = frames_of(kCutFade_s);
    const std::span<const QueueSpan> history = s_.queue.history();
    std::size_t first = history.size();
    while (first > 0 && history[first - 1].last_frame >= frame_ - fade) --first;
    for (std::size_t r = first; r < history.size(); ++r)
      for (const int a : timeline_.of_part[static_cast<std::size_t>(history[r].sequence) * character_.parts().size() + p])
        if (timeline_.actions[static_cast<std::size_t>(a)].def->layer == Layer::additive)
          add(p, a, history[r], fade);
  }

  void add(std::size_t p, int index, const QueueSpan& run, int fade) {
    const PlannedAction& action = timeline_.actions[static_cast<std::size_t>(index)];
    const int now = content(run, frame_);
    const bool over = frame_ > run.last_frame && content(run, run.last_frame) >= action.last_frame;
    const bool begun = content(run, std::min(frame_, run.last_frame)) >= action.first_frame;
    if (over || !begun || now > action.last_frame) return;
    double weight = blended_in(action, action.start, now) * not_blended_out(action, now);
    if (frame_ > run.last_frame) weight *= 1.0 - ease(static_cast<double>(frame_ - run.last_frame) / fade);
    if (run.first_content > action.first_frame) weight *= ease(static_cast<double>(frame_ - run.first_frame) / fade);
    mark_additive(index, action);
    s_.added[p] = 1;
    copy_part(character_, p, s_.shown, s_.target);
    apply(action, p, s_.shown, action.start, frame_, 1.0, now);
    blend_part(character_, p, s_.shown, s_.target, weight, s_.shown);
  }

  // Whether the use that aims is all that moves a part. Parts before it in the chain are not its own.
  bool is_alone(const PlannedAction& aim, std::size_t p) const {
    const Hold& ik = s_.stacks[p].ik;
    return ik.action >= 0 && planned(ik).use == aim.use && s_.added[p] == 0;
  }

  void mark_aim(std::size_t p) {
    const Hold& hold = s_.stacks[p].ik;
    if (hold.action < 0 || planned(hold).aim == nullptr || planned(hold).named != static_cast<int>(p)) return;
    const PlannedAction& action = planned(hold);
    const int now = content(hold);
    bool full = come_in(hold) >= 1.0 && not_blended_out(action, now) >= 1.0 && frame_ > hold.frame;
    for (const int j : action.aim->chain.joints)
      full = full && is_alone(action, static_cast<std::size_t>(character_.joints()[static_cast<std::size_t>(j)].part));
    if (!full) return;
    int& span = s_.aim_spans[static_cast<std::size_t>(hold.action)];
    if (span < 0 || motion_.aims[static_cast<std::size_t>(span)].last_frame < frame_ - 1) {
      span = static_cast<int>(motion_.aims.size());
      const Vec3 target(action.params[1], action.params[2], action.params[3]);
      motion_.aims.push_back({frame_, frame_, action.aim->chain.socket, stage_.start * target});
    }
    motion_.aims[static_cast<std::size_t>(span)].last_frame = frame_;
  }

  // One span for as long as it adds without a break.
  void mark_additive(int index, const PlannedAction& action) {
    int& span = s_.additive_spans[static_cast<std::size_t>(index)];
    if (span < 0 || motion_.spans[static_cast<std::size_t>(span)].last_frame < frame_ - 1) span = add_span(action);
    motion_.spans[static_cast<std::size_t>(span)].last_frame = frame_;
  }

  // World transforms of a part's own joints.
  void place(std::size_t p, const Posture& posture) {
    const Part& part = character_.parts()[p];
    if (p == 0) s_.world[0] = posture.root;
    forward_kinematics(character_, posture.coords, part.first_joint, part.first_joint + part.joint_count, s_.world);
  }

  const Stage& stage_;
  const Timeline& timeline_;
  const Character& character_;
  GenerateScratch& s_;
  Motion& motion_;
  int frame_ = 0;
  std::array<Rigid, kMaxLegs> soles_;    // where legs have put the feet
  Rigid base_stands_at_ = stage_.start;  // where legs had carried the character when the base's root was made
};

}  // namespace

void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion) {
  if (stage.recorded)
    motion = *stage.recorded;
  else
    Generation(stage, scratch, motion).run();
  motion.response = {};
  if (stage.dynamics) simulate(*stage.character, *stage.dynamics, stage.environment, scratch.simulation, motion);
}

Motion generate(const Stage& stage) {
  GenerateScratch scratch;
  Motion motion;
  generate(stage, scratch, motion);
  return motion;
}

}  // namespace contort
