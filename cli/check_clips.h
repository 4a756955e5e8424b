// contort check for animations made elsewhere: one file, or all clips of many.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/animation.h"
#include "cli/commands.h"

namespace contort::cli {

struct ClipCheckOptions {
  std::vector<std::string> files;   // with all_clips, folders too; without, one file
  std::string character;            // name of the character that the clips move; "" for none
  std::string map;                  // a file that maps nodes to joints of the character
  std::string clip;                 // "" for all
  std::vector<std::string> loops;   // clips with names like one of these are loops
  std::optional<double> max_gap_m;  // greatest distance of a joint from its rest place (part_gap); not judged if empty
  AnimationOptions animation;
  std::optional<double> rate_hz;  // frame rate of motions of the character; if empty, that of each clip
  double max_speed_deg_s = 3000.0;
  std::string accept_list;        // a file with findings that fail no run, "" for none
  std::string report;             // a folder for a page with pictures, "" for none
  std::string write_accept_list;  // file into which all findings are written as such a list; "" for none
  int jobs = 0;                   // threads; 0: one for each core
  bool all_clips = false;
  bool allow_unreadable = false;  // with all_clips: files that cannot be read do not fail the check
  bool json = false;
};

// Prints the findings and sets the exit code in the context.
void check_clips(const ClipCheckOptions& options, Context& context);

}  // namespace contort::cli
