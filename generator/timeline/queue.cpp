#include "generator/timeline/queue.h"

#include <algorithm>

namespace contort {

void PlayQueue::start(std::span<const PlannedSequence> sequences, std::span<const PlannedInterrupt> interrupts,
                      int queued) {
  sequences_ = sequences, interrupts_ = interrupts;
  const std::size_t all = sequences.size(), rules = interrupts.size();
  waiting_.clear(), pending_.clear(), fresh_.clear(), block_.clear(), history_.clear();
  waiting_.reserve(all), pending_.reserve(rules), fresh_.reserve(rules), block_.reserve(rules);
  history_.reserve(all + rules);  // each interrupt cuts at most one sequence in two
  fired_.assign(rules, 0), ended_.assign(all, 0), reached_.assign(all, -1);
  for (int s = 0; s < queued; ++s) waiting_.push_back({s, 0});
  runs_ = false;
}

void PlayQueue::advance(int frame, std::span<const char> signals) {
  // Sequences without length begin and end in one frame, so this may take several rounds.
  do {
    end_or_cut(frame);
    fire(frame, signals);
    place(frame);
    if (!runs_) start_next(frame);
  } while (runs_ && content(frame) >= running().length);
  note_progress(frame);
}

void PlayQueue::leave_out_interrupts() {
  std::ranges::fill(fired_, 1);
  pending_.clear();
}

void PlayQueue::note_progress(int frame) {
  if (!runs_) return;
  history_.back().last_frame = frame;
  int& reached = reached_[static_cast<std::size_t>(history_.back().sequence)];
  reached = std::max(reached, content(frame));
}

void PlayQueue::end_or_cut(int frame) {
  if (!runs_) return;
  note_progress(frame);
  const bool ended = content(frame) >= running().length;
  const bool resume = take_due(frame, ended);
  if (ended) {
    ended_[static_cast<std::size_t>(history_.back().sequence)] = 1;
    runs_ = false;
  } else if (!block_.empty()) {
    cut(frame, resume);
  }
  insert_block();
}

// Moves the interrupts that enter in the running sequence now to the block; answers whether its rest goes on later.
bool PlayQueue::take_due(int frame, bool ended) {
  const int holder = history_.back().sequence;
  const auto due = [&](const Pending& p) { return p.holder == holder && (ended || p.content <= content(frame)); };
  bool resume = true;
  for (const Pending& p : pending_)
    if (due(p)) {
      block_.push_back(p.interrupt);
      resume = resume && interrupts_[static_cast<std::size_t>(p.interrupt)].resume;
    }
  std::erase_if(pending_, due);
  return resume;
}

// Stops the running sequence in this frame. What waited for a clip of a rest that is dropped enters with the block.
void PlayQueue::cut(int frame, bool resume) {
  const QueueSpan& span = history_.back();
  if (resume)
    waiting_.insert(waiting_.begin(), {span.sequence, content(frame)});
  else
    take_due(frame, true);
  runs_ = false;
}

void PlayQueue::insert_block() {
  for (std::size_t i = block_.size(); i-- > 0;)
    waiting_.insert(waiting_.begin(), {interrupts_[static_cast<std::size_t>(block_[i])].sequence, 0});
  block_.clear();
}

bool PlayQueue::clip_ended(const std::string& name) const {
  for (std::size_t s = 0; s < sequences_.size(); ++s)
    for (const PlannedClip& clip : sequences_[s].clips)
      if (clip.name == name && reached_[s] >= clip.end) return true;
  return false;
}

bool PlayQueue::sequence_ended(const std::string& name) const {
  for (std::size_t s = 0; s < sequences_.size(); ++s)
    if (ended_[s] != 0 && sequences_[s].name == name) return true;
  return false;
}

bool PlayQueue::holds(const ConditionDesc& when, int frame, bool signal) const {
  if (when.event == Event::frame) return frame >= when.frame;
  if (when.event == Event::clip_ended) return clip_ended(when.name);
  if (when.event == Event::sequence_ended) return sequence_ended(when.name);
  return signal;
}

void PlayQueue::fire(int frame, std::span<const char> signals) {
  fresh_.clear();
  for (std::size_t i = 0; i < interrupts_.size(); ++i)
    if (fired_[i] == 0 && holds(interrupts_[i].when, frame, signals[i] != 0)) {
      fired_[i] = 1;
      fresh_.push_back(static_cast<int>(i));
    }
}

// The clip that started last of those running, or -1.
int PlayQueue::present_clip(int frame) const {
  if (!runs_) return -1;
  const std::vector<PlannedClip>& clips = running().clips;
  const int now = content(frame);
  int present = -1;
  for (std::size_t c = 0; c < clips.size(); ++c)
    if (clips[c].start <= now && clips[c].end > now &&
        (present < 0 || clips[c].start >= clips[static_cast<std::size_t>(present)].start))
      present = static_cast<int>(c);
  return present;
}

// Gives the interrupts that fired their places.
void PlayQueue::place(int frame) {
  const int clip = present_clip(frame);
  const auto at_once = [&](Enter enter) { return enter == Enter::front || (enter == Enter::after_clip && clip < 0); };
  bool resume = true;
  for (const int i : fresh_) {
    const PlannedInterrupt& interrupt = interrupts_[static_cast<std::size_t>(i)];
    if (at_once(interrupt.enter)) {
      block_.push_back(i);
      resume = resume && interrupt.resume;
    } else if (interrupt.enter == Enter::after_clip) {
      pending_.push_back({history_.back().sequence, running().clips[static_cast<std::size_t>(clip)].end, i});
    }
  }
  if (runs_ && !block_.empty()) cut(frame, resume);
  insert_block();
  for (std::size_t f = fresh_.size(); f-- > 0;) {  // the last one first, so that the first one ends up next to its place
    const PlannedInterrupt& interrupt = interrupts_[static_cast<std::size_t>(fresh_[f])];
    if (interrupt.enter == Enter::after_sequence) enter_after(interrupt);
  }
  for (const int i : fresh_)
    if (interrupts_[static_cast<std::size_t>(i)].enter == Enter::end)
      waiting_.push_back({interrupts_[static_cast<std::size_t>(i)].sequence, 0});
}

void PlayQueue::enter_after(const PlannedInterrupt& interrupt) {
  const auto named = [&](const Waiting& w) {
    return sequences_[static_cast<std::size_t>(w.sequence)].name == interrupt.after;
  };
  auto place = waiting_.begin();
  if (!runs_ || running().name != interrupt.after) {
    place = std::find_if(waiting_.begin(), waiting_.end(), named);
    if (place != waiting_.end()) ++place;
  }
  waiting_.insert(place, {interrupt.sequence, 0});
}

void PlayQueue::start_next(int frame) {
  if (waiting_.empty()) return;
  const Waiting next = waiting_.front();
  waiting_.erase(waiting_.begin());
  history_.push_back({frame, frame, next.sequence, next.content});
  runs_ = true;
  note_progress(frame);
}

}  // namespace contort
