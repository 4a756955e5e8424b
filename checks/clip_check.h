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
  bool is_loop = false;             // somebody says that it is played in a loop
  std::optional<double> max_gap_m;  // joints farther from their places are faults; nothing says so without
  const std::vector<ClipFoot>* feet = nullptr;  // of the file's own skeleton; null: a character's are judged
};

// A finding of a clip. Its frames are numbers of keys.
struct KeyFinding : Finding {
  double t0_s = 0.0;  // the time of the worst key; or from the key before it, if a step is what is wrong
  double t1_s = 0.0;
  std::string what;  // the finding in words; "" if the margin says everything
};

struct ClipCheckResult {
  int subjects = 0;          // number of judged subjects
  std::string_view why_not;  // the reason if it judged nothing
  std::vector<KeyFinding> findings;
};

}  // namespace contort
