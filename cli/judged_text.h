// A verdict rests on the checks that judged; those that could not are listed with their reasons.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "checks/check.h"

namespace contort::cli {

// One check over several motions.
struct JudgedTally {
  int motions = 0;                          // in which it judged
  int subjects = 0;                         // the most in one of them
  std::map<std::string_view, int> reasons;  // why it could not judge, and in how many motions
};

struct JudgedSummary {
  int motions = 0;          // or clips
  std::int64_t frames = 0;  // of motions of characters
  int channels = 0;         // of clips, that some check judged; the most in one of them
  int channel_count = 0;    // of that clip
  int joints = 0;           // that were moved, the most in one motion
  int joint_count = 0;      // of the character; 0 without
  std::map<std::string, int> not_read;  // channels of all clips that no check can judge, by their kind
  std::map<std::string_view, JudgedTally> checks;

  void add(const std::vector<JudgedCheck>& judged, const std::vector<NotJudged>& not_judged);
};

// "Judged: 19 checks on 22 of 26 joints, 61 limits, 240 frames", what each judged, and a line for each that could not.
std::vector<std::string> judged_lines(const JudgedSummary& summary);

// JSON lists: check and subjects; check and reason.
std::string judged_json(const std::vector<JudgedCheck>& judged);
std::string not_judged_json(const std::vector<NotJudged>& not_judged);

}  // namespace contort::cli
