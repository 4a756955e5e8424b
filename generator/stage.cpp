#include "generator/stage.h"

#include <algorithm>

namespace contort {

namespace {

// A figure with mass keeps its knees bent by 12 degrees: on a straight leg it could not control its height.
constexpr double kSoftKnees = 0.006;  // of the leg's length

void place_hips(const Spec& spec, Stage& stage) {
  for (Leg& leg : stage.legs) {
    const double soft_m = spec.dynamics.mode == Mode::kinematic ? 0.0 : kSoftKnees * leg.length_m;
    const double lower_m = std::max(spec.start.lower_m, soft_m);
    leg.home_m.z -= spec.start.ahead_m, leg.length_m -= lower_m;
    stage.bends = stage.bends || spec.start.ahead_m != 0.0 || lower_m != 0.0;
  }
}

}  // namespace

Result<Stage> build_stage(const Spec& spec, const Library& library) {
  Result<Character> character = build_character(spec.character, library);
  if (!character) {
    Issue issue = character.issue();
    issue.pointer = "/character" + issue.pointer;
    return issue;
  }
  return build_stage(spec, std::make_shared<const Character>(std::move(character).value()));
}

Result<Stage> build_stage(const Spec& spec, std::shared_ptr<const Character> character) {
  Result<Timeline> timeline = lay_out({spec.sequences, spec.interrupts, *character});
  if (!timeline) return timeline.issue();
  Result<Environment> environment = build_environment(spec.environment);
  if (!environment) {
    Issue issue = environment.issue();
    issue.pointer = "/environment" + issue.pointer;
    return issue;
  }
  Stage stage;
  stage.environment = std::move(environment).value();
  stage.legs = find_legs(*character);
  stage.timeline = std::move(timeline).value();
  stage.rate_hz = spec.rate_hz;
  stage.start = {axis_angle(Vec3(0, 1, 0), spec.start.heading_deg * kRadPerDeg), Vec3(spec.start.position_m.x, 0.0, spec.start.position_m.z)};
  place_hips(spec, stage);
  stage.hold_frames = spec.hold_frames;
  // The queue may run dry once more for every interrupt. One more frame than periods: frame 0 is the state before anything moved, the last one the state at the end.
  stage.most_frames =
      stage.timeline.frame_count + spec.hold_frames * (1 + static_cast<int>(spec.interrupts.size())) + 1;
  if (stage.most_frames > kMaxFrames + 1)
    return Issue{"spec.too_long", "/hold_frames",
                 "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
  for (std::size_t i = 0; i < stage.timeline.interrupts.size(); ++i) {
    PlannedInterrupt& interrupt = stage.timeline.interrupts[i];
    if (interrupt.when.event != Event::near_obstacle || interrupt.when.name.empty()) continue;
    interrupt.obstacle = stage.environment.find_obstacle(interrupt.when.name);
    if (interrupt.obstacle < 0)
      return Issue{"spec.unknown_name", "/interrupts/" + std::to_string(i) + "/when/name",
                   "found \"" + interrupt.when.name + "\", which no obstacle is called"};
  }
  if (spec.dynamics != DynamicsDesc{}) {
    Result<DynamicsSetup> dynamics = build_dynamics(spec.dynamics, *character, stage.legs, stage.rate_hz, stage.start.q);
    if (!dynamics) {
      Issue issue = dynamics.issue();
      issue.pointer = "/dynamics" + issue.pointer;
      return issue;
    }
    if (spec.dynamics.mode != Mode::kinematic) stage.dynamics = std::make_shared<const DynamicsSetup>(std::move(dynamics).value());
  }
  stage.character = std::move(character);
  return stage;
}

}  // namespace contort
