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
  std::optional<DofLimits> limits;       // joint_range of a motion capture
  std::vector<KeyFinding> clip_findings;  // findings of the manifest's checks of clips; frames are keys
  std::vector<Finding> motion_findings;  // findings in the character's motion
  int channels = 0;                      // channels that some check judged: those with two keys or more
  int channel_count = 0;                 // channels of the clip, including those that were not read
  std::map<std::string, int> not_read;   // the number of channels that were not read, by their kind
  std::vector<JudgedCheck> judged;       // checks that judged, in the manifest's order, like the next
  std::vector<NotJudged> not_judged;
};

ClipEvaluation judge_clip(const ClipInput& in, const SpeedLimits& limits, const Capture* capture);

// The joints, and limits of joints, that some checks must skip in the motion because they are judged elsewhere.
struct JudgedElsewhere {
  // Joints whose own channel in the file is judged, exactly between its keys. Their speed is not judged twice.
  std::set<std::string> in_channels{};
  // Joints whose coordinates do not follow the rotation of their nodes; their speeds and accelerations are not judged.
  std::set<std::string> not_followed{};
  // Limits such as "arm/wrist max" that the file declares itself; they are judged on the file's own numbers.
  std::set<std::string> in_file{};
};

// Adds the findings of the clip's motion of a character.
void add_motion(const Evaluation& motion, const JudgedElsewhere& elsewhere, ClipEvaluation& into);

}  // namespace contort
