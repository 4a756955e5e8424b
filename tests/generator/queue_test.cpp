// The queue against a reference that does the same with plain lists, from the table in docs/reference/timeline.md.
#include "generator/timeline/queue.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace contort {

// Prints a history in messages of failed tests.
std::ostream& operator<<(std::ostream& out, const QueueSpan& span) {
  return out << "[" << span.first_frame << "-" << span.last_frame << " sequence " << span.sequence << " from "
             << span.first_content << "]";
}

namespace {

struct Script {
  std::vector<PlannedSequence> sequences;
  std::vector<PlannedInterrupt> interrupts;
  int queued = 0;
  std::vector<std::vector<char>> signals;  // by frame
};

class Reference {
 public:
  explicit Reference(const Script& script) : s_(script), fired_(s_.interrupts.size()), ended_(s_.sequences.size()) {
    for (int i = 0; i < s_.queued; ++i) line_.push_back({i, 0, {}});
    seen_.assign(s_.sequences.size(), -1);
  }
  std::vector<QueueSpan> play() {
    for (int frame = 0; frame < static_cast<int>(s_.signals.size()); ++frame) {
      while (step(frame)) {
      }
      if (on_) line_.front().at += 1;
    }
    return history_;
  }

 private:
  struct Item {
    int sequence, at;
    std::vector<std::pair<int, int>> waits;  // own frame, interrupt
  };
  const PlannedSequence& of(const Item& item) const { return s_.sequences[static_cast<std::size_t>(item.sequence)]; }
  const PlannedInterrupt& rule(int i) const { return s_.interrupts[static_cast<std::size_t>(i)]; }

  // Ends the running item. `entering` comes next, and then its rest if it continues later.
  void stop(std::vector<int> entering, bool rest) {
    Item item = line_.front();
    line_.pop_front();
    on_ = false;
    if (rest) line_.push_front(item);
    if (!rest)
      for (const auto& wait : item.waits) entering.push_back(wait.second);
    for (std::size_t i = entering.size(); i-- > 0;) line_.push_front({rule(entering[i]).sequence, 0, {}});
  }

  bool true_now(int i, int frame) const {
    const ConditionDesc& when = rule(i).when;
    if (when.event == Event::frame) return frame >= when.frame;
    bool held = false;
    for (std::size_t s = 0; s < s_.sequences.size(); ++s) {
      if (when.event == Event::sequence_ended) held |= ended_[s] && s_.sequences[s].name == when.name;
      for (const PlannedClip& clip : s_.sequences[s].clips)
        if (when.event == Event::clip_ended) held |= clip.name == when.name && seen_[s] >= clip.end;
    }
    return held || (when.event > Event::sequence_ended &&
                    s_.signals[static_cast<std::size_t>(frame)][static_cast<std::size_t>(i)] != 0);
  }

