// Computes the events that update a listener of a session from the state that it knows to the present one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/session_state.h"

namespace contort::server {

// The state that a stream has sent so far.
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
  std::map<Mode, std::int64_t> judged;  // revision for which results were sent
  Time clock_sent{};
};

// An event, sent as "event: <name>\ndata: <data>\n\n".
struct Event {
  std::string name;
  std::string data;
};
std::string print_event(const Event& event);

// Returns the events in sending order; none if the listener is up to date. `stream` is updated as if they were sent.
std::vector<Event> events_of(const SessionState& shown, StreamState& stream, Time now);

}  // namespace contort::server
