// The findings in clips, as text and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checks/judge_clip.h"
#include "cli/animation.h"
#include "guest/finished_file.h"
#include "model/core/result.h"
#include "model/motion/execution.h"
#include "renders/stick_figure.h"

namespace contort::cli {

// A joint, and the greatest movement of its node that it could not follow.
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
  int joints = 0;       // number of joints that follow nodes or columns
  int joint_count = 0;  // number of joints of the character
  RootPath path = RootPath::told;
  std::vector<LeftOut> left_out{};          // for each joint that left out movement
  std::vector<std::string> stray_nodes{};   // nodes that move but have no joint
  std::vector<std::string> joints_at_rest{};  // joints without a node
  // The next fields are for tables of joint values. Columns without a joint are in stray_nodes.
  int columns = 0;                            // number of columns that joints follow; 0 for a clip
  int column_count = 0;                       // number of all columns except for the times
  std::vector<double> times_s{};              // times of the frames, if their steps are uneven
  std::vector<std::string> root_columns{};    // columns with the root's pose
  std::vector<std::string> fixed_columns{};   // columns of joints that are fixed in the character
  std::vector<std::string> computed{};        // joints without a column that follow others

  double time_s(int frame) const {
    return times_s.empty() ? first_s + frame / rate_hz : times_s[static_cast<std::size_t>(frame)];
  }
};

struct ClipReport {
  std::string file;
  ClipEvaluation judged;
  std::optional<ClipMotion> motion;  // the clip as a motion of a character
  double rate_hz = 0.0;              // of an .amc, like the number of its first frame
  int first_frame = 0;
  std::size_t similar_names = 0;     // number of nodes whose prefixes differ from the map's
  std::optional<Execution> made{};   // the motion on the character, until the worst pose is taken from it
  std::vector<std::string> motion_texts{};  // failed_text() of each of judged.motion_findings
  StickFigure worst_pose{};          // of the deepest finding; only for a report
};

ClipMotion motion_of_clip(const Asset& asset, const AssetClip& clip, const Conversion& made);

std::size_t count_findings(const std::vector<ClipReport>& clips);

// Compares clips by their least margin, in the scales of the checks, and then by their greatest speed.
bool is_worse(const ClipReport& a, const ClipReport& b);

void print_clip(const ClipReport& clip);       // prints a line, and one for each finding
void print_clip_line(const ClipReport& clip);  // prints one line with the file

// Prints the checks that judged in all of them, and the checks that could not.
void print_judged(const std::vector<ClipReport>& clips);

// Prints "OK …" or "FAILED …", and the line for scripts with `more` at its end. `missing` names files that could not be
// judged; if it is not empty, the verdict is not OK.
void print_result(std::size_t findings, std::size_t clips, const std::string& missing, const std::string& more);

// The result as JSON: a file and its clips; or clips of many files, and the files that could not be read. `waivers` is
// JSON (print.h).
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