  bool step(int frame) {
    if (on_) {
      Item& item = line_.front();
      history_.back().last_frame = frame;
      int& seen = seen_[static_cast<std::size_t>(item.sequence)];
      seen = std::max(seen, item.at);
      const bool over = item.at >= of(item).length;
      std::vector<int> due;
      bool resume = !over;
      for (auto wait = item.waits.begin(); wait != item.waits.end();)
        if (over || wait->first <= item.at) {
          due.push_back(wait->second);
          resume = resume && rule(wait->second).resume;
          wait = item.waits.erase(wait);
        } else {
          ++wait;
        }
      if (over) ended_[static_cast<std::size_t>(item.sequence)] = true;
      if (over || !due.empty()) stop(due, resume);
    }
    std::vector<int> fresh, front;
    for (int i = 0; i < static_cast<int>(fired_.size()); ++i)
      if (!fired_[static_cast<std::size_t>(i)] && true_now(i, frame)) {
        fired_[static_cast<std::size_t>(i)] = true;
        fresh.push_back(i);
      }
    const PlannedClip* present = nullptr;
    if (on_)
      for (const PlannedClip& clip : of(line_.front()).clips)
        if (clip.start <= line_.front().at && clip.end > line_.front().at &&
            (present == nullptr || clip.start >= present->start))
          present = &clip;
    bool resume = true;
    for (const int i : fresh)
      if (rule(i).enter == Enter::front || (rule(i).enter == Enter::after_clip && present == nullptr)) {
        front.push_back(i);
        resume = resume && rule(i).resume;
      } else if (rule(i).enter == Enter::after_clip) {
        line_.front().waits.push_back({present->end, i});
      }
    if (on_ && !front.empty())
      stop(front, resume);
    else
      for (std::size_t i = front.size(); i-- > 0;) line_.push_front({rule(front[i]).sequence, 0, {}});
    for (std::size_t f = fresh.size(); f-- > 0;)
      if (rule(fresh[f]).enter == Enter::after_sequence) {
        std::size_t at = 0;
        while (at < line_.size() && of(line_[at]).name != rule(fresh[f]).after) ++at;
        line_.insert(line_.begin() + static_cast<long>(std::min(at + 1, line_.size())),
                     {rule(fresh[f]).sequence, 0, {}});
      }
    for (const int i : fresh)
      if (rule(i).enter == Enter::end) line_.push_back({rule(i).sequence, 0, {}});
    if (on_ || line_.empty()) return false;
    on_ = true;
    history_.push_back({frame, frame, line_.front().sequence, line_.front().at});
    int& seen = seen_[static_cast<std::size_t>(line_.front().sequence)];
    seen = std::max(seen, line_.front().at);
    return line_.front().at >= of(line_.front()).length;
  }

