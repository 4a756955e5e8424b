#include "generator/rule_runner.h"

#include <algorithm>

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
  return {u, u * duration_s, duration_s, u * duration_s - missed_s, duration_s - missed_s, takes_s, 1.0 / rate_hz};
}

// Legs that walk must not be clamped one joint at a time: their feet would leave the ground that they stand on.
bool keeps_ranges(const ActionDef& def) { return def.layer != Layer::overwrite && def.spread != Spread::legs; }

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
  const Part& own = stage_->character->parts()[part];
  if (part == 0) move_root(posture.root);
  forward_kinematics(*stage_->character, posture.coords, own.first_joint, own.first_joint + own.joint_count, world_);
  if (part == 0) room_.begin_frame(world_);
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
                               const Posture& beneath, const Rigid& stands_at) {
  const Character& character = *stage_->character;
  const PlannedAction& action = playback.action(call.action);
  copy_part(character, part, beneath, target_);
  if (action.def->layer != Layer::overwrite) place(part, target_);  // a chain may hang on a joint of its own part
  const ActionTime time = time_of(action, call.came, call.content, playback.rate_hz());
  action.def->rule({character, character.parts()[part], params(action, time, part), world_, {scratch_world_, scratch_row_}, time,
                    stage_->start, stage_->environment, stage_->legs, stands_at, action.aim.get(), action.keys.get(),
                    action.script.get(), action.easy_grip_m, from, playback.frame(), call.took_over, call.came_in, body(action),
                    feedback_[part], room_, stage_->dynamics != nullptr},
                   target_);
  if (keeps_ranges(*action.def) && clamp_part(character, part, target_)) feedback_[part].at_range_end = true;
  return target_;
}

}  // namespace contort
