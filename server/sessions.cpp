#include "server/sessions.h"

#include <algorithm>
#include <random>
#include <vector>

namespace contort::server {

namespace {

std::string random_id() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::random_device device;
  std::string id;
  for (int word = 0; word < 4; ++word) {
    unsigned bits = device();
    for (int digit = 0; digit < 8; ++digit, bits >>= 4) id += kDigits[bits & 15U];
  }
  return id;
}

int sum(const std::map<std::string, int>& counts) {
  int all = 0;
  for (const auto& [name, count] : counts) all += count;
  return all;
}

}  // namespace

Result<Done> Sessions::room_for(const std::string& client) const {
  const Limits& limits = engine_.limits();
  const auto is_theirs = [&](const auto& entry) { return entry.second->desc().client == client; };
  const auto opening = opening_.find(client);
  const int theirs =
      static_cast<int>(std::ranges::count_if(sessions_, is_theirs)) + (opening == opening_.end() ? 0 : opening->second);
  if (theirs >= limits.sessions_of_client)
    return Issue{"limit.sessions", "", "this client has " + std::to_string(theirs) + " sessions already"};
  if (static_cast<int>(sessions_.size()) + sum(opening_) >= limits.sessions)
    return Issue{"full.sessions", "", "the server has its greatest number of sessions"};
  return Done{};
}

Result<std::shared_ptr<Session>> Sessions::open(SessionDesc desc) {
  desc.id = random_id();
  {
    const std::lock_guard lock(mutex_);
    if (const Result<Done> room = room_for(desc.client); !room) return room.issue();
    ++opening_[desc.client];
  }
  Result<std::shared_ptr<Session>> session = Session::open(desc, engine_);
  const std::lock_guard lock(mutex_);
  if (--opening_[desc.client] == 0) opening_.erase(desc.client);
  if (session) sessions_[desc.id] = *session;
  return session;
}

Result<std::shared_ptr<Session>> Sessions::find(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = sessions_.find(id);
  if (found != sessions_.end()) return found->second;
  return Issue{"session.not_found", "", "there is no such session; a session ends when it is not used for a while"};
}

Result<Done> Sessions::close(const std::string& id) {
  const Result<std::shared_ptr<Session>> session = find(id);
  if (!session) return session.issue();
  (*session)->close();
  const std::lock_guard lock(mutex_);
  ended_cpu_s_ += (*session)->cpu_s();
  sessions_.erase(id);
  return Done{};
}

void Sessions::sweep(Time now) {
  std::vector<std::string> idle;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, session] : sessions_)
      if (session->idle_s(now) > engine_.limits().idle_s) idle.push_back(id);
  }
  for (const std::string& id : idle)
    if (const Result<Done> closed = close(id); !closed) continue;  // another thread closed it first
}

void Sessions::close_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& [id, session] : sessions_) session->close();
  sessions_.clear();
}

int Sessions::count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(sessions_.size());
}

std::size_t Sessions::bytes() const {
  const std::lock_guard lock(mutex_);
  std::size_t bytes = 0;
  for (const auto& [id, session] : sessions_) bytes += session->bytes();
  return bytes;
}

double Sessions::cpu_s() const {
  const std::lock_guard lock(mutex_);
  double all = ended_cpu_s_;
  for (const auto& [id, session] : sessions_) all += session->cpu_s();
  return all;
}

Result<std::shared_ptr<void>> Sessions::count_stream(const std::string& client) {
  const std::lock_guard lock(mutex_);
  if (const auto theirs = streams_.find(client);
      theirs != streams_.end() && theirs->second >= engine_.limits().streams_of_client)
    return Issue{"limit.streams", "", "this client has its greatest number of streams"};
  if (sum(streams_) >= engine_.limits().streams)
    return Issue{"full.streams", "", "the server has its greatest number of streams"};
  ++streams_[client];
  return std::shared_ptr<void>(nullptr, [this, client](void*) {
    const std::lock_guard again(mutex_);
    if (--streams_[client] == 0) streams_.erase(client);
  });
}

int Sessions::streams() const {
  const std::lock_guard lock(mutex_);
  return sum(streams_);
}

}  // namespace contort::server