  const Script& s_;
  std::deque<Item> line_;
  bool on_ = false;
  std::vector<bool> fired_, ended_;
  std::vector<int> seen_;
  std::vector<QueueSpan> history_;
};

int below(std::mt19937_64& engine, int limit) { return static_cast<int>(engine() % static_cast<unsigned>(limit)); }

PlannedSequence draw_sequence(std::mt19937_64& engine) {
  static const char* const kNames[] = {"a", "b", "c"};
  PlannedSequence sequence{kNames[below(engine, 3)], below(engine, 9), {}};
  for (int c = below(engine, 4); c > 0; --c) {
    const int start = below(engine, sequence.length + 1);
    sequence.clips.push_back({kNames[below(engine, 3)], start, start + below(engine, sequence.length - start + 1)});
  }
  return sequence;
}

PlannedInterrupt draw_interrupt(std::mt19937_64& engine, int sequence) {
  static const char* const kNames[] = {"a", "b", "c"};
  PlannedInterrupt interrupt;
  interrupt.when.event = static_cast<Event>(below(engine, 4));  // the fourth stands for all that is signalled
  interrupt.when.frame = below(engine, 30);
  interrupt.when.name = kNames[below(engine, 3)];
  interrupt.enter = static_cast<Enter>(below(engine, 4));
  interrupt.after = kNames[below(engine, 3)];
  interrupt.resume = below(engine, 3) > 0;
  interrupt.sequence = sequence;
  return interrupt;
}

Script draw_script(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Script script;
  script.queued = below(engine, 4);
  for (int s = 0; s < script.queued; ++s) script.sequences.push_back(draw_sequence(engine));
  for (int i = below(engine, 5); i > 0; --i) {
    script.interrupts.push_back(draw_interrupt(engine, static_cast<int>(script.sequences.size())));
    script.sequences.push_back(draw_sequence(engine));
  }
  script.signals.resize(80);
  for (std::vector<char>& frame : script.signals) {
    frame.resize(script.interrupts.size());
    for (char& signal : frame) signal = below(engine, 12) == 0;
  }
  return script;
}

TEST(Queue, PlaysAHundredThousandScriptsAsTheReferenceDoes) {
  PlayQueue queue;
  std::size_t cuts = 0;
  for (std::uint64_t seed = 0; seed < 100000; ++seed) {
    const Script script = draw_script(seed);
    queue.start(script.sequences, script.interrupts, script.queued);
    for (std::size_t frame = 0; frame < script.signals.size(); ++frame)
      queue.advance(static_cast<int>(frame), script.signals[frame]);
    const std::vector<QueueSpan> history(queue.history().begin(), queue.history().end());
    ASSERT_EQ(history, Reference(script).play()) << "seed " << seed;
    for (const QueueSpan& span : history) cuts += span.first_content > 0;
  }
  EXPECT_GT(cuts, 10000U) << "hardly anything was cut and went on: the scripts test little";
}

PlannedInterrupt at_frame(int frame, Enter enter, int sequence) {
  PlannedInterrupt interrupt;
  interrupt.when.frame = frame;
  interrupt.enter = enter;
  interrupt.sequence = sequence;
  return interrupt;
}

std::vector<QueueSpan> play(const std::vector<PlannedSequence>& sequences,
                            const std::vector<PlannedInterrupt>& interrupts, int queued) {
  PlayQueue queue;
  queue.start(sequences, interrupts, queued);
  const std::vector<char> signals(interrupts.size(), 0);
  for (int frame = 0; frame < 100; ++frame) queue.advance(frame, signals);
  EXPECT_TRUE(queue.idle());
  return {queue.history().begin(), queue.history().end()};
}

using History = std::vector<QueueSpan>;

TEST(Queue, FirstInFirstOutEachBeginningWhereTheOneBeforeEnded) {
  EXPECT_EQ(play({{"a", 10, {}}, {"b", 0, {}}, {"c", 5, {}}}, {}, 3),
            (History{{0, 10, 0, 0}, {10, 10, 1, 0}, {10, 15, 2, 0}}));
}

TEST(Queue, AtTheFrontWhatRunsIsCutAndGoesOnAfterwards) {
  EXPECT_EQ(play({{"a", 10, {}}, {"b", 5, {}}}, {at_frame(4, Enter::front, 1)}, 1),
            (History{{0, 4, 0, 0}, {4, 9, 1, 0}, {9, 15, 0, 4}}));
  PlannedInterrupt drops = at_frame(4, Enter::front, 1);
  drops.resume = false;
  EXPECT_EQ(play({{"a", 10, {}}, {"b", 5, {}}}, {drops}, 1), (History{{0, 4, 0, 0}, {4, 9, 1, 0}}));
}

TEST(Queue, AfterTheClipIsWhenThePresentOneEnds) {
  const std::vector<PlannedSequence> sequences = {{"a", 20, {{"x", 0, 12}, {"y", 2, 7}}}, {"b", 5, {}}};
  EXPECT_EQ(play(sequences, {at_frame(4, Enter::after_clip, 1)}, 1),
            (History{{0, 7, 0, 0}, {7, 12, 1, 0}, {12, 25, 0, 7}}));
  EXPECT_EQ(play(sequences, {at_frame(15, Enter::after_clip, 1)}, 1),
            (History{{0, 15, 0, 0}, {15, 20, 1, 0}, {20, 25, 0, 15}}))
      << "no clip runs any more: at once";
}

TEST(Queue, AfterASequenceIsBehindItWhetherItRunsOrWaits) {
  const std::vector<PlannedSequence> sequences = {{"a", 3, {}}, {"b", 3, {}}, {"c", 3, {}}, {"new", 1, {}}};
  PlannedInterrupt behind_b = at_frame(1, Enter::after_sequence, 3);
  behind_b.after = "b";
  EXPECT_EQ(play(sequences, {behind_b}, 3), (History{{0, 3, 0, 0}, {3, 6, 1, 0}, {6, 7, 3, 0}, {7, 10, 2, 0}}));
  behind_b.after = "a";
  EXPECT_EQ(play(sequences, {behind_b}, 3), (History{{0, 3, 0, 0}, {3, 4, 3, 0}, {4, 7, 1, 0}, {7, 10, 2, 0}}));
  behind_b.when.frame = 5;
  EXPECT_EQ(play(sequences, {behind_b}, 3), (History{{0, 3, 0, 0}, {3, 6, 1, 0}, {6, 9, 2, 0}, {9, 10, 3, 0}}))
      << "it is over: at the end";
}

}  // namespace
}  // namespace contort
