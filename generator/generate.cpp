#include "generator/generate.h"

#include <algorithm>
#include <cmath>

#include "generator/additive.h"
#include "generator/condition.h"
#include "generator/limb_keeper.h"
#include "generator/motion/arm_swing.h"
#include "generator/motion/blend.h"
#include "generator/motion/way.h"
#include "generator/promise_watch.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kGoesOn_s = 0.15;  // the time for which legs are assumed to keep their speed before they go home

class Generation {
 public:
  Generation(const Stage& stage, GenerateScratch& scratch, Motion& motion)
      : stage_(stage), timeline_(stage.timeline), character_(*stage.character), s_(scratch), motion_(motion) {}

  void run() {
    prepare();
    for (int frame = 0; frame < stage_.most_frames && !finished(frame); ++frame) make_frame(frame);
    size_motion(motion_.frame_count);
    motion_.queue.assign(s_.queue.history().begin(), s_.queue.history().end());
    if (stage_.level.sequence >= 0)
      motion_.first_frame = s_.level.has_begun() ? s_.level.first_frame() : motion_.frame_count - 1;
  }

 private:
  void size_motion(int frames) {
    motion_.coords.resize(at(frames) * at(motion_.coord_count));
    motion_.root.resize(at(frames));
  }

  void prepare() {
    motion_.rate_hz = stage_.rate_hz, motion_.frame_count = motion_.first_frame = 0;
    motion_.coord_count = character_.coord_count();
    size_motion(stage_.most_frames);
    s_.spans.begin(timeline_, motion_);
    s_.queue.start(timeline_.sequences, timeline_.interrupts, queued());
    s_.level.begin(stage_.level);
    s_.signals.assign(timeline_.interrupts.size(), 0);
    s_.stacks.assign(character_.parts().size(), {});
    s_.added.assign(character_.parts().size(), 0);
    s_.behind.assign(character_.parts().size(), 0);
    s_.held_off.assign(character_.parts().size(), 0);
    s_.stuck.assign(character_.parts().size(), 0);
    s_.squeezes.assign(character_.parts().size(), 0);
    s_.had_room.assign(character_.parts().size(), 0);
    s_.settled.assign(character_.parts().size(), 0);
    s_.returns.assign(character_.parts().size(), 0);
    s_.rests.assign(character_.parts().size(), 0);
    s_.free_arm.assign(character_.parts().size(), 0);
    for (int p = 1; p < static_cast<int>(s_.free_arm.size()); ++p)
      s_.free_arm[at(p)] = is_free_arm(character_, stage_.legs, p);
    s_.shift.assign(character_.parts().size(), Shift::none), s_.shift_count = 0;
    s_.legs_taken = -1;
    s_.rest_world.resize(character_.joints().size());
    stand_up();
  }

  void stand_up() {
    Posture& start = s_.postures.base;
    start.coords.assign(character_.rest_coords().begin(), character_.rest_coords().end());
    start.root = stage_.start * character_.rest_root();
    s_.rules.begin(stage_);
    s_.further.begin(stage_);
    s_.carry.begin(stage_, s_.rules.world(), start);
    s_.rules.start_from(start);
    s_.postures.start_from(start);
    s_.path.begin(character_, start.coords, stage_.rate_hz, easy());
    s_.clearance.begin(character_, s_.rules.room());
    s_.past.before = s_.past.earlier = start;
    s_.wanted = s_.between = s_.rested = start;
    s_.past.frame_s = 1.0 / stage_.rate_hz, s_.past.easy = easy();
  }

  // The accelerations that joints of a figure with mass may have; empty without mass.
  std::span<const double> easy() const {
    return stage_.dynamics ? std::span<const double>(stage_.dynamics->easy) : std::span<const double>();
  }

  // Sequences after the one that is played alone are left out.
  int queued() const {
    const bool ends_before = stage_.level.sequence >= 0 && stage_.level.sequence < timeline_.queued;
    return ends_before ? stage_.level.sequence + 1 : timeline_.queued;
  }

