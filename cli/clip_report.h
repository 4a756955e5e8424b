// What was found in clips, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/clip_speed.h"
#include "checks/dof_limits.h"
#include "cli/animation.h"
#include "model/core/result.h"

namespace contort::cli {

struct ClipReport {
  std::string file;
  ClipSpeeds speeds;
  std::optional<DofLimits> limits;  // of an .amc
  std::vector<Finding> seams;       // of a loop
  std::vector<Finding> gaps;        // joints out of their places
  double rate_hz = 0.0;             // of an .amc, with the number of its first frame
  int first_frame = 0;
};

std::size_t count_findings(const std::vector<ClipReport>& clips);

// How bad, in the scales of the checks: the least margin of all, then the greatest speed.
bool is_worse(const ClipReport& a, const ClipReport& b);

void print_clip(const ClipReport& clip);       // a line, and one for each finding
void print_clip_line(const ClipReport& clip);  // one line, with the file

// "OK …" or "FAILED …", and the line for scripts with `more` at its end. `missing` says what could not be judged: where
// it is not empty, nothing is OK.
void print_result(std::size_t findings, std::size_t clips, const std::string& missing, const std::string& more);

// `waivers` is JSON (print.h). A file and its clips; or clips of many files, and the files that could not be read.
void print_json(const std::string& file, const std::vector<ClipReport>& clips, const std::string& waivers);
void print_json(const std::vector<ClipReport>& clips, const std::vector<Unreadable>& unreadable,
                const std::string& waivers);

}  // namespace contort::cli
