#include "server/take.h"

#include <algorithm>

#include "model/core/detmath.h"

namespace contort::server {

namespace {

constexpr std::size_t kMostInterrupts = 64, kMostImpacts = 64, kMostClips = 256;  // as in spec_fields.h

Issue full(const std::string& what) {
  return {"take.full", "", "this take holds as many " + what + " as a spec can; begin a new one"};
}

Quat start_turn(const Spec& spec) { return axis_angle(Vec3(0, 1, 0), spec.start.heading_deg * kRadPerDeg); }

Vec3 start_place(const Spec& spec) { return {spec.start.position_m.x, 0.0, spec.start.position_m.z}; }

// The span that includes the last shown frame and the next one; nullptr if there is none.
const QueueSpan* running(const Moment& now) {
  const auto runs = [&](const QueueSpan& span) { return span.first_frame <= now.frame && now.frame < span.last_frame; };
  const auto found = std::ranges::find_if(now.queue, runs);
  return found == now.queue.end() ? nullptr : &*found;
}

// Sequences of interrupts are numbered after the spec's own.
SequenceDesc* sequence_at(Spec& spec, int index) {
  const auto at = static_cast<std::size_t>(index);
  if (at < spec.sequences.size()) return &spec.sequences[at];
  const std::size_t interrupt = at - spec.sequences.size();
  return interrupt < spec.interrupts.size() ? &spec.interrupts[interrupt].sequence : nullptr;
}

ActionUse aim_use(const Spec& spec, const AimCommand& aim) {
  ActionUse use;
  use.action = aim.action, use.slot = aim.slot;
  use.duration_frames = aim.duration_frames;
  use.blend_in_frames = use.blend_out_frames = std::min(aim.blend_frames, aim.duration_frames / 2);
  const Vec3 target = glm::conjugate(start_turn(spec)) * (aim.target_m - start_place(spec));
  use.params["target_m"] = target;
  if (!aim.point.empty()) use.params["point"] = aim.point;
  return use;
}

}  // namespace

Result<Spec> with_sequence(const Spec& spec, const SequenceDesc& sequence, Enter enter, bool resume,
                           const Moment& now) {
  if (spec.interrupts.size() >= kMostInterrupts) return full("interrupts");
  Spec next = spec;
  InterruptDesc interrupt;
  interrupt.when.event = contort::Event::frame, interrupt.when.frame = now.frame + 1;
  interrupt.enter = enter, interrupt.resume = resume, interrupt.sequence = sequence;
  next.interrupts.push_back(std::move(interrupt));
  return next;
}

Result<Spec> with_aim(const Spec& spec, const AimCommand& aim, const Moment& now) {
  Spec next = spec;
  ClipDesc clip;
  clip.name = aim.action;
  clip.actions.push_back(aim_use(spec, aim));
  const QueueSpan* run = running(now);
  SequenceDesc* sequence = run == nullptr ? nullptr : sequence_at(next, run->sequence);
  if (sequence != nullptr && sequence->duration_frames == 0 && sequence->clips.size() < kMostClips) {
    clip.start_frame = run->first_content + now.frame + 1 - run->first_frame;
    sequence->clips.push_back(std::move(clip));
    return next;
  }
  SequenceDesc alone;
  alone.name = aim.action;
  alone.clips.push_back(std::move(clip));
  return with_sequence(spec, alone, Enter::front, true, now);
}

Result<Spec> with_push(const Spec& spec, const PushCommand& push, const Moment& now) {
  if (spec.dynamics.impacts.size() >= kMostImpacts) return full("blows");
  Spec next = spec;
  ImpactDesc blow;
  blow.frame = now.frame + 1;
  blow.slot = push.slot, blow.joint = push.joint;
  blow.point_m = push.point_m;
  blow.impulse_N_s = glm::conjugate(start_turn(spec)) * push.impulse_N_s;
  next.dynamics.impacts.push_back(std::move(blow));
  return next;
}

Spec next_take(const Spec& spec, const Rigid& root, const Quat& rest) {
  Spec next = spec;
  next.sequences.clear(), next.interrupts.clear(), next.dynamics.impacts.clear();
  next.recording = {};
  next.hold_frames = 0;
  const Vec3 ahead = root.q * glm::conjugate(rest) * Vec3(0, 0, 1);
  // Rounds to millimetres and tenths of degrees, because people read this spec.
  const auto place_m = [](double value) { return on_lattice(std::clamp(value, -1000.0, 1000.0), 1000); };
  next.start.position_m = Vec3(place_m(root.p_m.x), 0.0, place_m(root.p_m.z));
  next.start.heading_deg = on_lattice(det::atan2(ahead.x, ahead.z) / kRadPerDeg, 10);
  return next;
}

}  // namespace contort::server
