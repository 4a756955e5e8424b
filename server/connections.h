// The open connections. A slow client cannot keep others out: if there is no room, a connection that makes the server
// wait is closed in favour of the newer one.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>

#include "server/played.h"

namespace contort::server {

class Connections {
 public:
  // The place of one connection, until it is destroyed.
  class Seat {
   public:
    Seat(Connections& all, int socket, std::string client);
    ~Seat();
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    // The server begins to wait for the next request. Returns false if the server is ending, so that there is none to
    // wait for.
    bool waits_for_request(Time since);
    // The server begins to wait for the rest of a request, or for the client to receive an answer.
    void waits_for_rest(Time since);
    void works();

   private:
    friend class Connections;
    enum class Doing { working, waiting_for_rest, waiting_for_request, leaving };
    Connections& all_;
    int socket_;
    std::string client_;
    // The mutex guards these two. A new connection has sent no request yet, so it counts as waiting from the beginning,
    // even if its thread starts late.
    Doing doing_ = Doing::waiting_for_request;
    Time since_ = now();
  };

  Connections(int most, int most_of_client) : most_(most), most_of_client_(most_of_client) {}

  // The caller keeps the socket, and closes it after the seat is destroyed. If a client has as many connections as
  // allowed, its connection that has waited longest is shut down. If the server is full, a connection of the client
  // with most connections is shut down. Codes limit.connections, full.connections, if all of them are at work.
  Result<std::unique_ptr<Seat>> enter(int socket, const std::string& client);

  // Shuts down the connections that wait for a request, now and in the future.
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
