// Lists the checks on which a verdict is based, and the checks that could not judge, with the reasons.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "checks/check.h"

namespace contort::cli {

// The results of one check over several motions.
struct JudgedTally {
  int motions = 0;                          // number of motions that it judged
  int subjects = 0;                         // greatest number of subjects in one motion
  std::map<std::string_view, int> reasons;  // number of motions that it could not judge, by reason
};

struct JudgedSummary {
  int motions = 0;          // number of motions or clips
  std::int64_t frames = 0;  // frames of motions of characters
  int channels = 0;         // channels of clips that some check judged; the greatest number in one clip
  int channel_count = 0;    // all channels of that clip
  int joints = 0;           // joints that were moved; the greatest number in one motion
  int joint_count = 0;      // joints of the character; 0 without one
  std::map<std::string, int> not_read;  // channels of all clips that no check can judge, by their kind
  std::map<std::string_view, JudgedTally> checks;

  void add(const std::vector<JudgedCheck>& judged, const std::vector<NotJudged>& not_judged);
};

// Returns "Judged: 19 checks on 22 of 26 joints, 61 limits, 240 frames", the subjects of each check, and a line for
// each check that could not judge.
std::vector<std::string> judged_lines(const JudgedSummary& summary);

// JSON lists: check and subjects; check and reason.
std::string judged_json(const std::vector<JudgedCheck>& judged);
std::string not_judged_json(const std::vector<NotJudged>& not_judged);

}  // namespace contort::cli
