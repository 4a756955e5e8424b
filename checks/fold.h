// Folds margins of frames into findings.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "checks/family.h"

namespace contort {

// An episode of negative margins of one subject.
struct Finding {
  std::string check;    // "joint_range"
  std::string subject;  // "arm_left/elbow max", "arm_left/forearm ~ torso/chest"
  std::string unit;     // unit of worst_margin
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  double worst_margin = 0.0;  // < 0, or NaN
  double depth = 0.0;         // -worst_margin / scale of the check: comparable between checks; infinite for NaN
  bool operator==(const Finding&) const = default;
};

Family family_of(const std::string& character, const Finding& finding);

// Folds margins while they are measured and stores only the open episode and the smallest margin of each subject.
// Frames of one subject must come in ascending order.
class MarginFold {
 public:
  struct Episode {
    int subject;
    int first, worst, last;
    double worst_margin;
  };

  // Margins down to -resolution count as 0.
  MarginFold(int subject_count, int merge_gap_frames, double resolution = 0.0);

  // Adds a tolerance to every margin of a subject, in all phases or in one. An infinite tolerance means that the
  // subject is not judged. If `phases` (of each frame) is empty, the first number of each subject counts for every
  // frame.
  void tolerate(std::vector<double> tolerances, std::vector<std::uint8_t> phases, int phase_count);

  // Margins of frames before this one are not judged.
  void begin_at(int frame);

  // Also stores the margins: frame_count of each subject.
  void record(int frame_count);
  // The stored margins of a subject, by frame; +infinity if it was not judged in that frame.
  std::span<const double> recorded(int subject) const;

  void report(int subject, int frame, double margin) {
    if (!plain_) {
      margin = tolerated_and_recorded(subject, frame, margin);
      if (margin == std::numeric_limits<double>::infinity()) return;
    }
    double& smallest = smallest_[static_cast<std::size_t>(subject)];
    if (margin >= least_) {
      if (margin < smallest) smallest = margin;
    } else {  // violated, or NaN
      violated(subject, frame, margin);
    }
  }

  // Margins of the subject that are not below this value change no result, and need not be reported.
  double matters_below(int subject) const {
    const double smallest = smallest_[static_cast<std::size_t>(subject)];
    if (!plain_) return std::numeric_limits<double>::infinity();
    return smallest > least_ ? smallest : least_;
  }

  // For checks that leave out margins: counts subjects without a margin as judged, too.
  void judged_all() { judged_all_ = true; }
  // The number of judged subjects: those with a margin, or counted by judged_all(). Subjects that the settings ignore
  // do not count.
  int judged_subjects() const;

  // Episodes in the order of their first frame, then of subjects.
  std::vector<Episode> episodes() const;

  // The smallest margin of each subject; +infinity if it was never judged.
  const std::vector<double>& smallest() const { return smallest_; }

 private:
  // Returns +infinity if the subject is not judged in this frame.
  double tolerated_and_recorded(int subject, int frame, double margin);
  void violated(int subject, int frame, double margin);
  bool is_ignored(std::size_t subject) const;

  int merge_gap_frames_;
  double least_;  // least margin that is not violated: -resolution
  std::vector<double> smallest_;
  std::vector<int> open_;  // per subject: index of its last episode, or -1
  std::vector<Episode> episodes_;
  bool plain_ = true;               // no tolerances, no records, all frames
  int first_frame_ = 0;
  std::vector<double> tolerances_;  // subjects x phases; empty: none
  std::vector<std::uint8_t> phases_;
  std::size_t phase_count_ = 1;
  bool judged_all_ = false;
  std::size_t recorded_frames_ = 0;
  std::vector<double> recorded_;  // subjects x frames
};

}  // namespace contort
