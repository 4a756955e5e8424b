#include "server/connections.h"

#include <sys/socket.h>

#include <algorithm>
#include <map>
#include <utility>

namespace contort::server {

Connections::Seat::Seat(Connections& all, int socket, std::string client)
    : all_(all), socket_(socket), client_(std::move(client)) {}

Connections::Seat::~Seat() {
  const std::lock_guard lock(all_.mutex_);
  all_.seats_.erase(this);
}

bool Connections::Seat::waits_for_request(Time since) {
  const std::lock_guard lock(all_.mutex_);
  if (all_.closed_ || doing_ == Doing::leaving) return false;
  if (doing_ != Doing::waiting_for_request) since_ = since;  // a new connection counts as waiting from its start
  doing_ = Doing::waiting_for_request;
  return true;
}

void Connections::Seat::waits_for_rest(Time since) {
  const std::lock_guard lock(all_.mutex_);
  if (doing_ != Doing::leaving) doing_ = Doing::waiting_for_rest, since_ = since;
}

void Connections::Seat::works() {
  const std::lock_guard lock(all_.mutex_);
  if (doing_ != Doing::leaving) doing_ = Doing::working;
}

// Counts the connections of a client, or all if there is no client. Connections that were shut down do not count.
int Connections::count(const std::string* client) const {
  return static_cast<int>(std::ranges::count_if(seats_, [&](const Seat* seat) {
    return seat->doing_ != Seat::Doing::leaving && (client == nullptr || seat->client_ == *client);
  }));
}

Connections::Seat* Connections::longest_waiting(const std::string& client) const {
  Seat* longest = nullptr;
  for (Seat* seat : seats_) {
    const bool waits =
        seat->doing_ == Seat::Doing::waiting_for_request || seat->doing_ == Seat::Doing::waiting_for_rest;
    if (waits && seat->client_ == client && (longest == nullptr || seat->since_ < longest->since_)) longest = seat;
  }
  return longest;
}

// The client with most connections, among those of which the server waits for at least one.
std::string Connections::largest_client() const {
  std::map<std::string, int> counts;
  for (const Seat* seat : seats_)
    if (longest_waiting(seat->client_) != nullptr) ++counts[seat->client_];
  const auto largest = std::ranges::max_element(counts, {}, [](const auto& entry) { return entry.second; });
  return largest == counts.end() ? "" : largest->first;
}

// Wakes the connection's thread, which then leaves. The socket is still this connection's, because it is closed after
// the seat is destroyed.
bool Connections::shut_down(Seat* seat) {
  if (seat == nullptr) return false;
  seat->doing_ = Seat::Doing::leaving;
  ::shutdown(seat->socket_, SHUT_RDWR);
  return true;
}

Result<std::unique_ptr<Connections::Seat>> Connections::enter(int socket, const std::string& client) {
  auto seat = std::make_unique<Seat>(*this, socket, client);
  const std::lock_guard lock(mutex_);
  if (count(&client) >= most_of_client_ && !shut_down(longest_waiting(client)))
    return Issue{"limit.connections", "",
                 "this client has " + std::to_string(most_of_client_) +
                     " connections at work; try again when one of them is done"};
  if (count(nullptr) >= most_ && !shut_down(longest_waiting(largest_client())))
    return Issue{"full.connections", "",
                 "the server has " + std::to_string(most_) + " connections at work; try again in a second"};
  seats_.insert(seat.get());
  return seat;
}

void Connections::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  for (Seat* seat : seats_)
    if (seat->doing_ == Seat::Doing::waiting_for_request) shut_down(seat);
}

}  // namespace contort::server
