// contort check of a table of joint values: its rows are judged as a motion of a character.
#pragma once

#include <string>

#include "checks/judge_clip.h"
#include "cli/animation.h"
#include "cli/clip_character.h"
#include "cli/clip_report.h"

namespace contort::cli {

struct TableCheck {
  const std::string& file;
  const Animation& animation;  // with a table
  const ClipCharacter& on;
  const SpeedLimits& limits;
  const AnimationOptions& options;
};

// Codes check.needs_character, usage.no_root and those of motion_of_values.
Result<ClipReport> check_table(const TableCheck& table, Judge& judge);

}  // namespace contort::cli
