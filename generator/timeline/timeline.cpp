#include "generator/timeline/timeline.h"

#include <algorithm>
#include <cmath>

#include "generator/actions/hand.h"
#include "generator/motion/aim_tables.h"
#include "generator/timeline/part_order.h"
#include "generator/timeline/second_hand.h"
#include "model/core/nearest.h"
#include "model/motion/legs.h"

namespace contort {

namespace {

constexpr std::size_t kMaxActionUses = 10'000;  // in all sequences and interrupts
constexpr double kComesBack_s = 0.3;  // of a course that goes on after a cut, at least: a foot in the air comes down

// A stretch of content on the time line: frame = start + content * scale.
struct Stretch {
  double start = 0.0;
  double scale = 1.0;
  double at(double content) const { return start + content * scale; }
};

// The factor by which content of a natural length is stretched to a wanted one (0: natural).
double stretch_scale(double natural, int wanted_frames) {
  return wanted_frames > 0 && natural > 0.0 ? wanted_frames / natural : 1.0;
}

// The first frame at or after a time. Rounding in the stretches must not cost a frame.
double frame_from(double time) { return std::ceil(time - 1e-6); }

double natural_length(const SequenceDesc& sequence) {
  double length = 0.0;
  for (const ClipDesc& clip : sequence.clips) length = std::max(length, clip.start_frame + clip_length(clip));
  return length;
}

std::string slots_of(const Character& character) {
  std::string text;
  for (const Part& part : character.parts()) text += (text.empty() ? "" : ", ") + part.slot;
  return text;
}

Issue unknown_slot(const Character& character, const std::string& slot, const std::string& pointer) {
  const std::string slots = slots_of(character);
  return {"spec.unknown_slot", pointer, "found \"" + slot + "\", allowed are " + slots + did_you_mean(slot, slots)};
}

std::string names_of(const std::vector<Action>& actions) {
  std::string text;
  for (const Action& action : actions) text += (text.empty() ? "" : ", ") + std::string(action.name);
  return text.empty() ? "none" : text;
}

std::string all_action_names(const Character& character) {
  std::string text;
  for (const ActionDef& action : all_actions()) text += (text.empty() ? "" : ", ") + std::string(action.name);
  for (const ActionDesc& desc : character.actions()) text += ", " + desc.name;
  return text;
}

void list_by_part(std::size_t parts, Timeline& out) {
  out.of_part.resize(out.sequences.size() * parts);
  for (std::size_t i = 0; i < out.actions.size(); ++i) {
    const PlannedAction& action = out.actions[i];
    out.of_part[static_cast<std::size_t>(action.sequence) * parts + static_cast<std::size_t>(action.part)].push_back(
        static_cast<int>(i));
  }
}

Issue unknown_action(const Character& character, const std::string& action) {
  const std::string names = all_action_names(character);
  return {"spec.unknown_action", "/action",
          "found \"" + action + "\", allowed are " + names + did_you_mean(action, names)};
}

Issue unsupported(const Character& character, const Part& part, const std::string& action) {
  return {"spec.unsupported_action", "/action",
          "part " + part.name + " cannot do \"" + action + "\", allowed are " +
              names_of(actions_of(character, part))};
}

class Layout {
 public:
  explicit Layout(const TimelineInput& input) : input_(input), character_(input.character) {}

  Result<Timeline> lay_out() {
    out_.queued = static_cast<int>(input_.sequences.size());
    for (std::size_t s = 0; s < input_.sequences.size(); ++s)
      if (Result<Done> done = add_sequence(input_.sequences[s], "/sequences/" + std::to_string(s)); !done)
        return done.issue();
    for (std::size_t i = 0; i < input_.interrupts.size(); ++i)
      if (Result<Done> done = add_interrupt(input_.interrupts[i], "/interrupts/" + std::to_string(i)); !done)
        return done.issue();
    for (std::size_t i = 0; i < input_.interrupts.size(); ++i)
      if (Result<Done> done = check_names(input_.interrupts[i], "/interrupts/" + std::to_string(i)); !done)
        return done.issue();
    pair_hands(character_, out_);
    list_by_part(character_.parts().size(), out_);
    if (Result<Done> done = order_parts(character_, out_); !done) return done.issue();
    return std::move(out_);
  }

