// Divides the time of a run. All times are on the steady clock and come from the caller.
#pragma once

#include <algorithm>

namespace contort {

class TimeBudget {
 public:
  // `limit_s` 0: there is no limit.
  TimeBudget(double limit_s, double start_s) : limit_s_(limit_s), start_s_(start_s) {}

  double deadline_s() const { return is_limited() ? start_s_ + limit_s_ : 0.0; }
  double elapsed_s(double now_s) const { return now_s - start_s_; }
  bool is_over(double now_s) const { return is_limited() && now_s >= deadline_s(); }

  // At most half of the run's time is used for failures that earlier runs left.
  bool has_time_for_waiting(double now_s) const { return !is_limited() || now_s < start_s_ + 0.5 * limit_s_; }

  // When the last round begins, half of the remaining time is reserved for processing its failures.
  void begin_round(double now_s) { fold_at_s_ = 0.5 * (now_s + deadline_s()); }
  bool must_fold(double now_s) const { return is_limited() && now_s >= fold_at_s_; }

 private:
  bool is_limited() const { return limit_s_ > 0.0; }

  double limit_s_, start_s_;
  double fold_at_s_ = 0.0;
};

// Decides when to store the state of a run: as often as possible within 2 % of the time.
class KeepingPace {
 public:
  explicit KeepingPace(double start_s) : next_s_(start_s + kEvery_s) {}
  bool is_due(double now_s) const { return now_s >= next_s_; }
  void kept(double began_s, double ended_s) { next_s_ = ended_s + std::max(kEvery_s, 50.0 * (ended_s - began_s)); }

 private:
  static constexpr double kEvery_s = 1.0;
  double next_s_;
};

}  // namespace contort
