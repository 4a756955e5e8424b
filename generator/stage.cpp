#include "generator/stage.h"

#include <algorithm>

#include "generator/motion/plant_feet.h"
#include "model/core/number_text.h"
#include "model/motion/recording.h"

namespace contort {

namespace {

// An issue in a part of the spec, with its pointer extended to the whole spec.
Issue below(const std::string& pointer, Issue issue) {
  issue.pointer = pointer + issue.pointer;
  return issue;
}

// A figure with mass keeps its knees bent by 12 degrees: on a straight leg it could not control its height.
constexpr double kSoftKnees = 0.006;  // of the leg's length
// Its hips sway, and its ankles with them.
constexpr double kAnkleReserve_rad = 2.0 * kRadPerDeg;

void place_hips(const Spec& spec, Stage& stage) {
  for (Leg& leg : stage.legs) {
    const double soft_m = spec.dynamics.mode == Mode::kinematic ? 0.0 : kSoftKnees * leg.length_m;
    const double lower_m = std::max(spec.start.lower_m, soft_m);
    leg.home_m.z -= spec.start.ahead_m, leg.length_m -= lower_m, leg.kept_bent_m = lower_m;
    if (spec.dynamics.mode != Mode::kinematic) leg.ankle_reserve_rad = kAnkleReserve_rad;
    stage.bends = stage.bends || spec.start.ahead_m != 0.0 || lower_m != 0.0;
  }
}

// The clip of this name or label, the first one where no name is given; null where there is none.
const AssetClip* find_clip(const Asset& asset, const std::string& name) {
  for (const AssetClip& clip : asset.clips)
    if (name.empty() || clip.label == name || clip.name == name) return &clip;
  return nullptr;
}

Issue unknown_clip(const RecordingDesc& desc) {
  return {"recording.unknown_clip", "/recording/clip",
          desc.clip.empty() ? desc.name + " holds no clip" : "found \"" + desc.clip + "\", which no clip is called"};
}

// The joints that nodes move: those that the recording names. If it names none, a character that was imported has the
// nodes of its own file.
std::map<std::string, std::string> joints_of(const RecordingDesc& desc, const Asset& asset, const Character& character,
                                             const Library& library) {
  const auto own = library.joint_maps.find(character.name());
  if (!desc.joints.empty() || own == library.joint_maps.end()) return desc.joints;
  std::map<std::string, std::string> joints;
  for (const auto& entry : own->second) {
    const bool is_there = std::ranges::any_of(asset.nodes, [&](const AssetNode& node) {
      return node.label == entry.first || node.name == entry.first;
    });
    if (is_there && character.find_joint(entry.second) >= 0) joints.insert(entry);
  }
  return joints;
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
  const AssetClip* clip = find_clip(asset, desc.clip);
  if (clip == nullptr) return unknown_clip(desc);
  const std::map<std::string, std::string> joints = joints_of(desc, asset, character, library);
  const RecordingUse use{asset, *clip, joints, desc.from_s, spec.rate_hz, spec.hold_frames, start};
  if (desc.from_s > clip->last_s - clip->first_s)
    return Issue{"recording.too_late", "/recording/from_s",
                 "the clip lasts " + number_text(clip->last_s - clip->first_s) + " s"};
  if (frames_of(use) > kMaxFrames)
    return Issue{"spec.too_long", "/recording", "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
  Result<Motion> motion = follow_recording(character, use);
  if (!motion) return below("/recording", motion.issue());
  return motion;
}

// Fills a stage, step by step.
class StageBuilder {
 public:
  StageBuilder(const Spec& spec, std::shared_ptr<const Character> character, const Library& library)
      : spec_(spec), character_(*character), library_(library) {
    out_.character = std::move(character);
  }

  Result<Stage> build() {
    for (const auto step : {&StageBuilder::add_timeline, &StageBuilder::add_environment, &StageBuilder::find_length,
                            &StageBuilder::find_obstacles, &StageBuilder::leave_one_part, &StageBuilder::leave_one_level,
                            &StageBuilder::add_recording,
                            &StageBuilder::add_dynamics})
      if (const Result<Done> done = (this->*step)(); !done) return done.issue();
    return std::move(out_);
  }

 private:
  Result<Done> add_timeline() {
    Result<Timeline> timeline = lay_out({spec_.sequences, spec_.interrupts, character_});
    if (!timeline) return timeline.issue();
    out_.timeline = std::move(timeline).value();
    return Done{};
  }

  Result<Done> add_environment() {
    Result<Environment> environment = build_environment(spec_.environment);
    if (!environment) return below("/environment", environment.issue());
    out_.environment = std::move(environment).value();
    out_.start = {axis_angle(Vec3(0, 1, 0), spec_.start.heading_deg * kRadPerDeg),
                  Vec3(spec_.start.position_m.x, 0.0, spec_.start.position_m.z)};
    out_.legs = find_legs(character_);
    place_hips(spec_, out_);
    return Done{};
  }

  // The queue may run dry once more for every interrupt. One more frame than periods: frame 0 is the state before
  // anything moved, the last one the state at the end.
  Result<Done> find_length() {
    out_.rate_hz = spec_.rate_hz, out_.hold_frames = spec_.hold_frames;
    const int ends = 1 + static_cast<int>(spec_.interrupts.size());
    out_.most_frames = out_.timeline.frame_count + spec_.hold_frames * ends + 1;
    if (out_.most_frames <= kMaxFrames + 1) return Done{};
    return Issue{"spec.too_long", "/hold_frames",
                 "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
  }

  Result<Done> find_obstacles() {
    for (std::size_t i = 0; i < out_.timeline.interrupts.size(); ++i) {
      PlannedInterrupt& interrupt = out_.timeline.interrupts[i];
      if (interrupt.when.event != Event::near_obstacle || interrupt.when.name.empty()) continue;
      interrupt.obstacle = out_.environment.find_obstacle(interrupt.when.name);
      if (interrupt.obstacle < 0)
        return Issue{"spec.unknown_name", "/interrupts/" + std::to_string(i) + "/when/name",
                     "found \"" + interrupt.when.name + "\", which no obstacle is called"};
    }
    return Done{};
  }

  Result<Done> leave_one_part() {
    if (spec_.only_slot.empty()) return Done{};
    const int part = character_.find_part(spec_.only_slot);
    if (part < 0)
      return Issue{"spec.unknown_slot", "/only_slot",
                   "found \"" + spec_.only_slot + "\", which is no slot of the character"};
    std::vector<std::vector<int>>& of_part = out_.timeline.of_part;
    for (std::size_t i = 0; i < of_part.size(); ++i)
      if (i % character_.parts().size() != static_cast<std::size_t>(part)) of_part[i].clear();
    return Done{};
  }

  Result<Done> leave_one_level() {
    if (spec_.only_sequence == 0 && spec_.only_clip == 0) return Done{};
    const std::vector<PlannedSequence>& sequences = out_.timeline.sequences;
    const auto all = static_cast<int>(sequences.size());
    if (spec_.only_sequence < 1 || spec_.only_sequence > all)
      return Issue{"spec.no_sequence", "/only_sequence",
                   "found sequence " + std::to_string(spec_.only_sequence) + ", the spec has " + std::to_string(all)};
    const PlannedSequence& sequence = sequences[static_cast<std::size_t>(spec_.only_sequence - 1)];
    const auto clips = static_cast<int>(sequence.clips.size());
    if (spec_.only_clip > clips)
      return Issue{"spec.no_clip", "/only_clip", "found clip " + std::to_string(spec_.only_clip) + ", sequence " +
                                                     std::to_string(spec_.only_sequence) + " has " +
                                                     std::to_string(clips)};
    out_.level = {spec_.only_sequence - 1, spec_.only_clip - 1, 0, sequence.length};
    if (spec_.only_clip == 0) return Done{};
    const PlannedClip& clip = sequence.clips[static_cast<std::size_t>(spec_.only_clip - 1)];
    out_.level.begins = std::min(clip.start, sequence.length), out_.level.ends = clip.end;
    return Done{};
  }

  Result<Done> add_recording() {
    if (spec_.recording.name.empty()) return Done{};
    Result<Motion> recorded = play_recording(spec_, character_, library_, out_.start);
    if (!recorded) return recorded.issue();
    out_.most_frames = recorded->frame_count;
    out_.recorded = std::make_shared<const Motion>(std::move(recorded).value());
    return Done{};
  }

  // A kinematic spec may hold loads and impacts too: they are checked, and wait for another mode.
  Result<Done> add_dynamics() {
    if (spec_.dynamics == DynamicsDesc{}) return Done{};
    Result<DynamicsSetup> dynamics = build_dynamics(spec_.dynamics, character_, out_.legs, out_.rate_hz, out_.start.q);
    if (!dynamics) return below("/dynamics", dynamics.issue());
    if (spec_.dynamics.mode == Mode::kinematic) return Done{};
    out_.dynamics = std::make_shared<const DynamicsSetup>(std::move(dynamics).value());
    if (out_.recorded) plant_recording();
    return Done{};
  }

  void plant_recording() {
    Motion planted = *out_.recorded;
    plant_feet(character_, out_.legs, out_.environment, planted);
    out_.recorded = std::make_shared<const Motion>(std::move(planted));
  }

  const Spec& spec_;
  const Character& character_;
  const Library& library_;
  Stage out_;
};

}  // namespace

Result<Stage> build_stage(const Spec& spec, const Library& library) {
  Result<Character> character = build_character(spec.character, library);
  if (!character) return below("/character", character.issue());
  return build_stage(spec, std::make_shared<const Character>(std::move(character).value()), library);
}

Result<Stage> build_stage(const Spec& spec, std::shared_ptr<const Character> character, const Library& library) {
  return StageBuilder(spec, std::move(character), library).build();
}

}  // namespace contort
