// Judges a clip of an animation file by the checks that need no character, and adds the findings of a character's
// motion if there is one.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "checks/clip_check.h"
#include "checks/clip_speed.h"
#include "checks/dof_limits.h"
#include "checks/judge.h"

namespace contort {

// Motion capture that declares limits of its own.
struct Capture {
  const AsfSkeleton& skeleton;
  const AmcMotion& motion;
};

struct ClipEvaluation {
  ClipSpeeds speeds;                     // angular_velocity and pop of channels
  std::optional<DofLimits> limits;       // joint_range of a capture
  std::vector<KeyFinding> clip_findings;  // of the manifest's checks of clips; frames are keys
  std::vector<Finding> motion_findings;  // of the character's motion
  int channels = 0;                      // that some check judged: those with two keys or more
  int channel_count = 0;                 // of the clip, with those that are not read
  std::map<std::string, int> not_read;   // of these, by their kind
  std::vector<JudgedCheck> judged;       // of all of them, in the manifest's order, like the next
  std::vector<NotJudged> not_judged;
};

ClipEvaluation judge_clip(const ClipInput& in, const SpeedLimits& limits, const Capture* capture);

// Joints whose speed in the motion is not to be judged.
struct SpeedsElsewhere {
  std::set<std::string> in_channels;   // their node's own channel is, exactly between its keys: a speed is judged once
  std::set<std::string> not_followed;  // their coordinates say nothing of how their nodes turn; nor of accelerations
};

// Adds the findings of the clip's motion of a character.
void add_motion(const Evaluation& motion, const SpeedsElsewhere& elsewhere, ClipEvaluation& into);

}  // namespace contort
