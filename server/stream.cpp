#include "server/stream.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <span>

#include "model/core/base64.h"
#include "model/spec/dynamics_desc.h"

namespace contort::server {

namespace {

constexpr double kLead_s = 1.5;    // frames are sent up to this far ahead of the clock
constexpr double kRefill_s = 1.0;  // more frames are sent when less than this is left
constexpr int kMostFramesAtOnce = 240;
constexpr auto kClockEvery = std::chrono::seconds(1);

using Frames = StreamState::Frames;

std::string quoted(std::string_view plain) { return "\"" + std::string(plain) + "\""; }

std::string quoted_name(Mode mode) { return quoted(mode_names()[static_cast<std::size_t>(mode)]); }

// The beginning of an event's data.
std::string mark(const SessionState& shown, Mode mode) {
  return "{\"take\":" + std::to_string(shown.take().number) + ",\"revision\":" + std::to_string(shown.revision()) +
         ",\"mode\":" + quoted_name(mode) + ",";
}

Event take_event(const SessionState& shown) {
  std::string modes;
  for (const Mode mode : shown.modes()) modes += (modes.empty() ? "" : ",") + quoted_name(mode);
  char rate[40];
  std::snprintf(rate, sizeof rate, "%.17g", shown.main().rate_hz);
  return {"take", "{\"take\":" + std::to_string(shown.take().number) +
                      ",\"revision\":" + std::to_string(shown.revision()) + ",\"rate_hz\":" + rate +
                      ",\"frame_count\":" + std::to_string(shown.main().frame_count) + ",\"modes\":[" + modes +
                      "],\"model\":" + std::to_string(shown.model_number()) + "}"};
}

Event clock_event(const SessionState& shown, Time now) {
  return {"clock", "{\"take\":" + std::to_string(shown.take().number) +
                       ",\"frame\":" + std::to_string(shown.frame(now)) +
                       ",\"playing\":" + (shown.clock().playing() ? "true" : "false") + "}"};
}

Event frames_event(const SessionState& shown, Mode mode, int from, int count) {
  const std::string part = shown.take().played.at(mode)->frames_from(from, count);
  return {"frames", mark(shown, mode) + "\"from\":" + std::to_string(from) + ",\"count\":" + std::to_string(count) +
                        ",\"data\":\"" + to_base64(std::as_bytes(std::span(part))) + "\"}"};
}

// Adds the frames [from, end).
void add_frames(const SessionState& shown, Mode mode, int from, int end, std::vector<Event>& events) {
  for (; from < end; from += kMostFramesAtOnce)
    events.push_back(frames_event(shown, mode, from, std::min(kMostFramesAtOnce, end - from)));
}

// Sends frames up to kLead_s ahead of the clock, if less than kRefill_s of them is left.
void add_lead(const SessionState& shown, Mode mode, Frames& sent, int frame, std::vector<Event>& events) {
  const Played& played = *shown.take().played.at(mode);
  const auto ahead = [&](double seconds) {
    return std::min(played.frame_count, frame + static_cast<int>(seconds * played.rate_hz) + 1);
  };
  if (sent.next >= ahead(kRefill_s)) return;
  add_frames(shown, mode, sent.next, ahead(kLead_s), events);
  sent.next = ahead(kLead_s);
}

// Sends frames again that an edit changed: first those ahead of the clock, then those that were already shown.
void add_frames_of(const SessionState& shown, Mode mode, const StreamState& stream, Frames& sent, int frame,
                   std::vector<Event>& events) {
  const bool knows_take = stream.revision >= 0;
  const int changed = knows_take ? shown.first_change(mode, stream.revision, sent.next) : sent.next;
  const int at_clock = std::min(frame, sent.next);
  sent.next = std::max(changed, at_clock);
  if (at_clock < sent.first) sent.first = sent.next = at_clock;
  add_lead(shown, mode, sent, frame, events);
  add_frames(shown, mode, std::max(changed, sent.first), at_clock, events);
}

void add_take(const SessionState& shown, StreamState& stream, Time now, std::vector<Event>& events) {
  if (stream.take == shown.take().number) return;
  stream.take = shown.take().number, stream.revision = -1, stream.clock = -1;
  stream.sent.clear(), stream.judged.clear();
  for (const Mode mode : shown.modes()) stream.sent[mode] = {shown.frame(now), shown.frame(now)};
  events.push_back(take_event(shown));
}

void add_clock(const SessionState& shown, StreamState& stream, Time now, std::vector<Event>& events) {
  const bool is_due = shown.clock().playing() && now - stream.clock_sent > kClockEvery;
  if (stream.clock == shown.clock().version() && !is_due) return;
  stream.clock = shown.clock().version(), stream.clock_sent = now;
  events.push_back(clock_event(shown, now));
}

void add_motions(const SessionState& shown, StreamState& stream, Time now, std::vector<Event>& events) {
  const bool is_new = stream.revision != shown.revision();
  for (auto& [mode, sent] : stream.sent) {
    add_frames_of(shown, mode, stream, sent, shown.frame(now), events);
    if (is_new) events.push_back({"spans", mark(shown, mode) + shown.take().played.at(mode)->spans + "}"});
  }
  stream.revision = shown.revision();
}

void add_margins(const SessionState& shown, StreamState& stream, std::vector<Event>& events) {
  for (const auto& [mode, judged] : shown.judged())
    if (std::int64_t& known = stream.judged[mode]; known != judged.revision) {
      known = judged.revision;
      events.push_back({"margins", mark(shown, mode) + judged.fields});
    }
}

void add_problem(const SessionState& shown, StreamState& stream, std::vector<Event>& events) {
  if (stream.problem == shown.problem_number()) return;
  stream.problem = shown.problem_number();
  events.push_back({"problem", shown.problem()});
}

}  // namespace

std::string print_event(const Event& event) { return "event: " + event.name + "\ndata: " + event.data + "\n\n"; }

std::vector<Event> events_of(const SessionState& shown, StreamState& stream, Time now) {
  std::vector<Event> events;
  add_take(shown, stream, now, events);
  add_clock(shown, stream, now, events);
  add_motions(shown, stream, now, events);
  add_margins(shown, stream, events);
  add_problem(shown, stream, events);
  return events;
}

}  // namespace contort::server
