#include "generator/rule_runner.h"

#include <algorithm>
#include <cstring>

#include "generator/motion/blend.h"
#include "generator/motion/joint_clamp.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// In seconds of the action's content, which a stretched clip plays more slowly.
ActionTime time_of(const PlannedAction& action, double came, int content, double rate_hz) {
  const double duration_s = (action.end - action.start) / action.scale / rate_hz;
  const double u = progress(action, content);
  const double missed_s = std::min(duration_s, action.speed * (came - action.start) / action.scale / rate_hz);
  const double takes_s = (action.end - action.start) / action.speed / rate_hz;
  const double comes_in_s = std::max(0.0, action.blend_in) / rate_hz;
  return {u,       u * duration_s, duration_s,                 u * duration_s - missed_s, duration_s - missed_s,
          takes_s, comes_in_s,     action.blend_out / rate_hz, 1.0 / rate_hz, (action.end - action.start) / rate_hz};
}

// Legs that walk must not be clamped one joint at a time: their feet would leave the ground that they stand on.
bool keeps_ranges(const ActionDef& def) { return def.layer != Layer::overwrite && def.spread != Spread::legs; }

template <class T>
bool are_same_bits(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

std::span<const double> coords_of(const Part& part, const Posture& posture) {
  return std::span(posture.coords).subspan(at(part.first_coord), at(part.coord_count));
}

// The joint that carries all joints of a part; -1 where there is none, or more than one.
int carrier_joint(const Character& character, const Part& part) {
  const std::span<const Joint> joints = character.joints().subspan(at(part.first_joint), at(part.joint_count));
  const auto hangs_elsewhere = [&](const Joint& joint) { return joint.parent < part.first_joint; };
  return std::ranges::count_if(joints, hangs_elsewhere) == 1 ? joints.front().parent : -1;
}

}  // namespace

void RuleRunner::begin(const Stage& stage) {
  const Character& character = *stage.character;
  stage_ = &stage;
  feet_.begin(character, stage.legs, stage.environment);
  room_.begin(character, stage.environment, feet_);
  bodies_.assign(at(stage.timeline.use_count), {});
  feedback_.assign(character.parts().size(), {});
  scripts_.begin();
  for (std::vector<double>& params : computed_) params.clear();
  computed_.resize(at(stage.timeline.use_count));
  world_.resize(character.joints().size());
  placed_.resize(character.parts().size());
  for (std::size_t p = 0; p < placed_.size(); ++p)
    placed_[p].hangs_on = carrier_joint(character, character.parts()[p]), placed_[p].world.clear();
  scratch_world_.resize(world_.size()), scratch_row_.resize(at(character.coord_count()));
}

void RuleRunner::start_from(const Posture& posture) {
  target_ = posture;
  forward_kinematics(*stage_->character, posture.root, posture.coords, world_);
}

void RuleRunner::begin_frame() {
  std::ranges::fill(feedback_, Feedback{});
}

void RuleRunner::place(std::size_t part, const Posture& posture) {
  if (part == 0) move_root(posture.root);
  const Part& own = stage_->character->parts()[part];
  const std::span<Rigid> joints = std::span(world_).subspan(at(own.first_joint), at(own.joint_count));
  PlacedPart& last = placed_[part];
  if (is_as_placed(last, own, posture)) {
    std::ranges::copy(last.world, joints.begin());
  } else {
    forward_kinematics(*stage_->character, posture.coords, own.first_joint, own.first_joint + own.joint_count, world_);
    remember(own, posture, joints, last);
  }
  if (part == 0) room_.begin_frame(world_);
}

bool RuleRunner::is_as_placed(const PlacedPart& last, const Part& part, const Posture& posture) const {
  if (last.hangs_on < 0 || last.world.empty()) return false;
  return are_same_bits<Rigid>({&world_[at(last.hangs_on)], 1}, {&last.carrier, 1}) &&
         are_same_bits<double>(coords_of(part, posture), last.coords);
}

void RuleRunner::remember(const Part& part, const Posture& posture, std::span<const Rigid> joints, PlacedPart& last) {
  if (last.hangs_on < 0) return;
  const std::span<const double> coords = coords_of(part, posture);
  last.carrier = world_[at(last.hangs_on)];
  last.coords.assign(coords.begin(), coords.end());
  last.world.assign(joints.begin(), joints.end());
}

// All joints go along with the root until their own parts are placed.
void RuleRunner::move_root(const Rigid& root) {
  if (root == world_[0]) return;
  const Rigid moved = root * inverse(world_[0]);
  world_[0] = root;
  for (std::size_t j = 1; j < world_.size(); ++j) world_[j] = moved * world_[j];
}

// The numbers for an action's rule, after its script, if it has one. A script that fails changes nothing.
std::span<const double> RuleRunner::params(const PlannedAction& action, const ActionTime& time, std::size_t part) {
  if (action.script == nullptr) return action.params;
  const ScriptPlan& plan = *action.script;
  script_row_.resize(at(plan.row_size));
  start_row(plan, action.params, target_, script_row_);
  const ScriptInput in{time.time_s, time.duration_s, time.progress, &stage_->environment,
                       world_[0] * inverse(stage_->character->rest_root())};
  if (!scripts_.run(plan, action.params, in, script_row_)) {
    feedback_[part].failed = true;
    start_row(plan, action.params, target_, script_row_);
  }
  if (action.def == &script_def(plan.adds)) return script_row_;
  computed_[at(action.use)] = action.params;
  put_params(plan, script_row_, computed_[at(action.use)]);
  return computed_[at(action.use)];
}

const Posture& RuleRunner::run(const Playback& playback, const RuleCall& call, std::size_t part, const Posture& from,
                               const Posture& beneath, const RootCarry& carry) {
  const Character& character = *stage_->character;
  const PlannedAction& action = playback.action(call.action);
  copy_part(character, part, beneath, target_);
  if (action.def->layer != Layer::overwrite) place(part, target_);  // a chain may hang on a joint of its own part
  const ActionTime time = time_of(action, call.came, call.content, playback.rate_hz());
  action.def->rule({character, character.parts()[part], params(action, time, part), world_, {scratch_world_, scratch_row_}, time,
                    stage_->start, stage_->environment, stage_->legs, carry.stands_at(), carry.base_stands_at(),
                    action.aim.get(), action.keys.get(),
                    action.script.get(), action.easy_grip_m, from, playback.frame(), call.took_over, call.came_in, body(action),
                    feedback_[part], room_, stage_->dynamics != nullptr},
                   target_);
  if (keeps_ranges(*action.def) && clamp_part(character, part, target_)) feedback_[part].at_range_end = true;
  return target_;
}

}  // namespace contort
