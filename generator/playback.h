// The state of the queue in one frame of the motion: the running sequences, and the actions in them.
#pragma once

#include <algorithm>
#include <span>

#include "generator/level.h"
#include "generator/timeline/timeline.h"
#include "model/core/index.h"

namespace contort {

// A view of a timeline and of its queue's history in one frame; both must outlive it. A run is an entry of the history.
// Its content is the frame of its own sequence, which continues from where an interrupt cut it. Actions that a level
// leaves out do not move their parts. `acquired` has, for each of the timeline's further actions, the frame from which
// it is in force; kDormant: never.
class Playback {
 public:
  static constexpr int kDormant = 1 << 30;

  Playback(const Timeline& timeline, std::span<const QueueSpan> history, const LevelPlay& level,
           std::span<const int> acquired, double rate_hz, int frame)
      : timeline_(timeline), history_(history), level_(level), acquired_(acquired), rate_hz_(rate_hz), frame_(frame) {}

  int frame() const { return frame_; }
  double rate_hz() const { return rate_hz_; }
  const PlannedAction& action(int index) const { return timeline_.actions[at(index)]; }
  const QueueSpan& run(int index) const { return history_[at(index)]; }

  // Returns a run in the form for actions: frames that a level leaves out count as cut.
  QueueSpan run_of(const PlannedAction& action, int index) const {
    QueueSpan run = history_[at(index)];
    if (level_.is_left_out(action, frame_)) run.last_frame = std::min(run.last_frame, level_.first_frame());
    return run;
  }

  static int content(const QueueSpan& run, int frame) { return run.first_content + frame - run.first_frame; }
  int content(const QueueSpan& run) const { return content(run, frame_); }

  // The content frame at which an action takes its part in a run: its start, or where the sequence continued or the
  // action was acquired.
  double comes(const PlannedAction& action, const QueueSpan& run) const {
    const double begins = std::max(action.start, static_cast<double>(run.first_content));
    return action.further < 0 ? begins : std::max<double>(begins, content(run, acquired_[at(action.further)]));
  }
  // The frame of the motion at which an action takes its part in a run.
  double began(const PlannedAction& action, const QueueSpan& run) const {
    return comes(action, run) - run.first_content + run.first_frame;
  }

  // Returns true if an action moves its part in this frame of a run.
  bool moves(const PlannedAction& action, const QueueSpan& run) const {
    if (level_.is_left_out(action, frame_)) return false;
    if (action.further >= 0 && frame_ < acquired_[at(action.further)]) return false;
    return content(run) >= action.first_frame && content(run) <= action.last_frame;
  }

  // Calls visit(run index, action index) for all actions of a layer on a part, in runs that had not ended `ago` frames
  // before this one. Two runs overlap in the frame in which the second follows the first.
  template <class Visit>
  void for_each(std::size_t part, Layer layer, int ago, Visit visit) const {
    std::size_t first = history_.size();
    while (first > 0 && history_[first - 1].last_frame >= frame_ - ago) --first;
    for (std::size_t r = first; r < history_.size(); ++r)
      for (const int a : timeline_.of_part[at(history_[r].sequence) * timeline_.part_order.size() + part])
        if (action(a).def->layer == layer) visit(static_cast<int>(r), a);
  }

 private:
  const Timeline& timeline_;
  std::span<const QueueSpan> history_;
  const LevelPlay& level_;
  std::span<const int> acquired_;
  double rate_hz_;
  int frame_;
};

}  // namespace contort
