// One connection, as the HTTP library reads and writes it. Reading is limited in bytes and in time, whatever the
// library requests: no more than the head and the body of one request, and nothing from a client that is too slow.
#pragma once

#include <httplib.h>

#include <string>

#include "server/connections.h"
#include "server/head.h"
#include "server/request.h"

namespace contort::server {

// The times that the server waits for a client. A body or an answer has `rest_s` as a start, and after it must have made
// `bytes_per_s` on average, or the connection is closed. The server's own time does not count.
struct Patience {
  double next_request_s = 10.0;
  double head_s = 5.0;  // from the first byte of the head on
  double rest_s = 10.0;
  double bytes_per_s = 16 << 10;
  double lingering_s = 2.0;
};

class Connection final : public httplib::Stream {
 public:
  // The caller keeps the socket and closes it. `most_chunked` limits bodies that do not declare their length.
  Connection(int socket, Connections::Seat& seat, std::size_t most_chunked, const Patience& patience = {});

  // Reads the head of the next request; the library then reads this head and its body. Code connection.over if the
  // client sends no more requests, call.too_slow, and those of read_head.
  Result<Head> next_request();

  // Returns true if the body has not been read to its end, so that the next request cannot be found.
  bool has_unread() const { return is_chunked_ || body_left_ > 0; }
  // Writes an answer without the library.
  void refuse(const Issue& issue);
  // Tells the client that nothing more follows, and discards what it still sends. Otherwise the kernel would reply to
  // these bytes with a reset, and a client that is still sending would not see the answer.
  void linger();

  bool is_readable() const override;
  bool is_writable() const override;
  ssize_t read(char* bytes, std::size_t size) override;
  ssize_t write(const char* bytes, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  socket_t socket() const override { return socket_; }

 private:
  Result<std::size_t> receive_head();
  bool receive(Time until);
  ssize_t read_body(char* bytes, std::size_t size);
  std::string_view not_taken() const { return std::string_view(received_).substr(taken_); }
  Time end_of_patience(Time since) const;

  int socket_;
  Connections::Seat& seat_;
  std::size_t most_chunked_;
  Patience patience_;
  std::string received_;        // bytes from the network
  std::size_t taken_ = 0;       // how many of these bytes were used
  std::string head_;            // head for the library
  std::size_t head_taken_ = 0;  // how many bytes of the head the library has read
  std::size_t body_left_ = 0;
  bool is_chunked_ = false;
  // Time that the server waited for the rest of this request, and for its answer to be received.
  double waited_s_ = 0.0;
  std::size_t moved_ = 0;  // bytes of this request and its answer
};

// Refuses a connection for which there is no seat. Takes at most a fifth of a second.
void turn_away(int socket, const Issue& issue);

// The address of the other end of a connection, such as "127.0.0.1"; "" if it is closed.
std::string client_of(int socket);

}  // namespace contort::server
