// The findings in clips, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/judge_clip.h"
#include "cli/animation.h"
#include "guest/finished_file.h"
#include "model/core/result.h"

namespace contort::cli {

// A joint and the most that it left out of its node's movement.
struct LeftOut {
  std::string joint;
  std::string node;
  double turn_rad = 0.0;
  double turn_s = 0.0;
  double offset_m = 0.0;
  double offset_s = 0.0;
};

// A clip as it moved a character.
struct ClipMotion {
  double rate_hz = 0.0;
  double first_s = 0.0;
  int frames = 0;
  int joints = 0;       // that follow nodes
  int joint_count = 0;  // of the character
  RootPath path = RootPath::told;
  std::vector<LeftOut> left_out;            // of each joint that left out anything
  std::vector<std::string> stray_nodes;     // that move and are no joint
  std::vector<std::string> joints_at_rest;  // without a node
};

struct ClipReport {
  std::string file;
  ClipEvaluation judged;
  std::optional<ClipMotion> motion;  // on a character
  double rate_hz = 0.0;              // of an .amc, with the number of its first frame
  int first_frame = 0;
  std::size_t similar_names = 0;     // nodes that have other prefixes than the map says
};

ClipMotion motion_of_clip(const Asset& asset, const AssetClip& clip, const Conversion& made);

std::size_t count_findings(const std::vector<ClipReport>& clips);

// Compares in the scales of the checks: by the least margin of all, then by the greatest speed.
bool is_worse(const ClipReport& a, const ClipReport& b);

void print_clip(const ClipReport& clip);       // a line, and one for each finding
void print_clip_line(const ClipReport& clip);  // one line, with the file

// Checks that judged in all of them, and checks that could not.
void print_judged(const std::vector<ClipReport>& clips);

// "OK …" or "FAILED …", and the line for scripts with `more` at its end. `missing` says what could not be judged: where
// it is not empty, nothing is OK.
void print_result(std::size_t findings, std::size_t clips, const std::string& missing, const std::string& more);

// `waivers` is JSON (print.h). A file and its clips; or clips of many files, and the files that could not be read.
struct FileRemark {
  std::string file;
  Remark remark;
};
struct ManyFiles {
  const std::vector<ClipReport>& clips;
  const std::vector<Unreadable>& unreadable;
  const std::vector<Unreadable>& skipped;
  const std::vector<FileRemark>& remarks;
};
void print_json(const std::string& file, const std::vector<ClipReport>& clips, const std::vector<FileRemark>& remarks,
                const std::string& waivers);
void print_json(const ManyFiles& files, const std::string& waivers);

}  // namespace contort::cli
