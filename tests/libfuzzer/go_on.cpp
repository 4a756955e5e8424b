#include "tests/libfuzzer/go_on.h"

#include <algorithm>
#include <cmath>

#include "checks/circumstances.h"
#include "checks/clip_speed.h"
#include "model/asset/sample.h"
#include "model/motion/recording.h"
#include "tests/stage_evaluator.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr int kFrames = 8;
constexpr int kSimulatedFrames = 2;  // up to 120 ticks each
constexpr double kRecordedFrames = 120.0;
constexpr std::size_t kManyJoints = 120;  // more than twice as many as any stock character has

bool is_finite(const Trs& trs) {
  bool finite = std::fabs(glm::length(trs.rotation) - 1.0) < 1e-9;
  for (int i = 0; i < 3; ++i) finite = finite && std::isfinite(trs.translation[i]) && std::isfinite(trs.scale[i]);
  return finite;
}

void pose_around(const Asset& asset, const AssetClip& clip) {
  for (int i = -1; i <= 5; ++i)
    for (const Trs& trs : pose(asset, clip, clip.first_s + i * 0.25 * (clip.last_s - clip.first_s)))
      require(is_finite(trs), "every pose of an accepted asset is finite");
}

// Uses the first nodes as the first joints, whatever their names are.
void follow(const Asset& asset, const AssetClip& clip, const Character& character) {
  std::map<std::string, std::string> joints;
  for (std::size_t i = 0; i < std::min(asset.nodes.size(), character.joints().size()); ++i)
    joints[asset.nodes[i].label] = character.joints()[i].name;
  const RecordingUse use{asset, clip, joints, 0.0, 30.0, 0, Rigid{}};
  if (frames_of(use) > kRecordedFrames) return;
  if (const Result<Motion> motion = follow_recording(character, use); !motion) require_clean(motion.issue());
}

}  // namespace

void require_clean(const Issue& issue) {
  require(issue.code.find('.') != std::string::npos && !issue.text.empty(), "a refusal has a code and a sentence");
  const std::string line = to_line(issue);
  require(std::ranges::none_of(line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }), "a refusal is one line");
}

bool play(const Spec& spec, const Library& library) {
  Result<Stage> built = build_stage(spec, library);
  if (!built) return require_clean(built.issue()), false;
  Stage stage = std::move(built).value();
  const bool is_large = stage.character->joints().size() > kManyJoints;
  if (is_large) stage.most_frames = 1, stage.dynamics = nullptr;
  stage.most_frames = std::min(stage.most_frames, stage.dynamics ? kSimulatedFrames : kFrames);
  if (stage.recorded && stage.recorded->frame_count > kFrames) stage.dynamics = nullptr;
  StageEvaluator evaluator;
  const Evaluation evaluation = evaluator.run(stage);
  const Execution& made = evaluator.execution();
  for (const Finding& finding : evaluation.findings)
    circumstances_of(*made.intent, *made.character, made.motion, finding.worst_frame);
  return true;
}

bool play_in_both_modes(Spec spec, const Library& library) {
  const bool moves = play(spec, library);
  spec.dynamics.mode = Mode::dynamic;
  play(spec, library);
  return moves;
}

void look_at(const Asset& asset) {
  static const Result<Character> human = build_character({}, stock_library());
  for (const AssetClip& clip : asset.clips) {
    pose_around(asset, clip);
    follow(asset, clip, *human);
  }
  check_clip_speeds(asset, {3000.0 * kRadPerDeg, {}});
}

}  // namespace contort::hostile
