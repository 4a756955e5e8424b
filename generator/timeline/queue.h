// The queue of sequences at run time: first in, first out, and interrupts (docs/reference/timeline.md has the rules).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/motion/motion.h"
#include "model/spec/clip.h"

namespace contort {

// The data of a sequence that the queue needs. Times are in the sequence's own frames.
struct PlannedClip {
  std::string name;
  int start = 0;  // first frame at or after its start and its end
  int end = 0;
};
struct PlannedSequence {
  std::string name;
  int length = 0;
  std::vector<PlannedClip> clips;
};

struct PlannedInterrupt {
  ConditionDesc when;
  int part = -1;      // contact, aim_reached
  int obstacle = -1;  // near_obstacle; -1 for any
  Enter enter = Enter::front;
  std::string after;
  bool resume = true;
  int sequence = 0;
};

class PlayQueue {
 public:
  // The first `queued` sequences wait in order; the others belong to interrupts. Both must outlive the queue. All
  // memory is allocated here.
  void start(std::span<const PlannedSequence> sequences, std::span<const PlannedInterrupt> interrupts, int queued);

  // Advances the queue to a frame: 0, 1, 2 …, each once. `signals` has an entry for each interrupt, true if its
  // condition holds, for those that the queue does not decide itself (see knows).
  void advance(int frame, std::span<const char> signals);

  // From now on no interrupt fires, and interrupts that wait for a clip's end do not enter.
  void leave_out_interrupts();

  bool idle() const { return !runs_ && waiting_.empty(); }
  bool has_fired(int interrupt) const { return fired_[static_cast<std::size_t>(interrupt)] != 0; }
  // The spans in which sequences ran; the last entry grows while it runs.
  std::span<const QueueSpan> history() const { return history_; }

  static bool knows(Event event) { return event <= Event::sequence_ended; }

 private:
  struct Waiting {
    int sequence = 0;
    int content = 0;  // the sequence's own frame at which it continues
  };
  struct Pending {  // waits for the end of a clip (after_clip)
    int holder = 0;
    int content = 0;  // the frame of the running sequence at which it is cut
    int interrupt = 0;
  };

  const PlannedSequence& running() const { return sequences_[static_cast<std::size_t>(history_.back().sequence)]; }
  int content(int frame) const { return history_.back().first_content + frame - history_.back().first_frame; }
  bool holds(const ConditionDesc& when, int frame, bool signal) const;
  bool clip_ended(const std::string& name) const;
  bool sequence_ended(const std::string& name) const;
  int present_clip(int frame) const;
  void note_progress(int frame);
  void end_or_cut(int frame);
  bool take_due(int frame, bool ended);
  void cut(int frame, bool resume);
  void insert_block();
  void fire(int frame, std::span<const char> signals);
  void place(int frame);
  void enter_after(const PlannedInterrupt& interrupt);
  void start_next(int frame);

  std::span<const PlannedSequence> sequences_;
  std::span<const PlannedInterrupt> interrupts_;
  std::vector<Waiting> waiting_;  // the next sequence comes first
  std::vector<Pending> pending_;
  std::vector<char> fired_;
  std::vector<int> fresh_;    // interrupts that fired in this frame
  std::vector<int> block_;    // interrupts that enter at the front now
  std::vector<int> reached_;  // per sequence: its furthest own frame, -1 before it began
  std::vector<char> ended_;   // per sequence: played to its end
  std::vector<QueueSpan> history_;
  bool runs_ = false;
};

}  // namespace contort
