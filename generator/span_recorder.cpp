#include "generator/span_recorder.h"

#include "model/core/index.h"

namespace contort {

namespace {

// Returns true if there is no such entry (-1), or if it ended before the frame before this one.
template <class Span>
bool is_over(const std::vector<Span>& spans, int entry, int frame) {
  return entry < 0 || spans[at(entry)].last_frame < frame - 1;
}

}  // namespace

void SpanRecorder::begin(const Timeline& timeline, Motion& motion) {
  timeline_ = &timeline;
  motion_ = &motion;
  motion.spans.clear();
  motion.aims.clear();
  // Every action may be cut once by every interrupt, and every action of a leg interrupts a course of legs once.
  motion.spans.reserve(timeline.actions.size() * (2 + timeline.interrupts.size()));
  held_.assign(timeline.part_order.size(), {-1, -1});
  additives_.assign(timeline.actions.size(), -1);
  aims_.assign(timeline.actions.size(), -1);
  latest_.assign(timeline.part_order.size(), {-1, -1});
}

void SpanRecorder::hold(int frame, const PlannedAction& action, bool begins) {
  int& entry = held_[at(action.part)][action.def->layer == Layer::ik ? 1 : 0];
  if (begins) entry = add_span(frame, action);
  motion_->spans[at(entry)].last_frame = frame;
}

void SpanRecorder::additive(int frame, int action) {
  int& entry = additives_[at(action)];
  if (is_over(motion_->spans, entry, frame)) entry = add_span(frame, timeline_->actions[at(action)]);
  motion_->spans[at(entry)].last_frame = frame;
  latest_[at(timeline_->actions[at(action)].part)] = {entry, frame};
}

int SpanRecorder::additive_began(int action) const {
  const int entry = additives_[at(action)];
  return entry < 0 ? -1 : motion_->spans[at(entry)].first_frame;
}

void SpanRecorder::linger(int frame, int part, int most_frames) {
  const auto [entry, ended] = latest_[at(part)];
  if (is_over(motion_->spans, entry, frame) || frame > ended + most_frames) return;
  motion_->spans[at(entry)].last_frame = frame;
}

void SpanRecorder::aim(int frame, int action, const Vec3& target_m) {
  int& entry = aims_[at(action)];
  if (is_over(motion_->aims, entry, frame)) {
    entry = static_cast<int>(motion_->aims.size());
    motion_->aims.push_back({frame, frame, timeline_->actions[at(action)].aim->chain.socket, target_m});
  }
  motion_->aims[at(entry)].last_frame = frame;
}

int SpanRecorder::add_span(int frame, const PlannedAction& action) {
  motion_->spans.push_back({frame, frame, action.sequence, action.clip, action.action, action.part});
  return static_cast<int>(motion_->spans.size()) - 1;
}

}  // namespace contort
