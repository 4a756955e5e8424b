#include "checks/fold.h"

#include <algorithm>
#include <utility>

namespace contort {

Family family_of(const std::string& character, const Finding& finding) {
  return {finding.check, character, finding.subject};
}

MarginFold::MarginFold(int subject_count, int merge_gap_frames, double resolution)
    : merge_gap_frames_(merge_gap_frames),
      least_(-resolution),
      smallest_(static_cast<std::size_t>(subject_count), std::numeric_limits<double>::infinity()),
      open_(static_cast<std::size_t>(subject_count), -1) {}

void MarginFold::tolerate(std::vector<double> tolerances, std::vector<std::uint8_t> phases, int phase_count) {
  tolerances_ = std::move(tolerances), phases_ = std::move(phases);
  phase_count_ = static_cast<std::size_t>(phase_count);
  plain_ = plain_ && tolerances_.empty();
}

void MarginFold::begin_at(int frame) {
  first_frame_ = frame;
  plain_ = plain_ && frame <= 0;
}

void MarginFold::record(int frame_count) {
  recorded_frames_ = static_cast<std::size_t>(frame_count);
  recorded_.assign(smallest_.size() * recorded_frames_, std::numeric_limits<double>::infinity());
  plain_ = false;
}

std::span<const double> MarginFold::recorded(int subject) const {
  return std::span(recorded_).subspan(static_cast<std::size_t>(subject) * recorded_frames_, recorded_frames_);
}

double MarginFold::tolerated_and_recorded(int subject, int frame, double margin) {
  if (frame < first_frame_) return std::numeric_limits<double>::infinity();
  const auto s = static_cast<std::size_t>(subject), f = static_cast<std::size_t>(frame);
  if (!tolerances_.empty()) {
    const double more = tolerances_[s * phase_count_ + (phases_.empty() ? 0 : phases_[f])];
    if (more == std::numeric_limits<double>::infinity()) return more;
    margin += more;
  }
  if (!recorded_.empty()) recorded_[s * recorded_frames_ + f] = margin;
  return margin;
}

void MarginFold::violated(int subject, int frame, double margin) {
  double& smallest = smallest_[static_cast<std::size_t>(subject)];
  const bool smallest_is_nan = smallest != smallest;  // NaN is the worst value and stays
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

bool MarginFold::is_ignored(std::size_t subject) const {
  if (tolerances_.empty()) return false;
  const double* of_phases = &tolerances_[subject * phase_count_];
  return std::all_of(of_phases, of_phases + phase_count_,
                     [](double more) { return more == std::numeric_limits<double>::infinity(); });
}

int MarginFold::judged_subjects() const {
  int count = 0;
  for (std::size_t s = 0; s < smallest_.size(); ++s)
    count += smallest_[s] != std::numeric_limits<double>::infinity() || (judged_all_ && !is_ignored(s));
  return count;
}

std::vector<MarginFold::Episode> MarginFold::episodes() const {
  std::vector<Episode> sorted = episodes_;
  std::sort(sorted.begin(), sorted.end(), [](const Episode& l, const Episode& r) {
    return l.first != r.first ? l.first < r.first : l.subject < r.subject;
  });
  return sorted;
}

}  // namespace contort
