// Frames in which a part is not where its actions want it.
#pragma once

#include <optional>
#include <vector>

#include "model/motion/intent.h"

namespace contort {

struct Lag {
  int first_frame = 0;
  int last_frame = 0;  // inclusive
  int part = 0;
  std::optional<Shortfall> why;  // empty: the action is blending in or out
  bool operator==(const Lag&) const = default;
};

// Frames of one part must come in rising order. Memory is reused.
class LagRecorder {
 public:
  void begin(std::size_t part_count) { lag_of_.assign(part_count, -1), lags_.clear(); }

  void note(int frame, std::size_t part, std::optional<Shortfall> why) {
    int& entry = lag_of_[part];
    if (entry < 0 || !goes_on(lags_[static_cast<std::size_t>(entry)], frame, why)) {
      entry = static_cast<int>(lags_.size());
      lags_.push_back({frame, frame, static_cast<int>(part), why});
    }
    lags_[static_cast<std::size_t>(entry)].last_frame = frame;
  }

  const std::vector<Lag>& lags() const { return lags_; }

 private:
  static bool goes_on(const Lag& lag, int frame, std::optional<Shortfall> why) {
    return lag.last_frame >= frame - 1 && lag.why == why;
  }

  std::vector<int> lag_of_;  // by part: its latest entry, or -1
  std::vector<Lag> lags_;
};

}  // namespace contort