  // The queue ran dry, or the level was over, hold_frames ago.
  bool finished(int frame) const {
    if (s_.level.is_over()) return frame > s_.level.last_frame() + stage_.hold_frames;
    if (frame == 0 || !s_.queue.idle()) return false;
    const std::span<const QueueSpan> history = s_.queue.history();
    return frame > (history.empty() ? 0 : history.back().last_frame) + stage_.hold_frames;
  }

  void make_frame(int frame) {
    s_.queue.advance(frame, s_.signals);
    s_.level.advance(frame, s_.queue.history());
    if (s_.level.has_begun()) s_.queue.leave_out_interrupts();
    const Playback playback(timeline_, s_.queue.history(), s_.level, s_.further.acquired(), stage_.rate_hz, frame);
    s_.rules.begin_frame(), std::ranges::fill(s_.added, 0);
    for (const int p : timeline_.part_order) move_part(playback, at(p));
    remember_soles(playback);
    LimbKeeper(stage_, s_).note_feet(playback);
    for (std::size_t p = 0; p < s_.stacks.size(); ++p) {
      if (s_.added[p] == 0 && is_on_its_way(p)) s_.spans.linger(frame, static_cast<int>(p), linger_frames());
      PromiseWatch(stage_, s_).note(playback, p);
      s_.further.ask(playback, p, s_.stacks, s_.rules, s_.postures.shown.root);
    }
    signal();
    std::ranges::copy(s_.postures.shown.coords, motion_.row(frame).begin());
    motion_.root[at(frame)] = s_.postures.shown.root;
    std::swap(s_.past.earlier, s_.past.before);
    s_.past.before.coords = s_.postures.shown.coords;
    motion_.frame_count = frame + 1;
  }

  // Held back by its joints' speeds, or kept clear of bodies or of the ground.
  bool is_on_its_way(std::size_t p) const {
    return s_.behind[p] != 0 || s_.shift[p] == Shift::lifted || s_.shift[p] == Shift::held_off ||
           s_.shift[p] == Shift::over_feet;
  }
  int linger_frames() const { return static_cast<int>(std::ceil(0.5 * stage_.rate_hz)); }

  // Tells the queue what happened in this frame; it hears of it in the next one.
  void signal() {
    for (std::size_t i = 0; i < timeline_.interrupts.size(); ++i) {
      const PlannedInterrupt& interrupt = timeline_.interrupts[i];
      if (PlayQueue::knows(interrupt.when.event)) continue;
      s_.signals[i] = condition_holds(interrupt, stage_, s_.rules.feedback(), s_.postures.shown.root);
    }
  }

  void move_part(const Playback& playback, std::size_t p) {
    LayerPostures& layers = s_.postures;
    LayerStack& stack = s_.stacks[p];
    const LayerStack::Change change = stack.advance(playback, p, s_.stacks[0].ik());
    if (change.returns) s_.returns[p] = 1;
    if (change.settles) settle(p);
    if (change.overwrite_begins) begin(playback, stack.overwrite(), p, layers.base, layers.from_overwrite);
    if (stack.overwrite().action >= 0) overwrite(playback, p, change.overwrite_begins);
    LimbKeeper(stage_, s_).rest(p);
    const Posture& present = change.ik_follows || change.ik_restarts ? seen(p) : beneath(p);
    if (change.ik_begins || change.ik_restarts) begin(playback, stack.ik(), p, present, layers.from_ik);
    if (stack.ik().action >= 0)
      solve_ik(playback, p, change);
    else
      copy_part(character_, p, beneath(p), layers.plain);
    copy_part(character_, p, layers.plain, layers.shown);
    if (s_.free_arm[p] != 0 && stack.ik().action < 0 && stack.overwrite().action < 0) swing(playback, p);
    add_additives(playback, p);
    follow(playback, p);
    s_.rules.place(p, layers.shown);
    if (p != 0 && at(limb_at(p).parts.back()) == p) LimbKeeper(stage_, s_).finish(playback, limb_at(p));
  }

