// The worst finding of a clip, and the pose in which it happens, for a report.
#pragma once

#include <optional>
#include <string>

#include "cli/animation.h"
#include "cli/clip_character.h"
#include "cli/clip_report.h"
#include "renders/stick_figure.h"

namespace contort::cli {

struct WorstMoment {
  Finding finding;
  std::string measured;          // "9000.0 deg/s, allowed 3000.0"
  std::optional<double> time_s;  // time in the clip; empty for findings without a time
  int frame = -1;                // frame of the character's motion; -1 if the finding is about the clip itself
};

// Returns nullopt if the clip has no finding.
std::optional<WorstMoment> worst_moment(const ClipReport& clip);

// "joint_range 15, pop 3"
std::string counts_of_checks(const ClipReport& clip);

// The pose at that moment, of the moved character or, without one, of the file's own skeleton. The joints of the
// finding are marked. Without a finding it has no points.
StickFigure worst_pose(const ClipCharacter& on, const Animation& animation, const AssetClip& clip,
                       const ClipReport& report);

}  // namespace contort::cli
