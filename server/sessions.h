// Holds all sessions by their ids, and keeps their limits.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/session.h"

namespace contort::server {

class Sessions {
 public:
  explicit Sessions(Engine& engine) : engine_(engine) {}

  // Opens a session with a random id, which cannot be guessed. Codes limit.sessions, full.sessions, and those of
  // Session::open.
  Result<std::shared_ptr<Session>> open(SessionDesc desc);

  // Finds a session. Code session.not_found.
  Result<std::shared_ptr<Session>> find(const std::string& id) const;
  Result<Done> close(const std::string& id);

  // Ends sessions that were unused for some time; at the server's end all sessions.
  void sweep(Time now);
  void close_all();

  int count() const;
  std::size_t bytes() const;
  double cpu_s() const;  // CPU time of all sessions, including ended ones

  // Counts a stream as open for as long as the result is held. Codes limit.streams, full.streams.
  Result<std::shared_ptr<void>> count_stream(const std::string& client);
  int streams() const;

 private:
  Result<Done> room_for(const std::string& client) const;

  Engine& engine_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Session>> sessions_;
  std::map<std::string, int> opening_;  // by client: sessions that are not in sessions_ yet
  std::map<std::string, int> streams_;  // number of streams by client
  double ended_cpu_s_ = 0.0;
};

}  // namespace contort::server