  // The posture to which the actions of the other layers add, and to which they fade.
  const Posture& beneath(std::size_t p) const { return s_.rests[p] != 0 ? s_.postures.stand : s_.postures.base; }

  // Arms that have nothing to do swing with the gait.
  void swing(const Playback& playback, std::size_t p) {
    const LayerHold& gait = s_.stacks[0].ik();
    if (gait.action < 0 || !moves_legs(playback, gait)) return;
    ArmSwing swing = s_.rules.body(planned(playback, gait)).frame.arms[character_.parts()[p].side == Side::left ? 0 : 1];
    const double share = come_in(playback, gait) * left_of(playback, gait);
    swing.forward_rad *= share, swing.out_rad *= share, swing.elbow_rad *= share;
    if (swing == ArmSwing{}) return;
    s_.rules.place(p, s_.postures.shown);
    swing_arm(character_, static_cast<int>(p), swing, s_.rules.world(), s_.postures.shown);
  }

  const Limb& limb_at(std::size_t p) const { return s_.rules.room().limb_of(p); }

  // A part's posture with ik in the frame before, without additives.
  const Posture& seen(std::size_t p) const {
    const bool is_elsewhere = s_.shift[p] != Shift::none && s_.returns[p] == 0;
    return is_elsewhere ? s_.past.before : s_.postures.plain;
  }

  // An ik action has ended: the base is what it reached.
  void settle(std::size_t p) {
    if (p == 0) s_.carry.settle(s_.postures.base.root, seen(p).root);
    copy_part(character_, p, seen(p), s_.postures.base);
    copy_part(character_, p, seen(p), s_.postures.from_overwrite);
    s_.settled[p] = 1;
  }

  void begin(const Playback& playback, const LayerHold& hold, std::size_t p, const Posture& present, Posture& from) {
    copy_part(character_, p, present, from);
    if (planned(playback, hold).aim != nullptr)  // it looks for a way for what hangs on the part, too
      for (const int other : limb_at(p).parts)
        if (at(other) > p) copy_part(character_, at(other), s_.past.before, from);
    if (p == 0 && moves_legs(playback, hold)) s_.carry.raise(s_.postures.base.root);
    if (p != 0 || !moves_legs(playback, hold)) return;
    s_.legs_taken = playback.frame();
    std::array<Rigid, kMaxLegs>& seen = s_.rules.body(planned(playback, hold)).seen_soles;
    seen = s_.carry.soles_in(s_.rules.world());
    coast_moving_legs(seen);
    s_.shift_count += seen != s_.carry.soles();
  }

  // A leg that is on the move when a course takes it over cannot stop at once: its foot is seen where it comes to.
  void coast_moving_legs(std::span<Rigid> soles) {
    constexpr double kCoasts = 0.35;  // of its last step
    std::ranges::copy(s_.rules.world(), s_.rest_world.begin());
    for (std::size_t i = 0; i < stage_.legs.size(); ++i) {
      const Leg& leg = stage_.legs[i];
      if (!s_.rules.feet().moves(i)) continue;
      for (const int p : {leg.part, leg.foot_part})
        coast_part(character_, at(p), s_.past.earlier, s_.past.before, kCoasts, s_.between);
      forward_kinematics(character_, s_.between.coords, leg.joints, s_.rest_world);
      soles[i] = world_from_socket(character_, s_.rest_world, leg.sole);
    }
  }

  void overwrite(const Playback& playback, std::size_t p, bool begins) {
    const LayerHold& hold = s_.stacks[p].overwrite();
    s_.spans.hold(playback.frame(), planned(playback, hold), begins);
    move(playback, hold, p, s_.postures.from_overwrite, s_.postures.from_overwrite, s_.postures.base);
  }

