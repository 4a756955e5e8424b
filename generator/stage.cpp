#include "generator/stage.h"

#include <algorithm>

#include "generator/motion/recording.h"

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

Result<Motion> play_recording(const Spec& spec, const Character& character, const Library& library,
                              const Rigid& start) {
  const RecordingDesc& desc = spec.recording;
  if (!spec.sequences.empty() || !spec.interrupts.empty())
    return Issue{"recording.with_sequences", "/recording", "plays instead of sequences and interrupts: leave them out"};
  const auto found = library.recordings.find(desc.name);
  if (found == library.recordings.end())
    return Issue{"recording.unknown_name", "/recording/name",
                 "found \"" + desc.name + "\", which is no animation of the library folders"};
  const Asset& asset = *found->second;
  const auto clip = std::ranges::find_if(asset.clips, [&](const AssetClip& c) {
    return desc.clip.empty() || c.label == desc.clip || c.name == desc.clip;
  });
  if (clip == asset.clips.end())
    return Issue{"recording.unknown_clip", "/recording/clip",
                 desc.clip.empty() ? desc.name + " holds no clip" : "found \"" + desc.clip + "\", which no clip is called"};
  if (frames_of(*clip, spec.rate_hz, spec.hold_frames) > kMaxFrames)
    return Issue{"spec.too_long", "/recording", "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
  Result<Motion> motion =
      follow_recording(character, {asset, *clip, desc.joints, spec.rate_hz, spec.hold_frames, start});
  if (motion) return motion;
  Issue issue = motion.issue();
  issue.pointer = "/recording" + issue.pointer;
  return issue;
}

}  // namespace

Result<Stage> build_stage(const Spec& spec, const Library& library) {
  Result<Character> character = build_character(spec.character, library);
  if (!character) {
    Issue issue = character.issue();
    issue.pointer = "/character" + issue.pointer;
    return issue;
  }
  return build_stage(spec, std::make_shared<const Character>(std::move(character).value()), library);
}

Result<Stage> build_stage(const Spec& spec, std::shared_ptr<const Character> character, const Library& library) {
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
  if (!spec.recording.name.empty()) {
    Result<Motion> recorded = play_recording(spec, *character, library, stage.start);
    if (!recorded) return recorded.issue();
    stage.most_frames = recorded->frame_count;
    stage.recorded = std::make_shared<const Motion>(std::move(recorded).value());
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
