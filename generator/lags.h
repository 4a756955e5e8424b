// Frames in which a part is not where its actions want it.
#pragma once

#include <vector>

#include "model/motion/intent.h"

namespace contort {

struct Lag {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int part = 0;
  Shortfall why = Shortfall::out_of_reach;
  bool operator==(const Lag&) const = default;
};

// Frames of one part must come in rising order. Memory is reused.
class LagRecorder {
 public:
  void begin(std::size_t part_count) { lag_of_.assign(part_count, -1), lags_.clear(); }

  void note(int frame, std::size_t part, Shortfall why) {
    int& entry = lag_of_[part];
    if (entry < 0 || lags_[static_cast<std::size_t>(entry)].last_frame < frame - 1) {
      entry = static_cast<int>(lags_.size());
      lags_.push_back({frame, frame, static_cast<int>(part), why});
    }
    Lag& lag = lags_[static_cast<std::size_t>(entry)];
    lag.last_frame = frame, lag.why = why;
  }

  const std::vector<Lag>& lags() const { return lags_; }

 private:
  std::vector<int> lag_of_;  // by part: its latest entry, or -1
  std::vector<Lag> lags_;
};

}  // namespace contort