 private:
  Result<Done> add_sequence(const SequenceDesc& sequence, const std::string& pointer) {
    for (const ClipDesc& clip : sequence.clips) uses_ += clip.actions.size();
    if (uses_ > kMaxActionUses)
      return Issue{"spec.too_many", pointer,
                   "the motion uses more than " + std::to_string(kMaxActionUses) + " actions"};
    const double natural = natural_length(sequence);
    const double scale = stretch_scale(natural, sequence.duration_frames);
    // Sequences change on a frame.
    const double length = frame_from(stretched(natural, sequence.duration_frames));
    if (out_.frame_count + length > kMaxFrames)
      return Issue{"spec.too_long", pointer, "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
    out_.frame_count += static_cast<int>(length);
    out_.sequences.push_back({sequence.name, static_cast<int>(length), {}});
    for (std::size_t c = 0; c < sequence.clips.size(); ++c)
      if (Result<Done> done =
              add_clip(sequence.clips[c], static_cast<int>(c), scale, pointer + "/clips/" + std::to_string(c));
          !done)
        return done;
    extend_for_last_frames();
    return Done{};
  }

  // Actions without length need a frame after their start, which may lie beyond the end of what is stretched.
  void extend_for_last_frames() {
    PlannedSequence& own = out_.sequences.back();
    const int before = own.length;
    for (const PlannedAction& action : out_.actions)
      if (action.sequence == static_cast<int>(out_.sequences.size()) - 1)
        own.length = std::max(own.length, action.last_frame);
    out_.frame_count += own.length - before;
  }

  Result<Done> add_clip(const ClipDesc& clip, int index, double scale, const std::string& pointer) {
    const double own_scale = stretch_scale(natural_length(clip), clip.duration_frames) / clip.speed;
    const Stretch content{clip.start_frame * scale, scale * own_scale};
    const double end = (clip.start_frame + clip_length(clip)) * scale;
    out_.sequences.back().clips.push_back(
        {clip.name, static_cast<int>(frame_from(content.start)), static_cast<int>(frame_from(end))});
    for (std::size_t a = 0; a < clip.actions.size(); ++a) {
      PlannedAction planned;
      planned.sequence = static_cast<int>(out_.sequences.size()) - 1;
      planned.clip = index, planned.action = static_cast<int>(a);
      if (Result<Done> done = add_action(clip.actions[a], content, planned); !done) {
        Issue issue = done.issue();
        issue.pointer = pointer + "/actions/" + std::to_string(a) + issue.pointer;
        return issue;
      }
    }
    return Done{};
  }

  Result<Done> resolve(const ActionUse& use, PlannedAction& planned) const {
    if (!is_action_name(character_, use.action)) return unknown_action(character_, use.action);
    planned.named = character_.find_part(use.slot);
    if (planned.named < 0) return unknown_slot(character_, use.slot, "/slot");
    const Part& part = character_.parts()[static_cast<std::size_t>(planned.named)];
    const std::optional<Action> action = find_action(character_, part, use.action);
    if (!action) return unsupported(character_, part, use.action);
    planned.def = action->def, planned.name = use.action;
    Result<std::vector<double>> params = bind_params(*action, character_, part, use.params);
    if (!params) return params.issue();
    planned.params = std::move(params).value();
    if (planned.def == &key_pose_def())
      planned.keys = std::make_shared<const KeyPlan>(plan_keys(*action->desc, character_, part));
    if (action->desc != nullptr && !action->desc->script.empty())
      planned.script = std::make_shared<const ScriptPlan>(plan_script(*action->desc, character_, part));
    if (!part.reach.empty()) planned.easy_grip_m = easy_grip_m(character_, part);
    plan_aim(planned);
    return check_blends(use, *planned.def);
  }

  void plan_aim(PlannedAction& planned) const {
    const Part& part = character_.parts()[static_cast<std::size_t>(planned.named)];
    const std::vector<ParamDef> defs = planned.def->params(character_, part);
    if (!defs.empty() && defs.front().type == ParamType::own_point)
      add_chain(planned.named, chest_of(carrier_of(character_, planned.named)), false, planned);
  }

  // The face of a part that is not the root; -1 where it has none.
  int chest_of(int part) const {
    if (part <= 0) return -1;
    const std::vector<FacingChain>& facing = character_.parts()[static_cast<std::size_t>(part)].facing;
    return facing.empty() ? -1 : facing.front().socket;
  }

  void add_chain(int part, int chest, bool helps, PlannedAction& planned) const {
    AimPlan plan;
    plan.chest = chest, plan.helps = helps;
    plan.chain = aim_chain_for(character_, part, static_cast<int>(planned.params.front()));
    plan.table = shared_aim_tables().get(character_, plan.chain);
    planned.aim = std::make_shared<const AimPlan>(std::move(plan));
  }

  static Result<Done> check_blends(const ActionUse& use, const ActionDef& def) {
    const std::string& name = use.action;
    if (use.blend_in_frames > 0 && def.timing == Timing::goal)
      return Issue{"spec.bad_blend", "/blend_in_frames",
                   "\"" + name + "\" blends in over its whole period, allowed is 0"};
    if (use.blend_out_frames > 0 && def.layer == Layer::overwrite)
      return Issue{"spec.bad_blend", "/blend_out_frames", "\"" + name + "\" has nothing to fade to, allowed is 0"};
    return Done{};
  }

  // Only courses on the ik layer start elsewhere than where the part is.
  static int blend_in_frames(const ActionUse& use, const ActionDef& def) {
    const bool may_wait = def.layer == Layer::ik && def.timing == Timing::course;
    return may_wait ? use.blend_in_frames : std::max(0, use.blend_in_frames);
  }

  Result<Done> add_action(const ActionUse& use, const Stretch& content, PlannedAction& planned) {
    if (Result<Done> done = resolve(use, planned); !done) return done;
    planned.use = out_.use_count++;
    planned.start = content.at(use.start_frame);
    planned.end = content.at(static_cast<double>(use.start_frame) + use.duration_frames);
    planned.speed = use.speed;
    planned.scale = content.scale;
    planned.blend_in = blend_in_frames(use, *planned.def) * content.scale;
    planned.cuts = planned.def->timing == Timing::goal ? use.duration_frames == 0 : planned.blend_in == 0.0;
    planned.blend_out = use.blend_out_frames * content.scale;
    planned.first_frame = static_cast<int>(std::min(frame_from(planned.start), 1e9));
    // At least one frame after the start, or an action shorter than the rounding would never reach its target.
    planned.last_frame =
        static_cast<int>(std::min(std::max(frame_from(planned.end), std::floor(planned.start) + 1.0), 1e9));
    for (const int part : parts_moved(*planned.def, character_, planned.named)) {
      planned.part = part;
      out_.actions.push_back(planned);
    }
    if (planned.aim != nullptr) add_further(planned);
    return Done{};
  }

  bool carries_legs(int part) const {
    return std::ranges::any_of(find_legs(character_),
                               [&](const Leg& leg) { return carrier_of(character_, leg.part) == part; });
  }

  // The torso on which the part hangs is directed at the same target; and the figure steps round to face it. A trunk
  // that legs carry does not bend while they step.
  void add_further(const PlannedAction& aim) {
    const int carrier = carrier_of(character_, aim.named);
    if (carrier <= 0 && (!is_trunk(character_, aim.named) || carries_legs(aim.named))) return;
    const bool has_chest = aim.aim->chest >= 0 && !carries_legs(carrier);
    PlannedAction turned = aim;
    turned.blend_in = -1.0, turned.cuts = false;
    if (has_chest) {
      turned.params.front() = aim.aim->chest;
      add_chain(carrier, -1, true, turned);
      add_further(aim.use, {carrier}, turned);
    }
    const ActionDef& turn = *find_action("turn");
    if (!turn.supports(character_, character_.parts().front())) return;
    turned.def = &turn, turned.aim = nullptr;
    turned.params.erase(turned.params.begin());
    add_further(aim.use, parts_moved(turn, character_, 0), turned);
  }

  void add_further(int of_use, const std::vector<int>& parts, PlannedAction planned) {
    planned.use = out_.use_count++;
    planned.further = static_cast<int>(out_.further.size());
    out_.further.push_back({of_use, static_cast<int>(out_.actions.size())});
    for (const int part : parts) {
      planned.part = part;
      out_.actions.push_back(planned);
    }
  }

  Result<Done> add_interrupt(const InterruptDesc& desc, const std::string& pointer) {
    PlannedInterrupt planned;
    planned.when = desc.when, planned.enter = desc.enter, planned.after = desc.after, planned.resume = desc.resume;
    planned.sequence = static_cast<int>(out_.sequences.size());
    if (desc.when.event == Event::contact || desc.when.event == Event::aim_reached) {
      planned.part = character_.find_part(desc.when.slot);
      if (planned.part < 0) return unknown_slot(character_, desc.when.slot, pointer + "/when/slot");
    }
    out_.interrupts.push_back(std::move(planned));
    return add_sequence(desc.sequence, pointer + "/sequence");
  }

  // A name that nobody has would wait for ever, or be put in another place than the author meant.
  Result<Done> check_names(const InterruptDesc& desc, const std::string& pointer) const {
    bool clip = false, sequence = false, after = false;
    for (const PlannedSequence& planned : out_.sequences) {
      sequence |= planned.name == desc.when.name;
      after |= planned.name == desc.after;
      for (const PlannedClip& own : planned.clips) clip |= own.name == desc.when.name;
    }
    const auto unknown = [&](const char* field, const std::string& name) {
      return Issue{"spec.unknown_name", pointer + field,
                   "found \"" + name + "\", which nothing in this spec is called"};
    };
    if (desc.when.event == Event::clip_ended && !clip) return unknown("/when/name", desc.when.name);
    if (desc.when.event == Event::sequence_ended && !sequence) return unknown("/when/name", desc.when.name);
    if (desc.enter == Enter::after_sequence && !after) return unknown("/after", desc.after);
    return Done{};
  }

  const TimelineInput& input_;
  const Character& character_;
  Timeline out_;
  std::size_t uses_ = 0;
};

// 0 up to `from`, 1 after `from + length`, eased between; at once where the length is 0.
double ramp(double frame, double from, double length) {
  if (!(length > 0.0)) return frame > from ? 1.0 : 0.0;
  return ease((frame - from) / length);
}

}  // namespace

Result<Timeline> lay_out(const TimelineInput& input) { return Layout(input).lay_out(); }

bool takes_its_time(const PlannedAction& action) { return action.blend_in < 0.0; }

double progress(const PlannedAction& action, int frame) {
  const double period = action.end - action.start;
  if (!(period > 0.0)) return frame > action.start ? 1.0 : 0.0;  // stretched to less than the rounding of its start
  const double u = action.speed * (frame - action.start) / period;
  return std::clamp(u, 0.0, 1.0);
}

double blended_in(const PlannedAction& action, double came, int frame) {
  if (action.def->timing == Timing::goal) return ease(progress(action, frame));
  return ramp(frame, came, action.blend_in);
}

double not_blended_out(const PlannedAction& action, int frame) {
  if (!(action.blend_out > 0.0)) return 1.0;
  const double length = std::min(action.blend_out, action.end - action.start);
  return 1.0 - ramp(frame, action.end - length, length);
}

double come_in(const PlannedAction& action, double came, int frame, int held_frames, double rate_hz) {
  const double in = blended_in(action, came, frame);
  if (action.def->layer != Layer::ik || action.def->timing == Timing::goal || came <= action.start) return in;
  const int back_frames = std::max(1, static_cast<int>(kComesBack_s * rate_hz));
  return std::min(in, ease(static_cast<double>(held_frames) / back_frames));
}

double ease(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

}  // namespace contort
