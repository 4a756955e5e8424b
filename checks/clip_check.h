// A check of a clip of an animation file, without a character: a row CLIP of the manifest and a function foo_in_clip.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checks/check.h"
#include "checks/clip_feet.h"
#include "model/asset/asset.h"

namespace contort {

struct ClipInput {
  const Asset& asset;
  const AssetClip& clip;
  const CheckSettings& settings;
  bool is_loop = false;             // the user says that the clip is played in a loop
  // Greatest allowed distance of a joint from its place; without it, joints may be anywhere.
  std::optional<double> max_gap_m;
  const std::vector<ClipFoot>* feet = nullptr;  // feet of the file's own skeleton; null: a character's feet are judged
};

// A finding of a clip. Its frames are numbers of keys.
struct KeyFinding : Finding {
  double t0_s = 0.0;  // time of the worst key; for a step, the time of the key before it
  double t1_s = 0.0;
  std::string what;  // the finding in words; "" if the margin says everything
};

struct ClipCheckResult {
  int subjects = 0;          // number of judged subjects
  std::string_view why_not;  // the reason if it judged nothing
  std::vector<KeyFinding> findings;
};

}  // namespace contort