  void solve_ik(const Playback& playback, std::size_t p, const LayerStack::Change& change) {
    const LayerHold& hold = s_.stacks[p].ik();
    const bool begins = change.ik_begins || change.ik_restarts;
    s_.spans.hold(playback.frame(), planned(playback, hold), change.ik_begins);
    move(playback, hold, p, s_.postures.from_ik, beneath(p), s_.postures.plain);
    if (begins && !change.returns) take_time_to_come_in(playback, hold, p);
    if (p == 0) remember_soles(playback);
    if (p == 0 && moves_legs(playback, hold)) take_time_to_fade(playback, hold);
    fade(playback, hold, p);
  }

  // When the root has moved, and again when the feet have: heels may have had to rise.
  void remember_soles(const Playback& playback) {
    const LayerHold& hold = s_.stacks[0].ik();
    if (hold.action >= 0 && moves_legs(playback, hold))
      s_.carry.remember(s_.rules.body(planned(playback, hold)).frame);
  }

  // out = from `from` towards what the rule makes of `beneath`.
  void move(const Playback& playback, const LayerHold& hold, std::size_t p, const Posture& from, const Posture& beneath,
            Posture& out) {
    const RuleCall call{hold.action, content(playback, hold), hold.came, hold.frame, come_in(playback, hold)};
    const Posture& wanted = s_.rules.run(playback, call, p, from, beneath, s_.carry);
    blend(playback, hold, p, from, wanted, covered(playback, hold), out);
  }

  // A course of legs that should come in faster than joints can take its legs over comes in as fast as they can.
  void take_time_to_come_in(const Playback& playback, const LayerHold& hold, std::size_t p) {
    const PlannedAction& action = planned(playback, hold);
    if (takes_its_time(action)) {
      const bool at_once = moves_legs(playback, hold) && s_.rules.body(action).comes_at_once;
      return s_.stacks[p].set_ik_blend(at_once ? 0 : way_frames(playback, hold, p));
    }
    if (action.cuts || !moves_legs(playback, hold)) return;
    const int needs = static_cast<int>(std::ceil(kHurriedWay * way_frames(playback, hold, p)));
    if (needs > action.blend_in) s_.stacks[p].set_ik_blend(needs);
  }

  // From the posture that the action found to the one that its rule has just made.
  int way_frames(const Playback& playback, const LayerHold& hold, std::size_t p) {
    double longest_s = way_s(character_, p, s_.postures.from_ik, s_.rules.made(), easy());
    if (p == 0 && moves_legs(playback, hold)) {
      const WholeBody& body = s_.rules.body(planned(playback, hold));
      for (std::size_t leg = 0; leg < stage_.legs.size(); ++leg)
        longest_s = std::max(longest_s, way_s(body.seen_soles[leg], body.first_soles[leg]));
    }
    return static_cast<int>(std::ceil(longest_s * stage_.rate_hz));
  }

  // A course that fades out has its legs go home from wherever they are then; it begins as early as they need.
  void take_time_to_fade(const Playback& playback, const LayerHold& hold) {
    const PlannedAction& course = planned(playback, hold);
    if (hold.fade_frames >= 0 || !(course.blend_out > 0.0)) return;
    const double left = course.end - content(playback, hold);
    if (left < course.blend_out) return;  // it fades already
    const double way_home_s = std::max(kLeastWay_s, way_home_s_after(std::min(0.5 * left, kGoesOn_s * stage_.rate_hz)));
    const double needs = std::ceil(kHurriedWay * (way_home_s - kLeastWay_s) * stage_.rate_hz);
    if (needs <= course.blend_out || left > needs) return;
    for (LayerStack& stack : s_.stacks)
      if (stack.ik().action >= 0 && planned(playback, stack.ik()).use == course.use)
        stack.set_ik_fade(static_cast<int>(needs));
  }

  // The time that legs take to their base if they first went on for so many frames at the speeds that they have now: a
  // figure that is still going down has a longer way back.
  double way_home_s_after(double frames) {
    double longest_s = 0.0;
    for (const Leg& leg : stage_.legs)
      for (const int part : {leg.part, leg.foot_part}) {
        coast_part(character_, at(part), s_.past.earlier, s_.past.before, frames, s_.between);
        longest_s = std::max(longest_s, way_s(character_, at(part), s_.between, s_.postures.base, easy()));
        longest_s = std::max(longest_s, way_s(character_, at(part), s_.past.before, s_.postures.base, easy()));
      }
    return longest_s;
  }

