#include "checks/fold.h"

#include <algorithm>
#include <utility>

namespace contort {

std::string family_of(const std::string& character, const Finding& finding) {
  return finding.check + "|" + character + "|" + finding.subject;
}

MarginFold::MarginFold(int subject_count, int merge_gap_frames, double resolution)
    : merge_gap_frames_(merge_gap_frames),
      least_(-resolution),
      smallest_(static_cast<std::size_t>(subject_count), std::numeric_limits<double>::infinity()),
      open_(static_cast<std::size_t>(subject_count), -1) {}

void MarginFold::tolerate(std::vector<double> tolerances, std::vector<std::uint8_t> phases, int phase_count) {
  tolerances_ = std::move(tolerances), phases_ = std::move(phases);
  phase_count_ = static_cast<std::size_t>(phase_count);
}

void MarginFold::violated(int subject, int frame, double margin) {
  double& smallest = smallest_[static_cast<std::size_t>(subject)];
  const bool smallest_is_nan = smallest != smallest;  // worse than anything: it stays
  if (!smallest_is_nan && !(margin >= smallest)) smallest = margin;
  int& open = open_[static_cast<std::size_t>(subject)];
  if (open < 0 || frame - episodes_[static_cast<std::size_t>(open)].last > merge_gap_frames_ + 1) {
    open = static_cast<int>(episodes_.size());
    episodes_.push_back({subject, frame, frame, frame, margin});
    return;
  }
  Episode& episode = episodes_[static_cast<std::size_t>(open)];
  episode.last = frame;
  const bool worst_is_nan = episode.worst_margin != episode.worst_margin;
  if (!worst_is_nan && !(margin >= episode.worst_margin)) {
    episode.worst = frame;
    episode.worst_margin = margin;
  }
}

std::vector<MarginFold::Episode> MarginFold::episodes() const {
  std::vector<Episode> sorted = episodes_;
  std::sort(sorted.begin(), sorted.end(), [](const Episode& l, const Episode& r) {
    return l.first != r.first ? l.first < r.first : l.subject < r.subject;
  });
  return sorted;
}

}  // namespace contort
