// From margins to findings.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace contort {

// An episode of negative margins of one subject.
struct Finding {
  std::string check;    // "joint_range"
  std::string subject;  // "arm_left/elbow max", "arm_left/forearm ~ torso/chest"
  std::string unit;     // of worst_margin
  int first_frame = 0;
  int worst_frame = 0;
  int last_frame = 0;
  double worst_margin = 0.0;  // < 0, or NaN
  double depth = 0.0;         // -worst_margin / scale of the check: comparable between checks; infinite for NaN
  bool operator==(const Finding&) const = default;
};

// The identity of a failure, without numbers: "joint_range|human|arm_left/elbow max".
std::string family_of(const std::string& character, const Finding& finding);

// Folds margins as they are measured, without storing them: per subject the open episode and the smallest margin.
// Frames of one subject must come in rising order.
class MarginFold {
 public:
  struct Episode {
    int subject;
    int first, worst, last;
    double worst_margin;
  };

  // Margins down to -resolution count as 0.
  MarginFold(int subject_count, int merge_gap_frames, double resolution = 0.0);

  // Added to every margin of the subject, in all phases or in one; infinite: it is not judged. With `phases` (of each
  // frame) empty, the first number of each subject counts for every frame.
  void tolerate(std::vector<double> tolerances, std::vector<std::uint8_t> phases, int phase_count);

  void report(int subject, int frame, double margin) {
    if (!tolerances_.empty()) {
      const double more = tolerance(subject, frame);
      if (more == std::numeric_limits<double>::infinity()) return;
      margin += more;
    }
    double& smallest = smallest_[static_cast<std::size_t>(subject)];
    if (margin >= least_) {
      if (margin < smallest) smallest = margin;
    } else {  // violated, or NaN
      violated(subject, frame, margin);
    }
  }

  // Episodes in the order of their first frame, then of subjects.
  std::vector<Episode> episodes() const;

  // Smallest margin of each subject; +infinity where it was never judged.
  const std::vector<double>& smallest() const { return smallest_; }

 private:
  double tolerance(int subject, int frame) const {
    const std::size_t phase = phases_.empty() ? 0 : phases_[static_cast<std::size_t>(frame)];
    return tolerances_[static_cast<std::size_t>(subject) * phase_count_ + phase];
  }
  void violated(int subject, int frame, double margin);

  int merge_gap_frames_;
  double least_;  // that is not violated: -resolution
  std::vector<double> smallest_;
  std::vector<int> open_;  // per subject: index of its last episode, or -1
  std::vector<Episode> episodes_;
  std::vector<double> tolerances_;  // subjects x phases; empty: none
  std::vector<std::uint8_t> phases_;
  std::size_t phase_count_ = 1;
};

}  // namespace contort
