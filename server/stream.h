// The events that a stream of a session sends: those that bring a listener from what it knows to what is shown now.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/session_state.h"

namespace contort::server {

// The part that a stream has sent so far.
struct StreamState {
  struct Frames {
    int first = 0;
    int next = 0;
  };
  int take = 0;
  std::int64_t revision = -1;
  std::int64_t clock = -1;
  std::int64_t problem = 0;
  std::map<Mode, Frames> sent;
  std::map<Mode, std::int64_t> judged;  // revision
  Time clock_sent{};
};

// "event: <name>\ndata: <data>\n\n"
struct Event {
  std::string name;
  std::string data;
};
std::string print_event(const Event& event);

// In the order in which they are to be sent; none where the listener knows everything. `stream` is as if they were
// sent.
std::vector<Event> events_of(const SessionState& shown, StreamState& stream, Time now);

}  // namespace contort::server