  void fade(const Playback& playback, const LayerHold& hold, std::size_t p) {
    if (places_foot(playback, hold, p)) return;
    const double left = left_of(playback, hold);
    if (moves_legs(playback, hold) && left < 1.0) s_.carry.bring_along(below(playback, hold), s_.postures.base.root);
    blend(playback, hold, p, beneath(p), s_.postures.plain, left, s_.postures.plain);
  }

  LegsBelow below(const Playback& playback, const LayerHold& course) {
    return s_.carry.below(s_.rules.body(planned(playback, course)).frame);
  }

  void blend(const Playback& playback, const LayerHold& hold, std::size_t p, const Posture& a, const Posture& b,
             double weight, Posture& out) {
    const Rigid root = b.root;  // out may be b
    blend_part(character_, p, a, b, weight, out);
    if (p == 0 && moves_legs(playback, hold)) out.root = blend_root(below(playback, hold), a.root, root, weight);
  }

  void add_additives(const Playback& playback, std::size_t p) {
    playback.for_each(p, Layer::additive, cut_fade_frames(stage_.rate_hz), [&](int run, int action) {
      const PlannedAction& plan = playback.action(action);
      if (const auto weight = additive_weight(playback, plan, playback.run_of(plan, run)))
        add(playback, p, {action, playback.content(playback.run(run)), plan.start, playback.frame(), 1.0}, *weight);
    });
  }

  void add(const Playback& playback, std::size_t p, const RuleCall& call, double weight) {
    Posture& shown = s_.postures.shown;
    if (is_taken_in(p, call.action)) return;
    s_.spans.additive(playback.frame(), call.action);
    s_.added[p] = 1;
    const Posture& moved = s_.rules.run(playback, call, p, shown, shown, s_.carry);
    blend_part(character_, p, shown, moved, weight * freedom(playback, p), shown);
  }

  // A course has taken the leg over as it was seen, with what this additive had made of it.
  bool is_taken_in(std::size_t p, int additive) const {
    const int began = s_.spans.additive_began(additive);
    return began >= 0 && began < s_.legs_taken && is_of_leg(stage_.legs, static_cast<int>(p));
  }

  // The share of an additive that a part shows.
  double freedom(const Playback& playback, std::size_t p) const {
    const LayerHold& course = s_.stacks[0].ik();
    if (course.action < 0 || !moves_legs(playback, course)) return 1.0;
    const GaitFrame& frame = s_.rules.body(planned(playback, course)).frame;
    return freedom_of(frame, stage_.legs, stage_.environment, static_cast<int>(p));
  }

  // Legs that walk have their own speeds: held back one by one, their feet would leave the ground that they stand on.
  void follow(const Playback& playback, std::size_t p) {
    const LayerStack& stack = s_.stacks[p];
    std::vector<double>& coords = s_.postures.shown.coords;
    s_.behind[p] = 0;
    if (is_cut(playback, stack.overwrite()) || is_cut(playback, stack.ik()))
      s_.path.cut(p, coords);
    else if ((stack.ik().action >= 0 && moves_legs(playback, stack.ik())) ||
             LimbKeeper(stage_, s_).stays_planted(p) || LimbKeeper(stage_, s_).stops_with_hips(p))
      s_.path.pass(p, coords);
    else
      s_.behind[p] = s_.path.follow(p, coords, LimbKeeper(stage_, s_).is_struck(p) ? Haste::struck : Haste::at_ease);
  }

  const Stage& stage_;
  const Timeline& timeline_;
  const Character& character_;
  GenerateScratch& s_;
  Motion& motion_;
};

}  // namespace

void generate(const Stage& stage, GenerateScratch& scratch, Motion& motion) {
  scratch.lags.begin(stage.character->parts().size());
  scratch.grasps.begin(stage.character->parts().size());
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
