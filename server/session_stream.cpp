// What a session's streams send.
#include <algorithm>

#include "model/core/base64.h"
#include "server/session.h"

namespace contort::server {

namespace {

constexpr double kLead_s = 1.5;    // frames are sent so far ahead of the clock
constexpr double kRefill_s = 1.0;  // when there is less than this, more is sent
constexpr int kMostFramesAtOnce = 240;
constexpr auto kClockEvery = std::chrono::seconds(1);
constexpr auto kLookEvery = std::chrono::milliseconds(20);

std::string quoted(std::string_view plain) { return "\"" + std::string(plain) + "\""; }

std::string name_of(Mode mode) { return quoted(mode_names()[static_cast<std::size_t>(mode)]); }

}  // namespace

std::string print_event(const Event& event) { return "event: " + event.name + "\ndata: " + event.data + "\n\n"; }

std::vector<Event> Session::events(StreamState& stream, Time until) {
  std::vector<Event> events;
  for (;;) {
    touch();
    if (ends_soon()) prepare_next();
    if (has_ended()) roll();
    std::unique_lock lock(mutex_);
    const Time now = std::chrono::steady_clock::now();
    add_events(stream, events, now);
    if (!events.empty() || closed_ || now >= until) return events;
    changed_.wait_until(lock, clock_.playing() ? std::min(until, now + kLookEvery) : until);
  }
}

// The beginning of an event's data.
std::string Session::mark(Mode mode) const {
  return "{\"take\":" + std::to_string(take_.number) + ",\"revision\":" + std::to_string(revision_) +
         ",\"mode\":" + name_of(mode) + ",";
}

void Session::add_events(StreamState& stream, std::vector<Event>& events, Time now) const {
  if (stream.take != take_.number) add_take(stream, events);
  if (stream.clock != clock_version_ || (clock_.playing() && now - stream.clock_sent > kClockEvery)) {
    stream.clock = clock_version_, stream.clock_sent = now;
    events.push_back({"clock", "{\"take\":" + std::to_string(take_.number) +
                                   ",\"frame\":" + std::to_string(frame_now()) +
                                   ",\"playing\":" + (clock_.playing() ? "true" : "false") + "}"});
  }
  add_frames(stream, events);
  add_margins(stream, events);
  if (stream.problem != problem_number_) {
    stream.problem = problem_number_;
    events.push_back({"problem", problem_});
  }
}

void Session::add_take(StreamState& stream, std::vector<Event>& events) const {
  const Played& played = *take_.played.at(modes_.front());
  std::string modes;
  for (const Mode mode : modes_) modes += (modes.empty() ? "" : ",") + name_of(mode);
  stream.take = take_.number, stream.revision = -1, stream.clock = -1;
  stream.sent.clear(), stream.judged.clear();
  for (const Mode mode : modes_) stream.sent[mode] = {frame_now(), frame_now()};
  char rate[40];
  std::snprintf(rate, sizeof rate, "%.17g", played.rate_hz);
  events.push_back({"take", "{\"take\":" + std::to_string(take_.number) + ",\"revision\":" + std::to_string(revision_) +
                                ",\"rate_hz\":" + rate + ",\"frame_count\":" + std::to_string(played.frame_count) +
                                ",\"modes\":[" + modes + "],\"model\":" + std::to_string(model_number_) + "}"});
}

void Session::add_frames(StreamState& stream, std::vector<Event>& events) const {
  const bool is_new = stream.revision != revision_;
  for (auto& [mode, sent] : stream.sent) {
    int changed = sent.next;
    for (const auto& [revision, from] : changes_)
      if (revision > stream.revision && stream.revision >= 0) changed = std::min(changed, from.at(mode));
    const int shown = std::min(frame_now(), sent.next);
    sent.next = std::max(changed, shown);
    if (shown < sent.first) sent.first = sent.next = shown;
    add_frames(mode, sent, events);
    // What was shown already and has changed a little comes after what is waited for.
    for (int from = std::max(changed, sent.first); from < shown; from += kMostFramesAtOnce)
      events.push_back(frames_event(mode, from, std::min(kMostFramesAtOnce, shown - from)));
    if (is_new) events.push_back({"spans", mark(mode) + take_.played.at(mode)->spans + "}"});
  }
  stream.revision = revision_;
}

void Session::add_frames(Mode mode, StreamState::Frames& sent, std::vector<Event>& events) const {
  const Played& played = *take_.played.at(mode);
  const auto ahead = [&](double seconds) {
    return std::min(played.frame_count, frame_now() + static_cast<int>(seconds * played.rate_hz) + 1);
  };
  if (sent.next >= ahead(kRefill_s)) return;
  for (const int end = ahead(kLead_s); sent.next < end;) {
    const int count = std::min(kMostFramesAtOnce, end - sent.next);
    events.push_back(frames_event(mode, sent.next, count));
    sent.next += count;
  }
}

Event Session::frames_event(Mode mode, int from, int count) const {
  const Played& played = *take_.played.at(mode);
  const auto each = static_cast<std::size_t>(played.frame_bytes());
  const std::span<const std::byte> part(
      reinterpret_cast<const std::byte*>(played.frames.data()) + static_cast<std::size_t>(from) * each,
      static_cast<std::size_t>(count) * each);
  return {"frames", mark(mode) + "\"from\":" + std::to_string(from) + ",\"count\":" + std::to_string(count) +
                        ",\"data\":\"" + to_base64(part) + "\"}"};
}

void Session::add_margins(StreamState& stream, std::vector<Event>& events) const {
  for (const auto& [mode, judged] : judged_) {
    const auto& [revision, fields] = judged;
    std::int64_t& known = stream.judged[mode];
    if (known == revision) continue;
    known = revision;
    events.push_back({"margins", mark(mode) + fields});
  }
}

}  // namespace contort::server
