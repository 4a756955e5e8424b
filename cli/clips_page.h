// The page of contort check --report: many clips, the worst first, each with the pose of its worst moment.
#pragma once

#include <string>
#include <vector>

#include "cli/check_clips.h"
#include "cli/clip_report.h"
#include "cli/commands.h"

namespace contort::cli {

struct ClipsPageInput {
  const ClipCheckOptions& options;
  const std::vector<ClipReport>& clips;
  const std::vector<Unreadable>& unreadable;
};

// Code folder.other_files if the folder has files and no such page.
Result<Done> check_clips_page(const std::string& folder);

// Writes DIR/index.html and prints its path; does nothing without --report. Code file.unwritable.
Result<Done> write_clips_page(const ClipsPageInput& in, const Context& context);

}  // namespace contort::cli
