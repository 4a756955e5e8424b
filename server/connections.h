// The open connections. Nobody can keep others out by being slow: where there is no room, a connection that makes the
// server wait is closed in favour of the newer one.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "server/played.h"

namespace contort::server {

class Connections {
 public:
  // A place of one connection, until it goes.
  class Seat {
   public:
    Seat(Connections& all, int socket, std::string client);
    ~Seat();
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    // From here on the server waits for the next request. `false`: the server ends, so there is none to be waited for.
    bool waits_for_request(Time since);
    // The server waits for the rest of a request, or for an answer to be taken.
    void waits_for_rest(Time since);
    void works();

   private:
    friend class Connections;
    enum class Doing { working, waiting_for_rest, waiting_for_request, leaving };
    Connections& all_;
    int socket_;
    std::string client_;
    // These two with the mutex held. A new connection has sent no request yet, so it waits from the beginning: its
    // thread may come late to say so.
    Doing doing_ = Doing::waiting_for_request;
    Time since_ = now();
  };

  Connections(int most, int most_of_client) : most_(most), most_of_client_(most_of_client) {}

  // The socket stays the caller's, who closes it after the seat has gone. Of a client with as many as it may have, the
  // one for which the server has waited longest is shut down; in a full server, the one of the client that has most.
  // Codes limit.connections, full.connections: they are all at work.
  Result<std::unique_ptr<Seat>> enter(int socket, const std::string& client);

  // Shuts down those that wait for a request, now and from now on.
  void close();

 private:
  int count(const std::string* client) const;
  Seat* longest_waiting(const std::string& client) const;
  std::string largest_client() const;
  static bool shut_down(Seat* seat);

  int most_;
  int most_of_client_;
  std::mutex mutex_;
  std::set<Seat*> seats_;
  bool closed_ = false;
};

}  // namespace contort::server
