// Short specs for tests: one line for each action.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "generator/generate.h"
#include "tests/character/stock.h"

namespace contort::fixtures {

// It takes its part at once.
inline ActionUse use(const std::string& action, const std::string& slot, int start_frame, int duration_frames,
                     std::map<std::string, ParamValue> params) {
  ActionUse made;
  made.action = action, made.slot = slot;
  made.start_frame = start_frame, made.duration_frames = duration_frames;
  made.blend_in_frames = 0;
  made.params = std::move(params);
  return made;
}

inline ActionUse elbow(int start_frame, int duration_frames, double angle_deg) {
  return use("pose", "arm_left", start_frame, duration_frames, {{"elbow_deg", angle_deg}});
}

inline SequenceDesc sequence(std::vector<ActionUse> actions) {
  ClipDesc clip;
  clip.actions = std::move(actions);
  SequenceDesc made;
  made.clips = {clip};
  return made;
}

inline std::shared_ptr<const Character> shared_human() {
  static const auto character = std::make_shared<const Character>(human());
  return character;
}

inline Stage stage_of(std::vector<SequenceDesc> sequences, int hold_frames = 0,
                      std::shared_ptr<const Character> character = shared_human()) {
  Spec spec;
  spec.sequences = std::move(sequences);
  spec.hold_frames = hold_frames;
  const Result<Stage> stage = build_stage(spec, std::move(character));
  if (!stage) ADD_FAILURE() << to_line(stage.issue());
  return stage ? *stage : Stage{};
}

inline double coord(const Motion& motion, int frame, const Character& character, std::string_view joint_name) {
  return motion.row(frame)[static_cast<std::size_t>(joint(character, joint_name).coord)];
}

}  // namespace contort::fixtures
