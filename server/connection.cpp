#include "server/connection.h"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace contort::server {

namespace {

constexpr std::size_t kBlock = 16 << 10;
constexpr double kTurnAway_s = 0.1;

Time after(Time since, double seconds) {
  return since + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(seconds));
}

// The client has left or sends no request, so it gets no answer.
const Issue kOver{"connection.over", "", "the client has gone, or asks for nothing"};

bool wait_on(int socket, short events, Time until) {
  for (;;) {
    const double left_ms = std::ceil(-1e3 * seconds_since(until));
    pollfd file{socket, events, 0};
    const int ready = ::poll(&file, 1, static_cast<int>(std::max(0.0, left_ms)));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

bool send_text(int socket, const std::string& text, Time until) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t sent = ::send(socket, text.data() + at, text.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) at += static_cast<std::size_t>(sent);
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN || !wait_on(socket, POLLOUT, until)) return false;
  }
  return true;
}

void discard(int socket, Time until) {
  char block[kBlock];
  while (seconds_since(until) < 0.0 && wait_on(socket, POLLIN, until)) {
    const ssize_t got = ::recv(socket, block, sizeof block, MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN)) return;
  }
}

void address_of(int socket, int (*ask)(int, sockaddr*, socklen_t*), std::string& ip, int& port) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  char host[NI_MAXHOST] = "", service[NI_MAXSERV] = "";
  if (ask(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return;
  ::getnameinfo(reinterpret_cast<sockaddr*>(&address), length, host, sizeof host, service, sizeof service,
                NI_NUMERICHOST | NI_NUMERICSERV);
  ip = host, port = std::atoi(service);
}

}  // namespace

Connection::Connection(int socket, Connections::Seat& seat, std::size_t most_chunked, const Patience& patience)
    : socket_(socket), seat_(seat), most_chunked_(most_chunked), patience_(patience) {}

// The offset of the end of the head, after its empty line; npos if the head is too long.
Result<std::size_t> Connection::receive_head() {
  const Time since = now();
  if (!seat_.waits_for_request(since)) return kOver;
  received_.erase(0, std::exchange(taken_, 0));
  Time until = after(since, patience_.next_request_s);
  for (bool begun = false;; begun = !received_.empty()) {
    received_.erase(0, std::min(received_.find_first_not_of("\r\n"), received_.size()));
    if (!begun && !received_.empty()) until = after(now(), patience_.head_s);
    const std::size_t end = received_.find("\n\r\n");
    if (end != std::string::npos) return end + 3;
    if (received_.size() > kMostHeadBytes) return std::string::npos;
    if (receive(until)) continue;
    if (received_.empty() || now() < until) return kOver;
    return Issue{"call.too_slow", "", "the request did not arrive in time"};
  }
}

Result<Head> Connection::next_request() {
  const Result<std::size_t> end = receive_head();
  if (!end) return end.issue();
  seat_.works();
  if (*end > kMostHeadBytes)
    return Issue{"call.long_head", "",
                 "the head of a request has at most " + std::to_string(kMostHeadBytes) + " bytes"};
  Result<Head> head = read_head(std::string_view(received_).substr(0, *end));
  taken_ = *end;
  if (!head) return head;
  head_ = head->text, head_taken_ = 0, is_chunked_ = head->is_chunked;
  body_left_ = is_chunked_ ? most_chunked_ : head->body_bytes;
  waited_s_ = 0.0, moved_ = 0;
  return head;
}

// Returns false if the client has left.
bool Connection::receive(Time until) {
  if (!wait_on(socket_, POLLIN, until)) return false;
  const std::size_t before = received_.size();
  received_.resize(before + kBlock);
  const ssize_t got = ::recv(socket_, received_.data() + before, kBlock, MSG_DONTWAIT);
  received_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

Time Connection::end_of_patience(Time since) const {
  const Time slow = after(since, patience_.rest_s + static_cast<double>(moved_) / patience_.bytes_per_s - waited_s_);
  return std::min(slow, after(now(), patience_.rest_s));
}

ssize_t Connection::read(char* bytes, std::size_t size) {
  if (head_taken_ == head_.size()) return read_body(bytes, size);
  const std::size_t part = head_.copy(bytes, size, head_taken_);
  head_taken_ += part;
  return static_cast<ssize_t>(part);
}

ssize_t Connection::read_body(char* bytes, std::size_t size) {
  if (body_left_ == 0) return 0;
  const Time since = now();
  while (not_taken().empty()) {
    received_.clear(), taken_ = 0;
    seat_.waits_for_rest(since);
    const bool alive = receive(end_of_patience(since));
    seat_.works();
    if (!alive) return -1;
  }
  waited_s_ += seconds_since(since);
  const std::size_t part = not_taken().copy(bytes, std::min(size, body_left_));
  taken_ += part, moved_ += part, body_left_ -= part;
  return static_cast<ssize_t>(part);
}

ssize_t Connection::write(const char* bytes, std::size_t size) {
  const Time since = now();
  for (std::size_t at = 0; at < size;) {
    const ssize_t sent = ::send(socket_, bytes + at, size - at, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) at += static_cast<std::size_t>(sent), moved_ += static_cast<std::size_t>(sent);
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN) return -1;
    seat_.waits_for_rest(since);
    if (!wait_on(socket_, POLLOUT, end_of_patience(since))) return -1;
  }
  seat_.works();
  waited_s_ += seconds_since(since);
  return static_cast<ssize_t>(size);
}

void Connection::refuse(const Issue& issue) {
  const Time since = now();
  seat_.waits_for_rest(since);
  if (send_text(socket_, print_answer(refusal(issue)), after(since, patience_.lingering_s))) linger();
}

void Connection::linger() {
  const Time since = now();
  seat_.waits_for_rest(since);
  ::shutdown(socket_, SHUT_WR);
  discard(socket_, after(since, patience_.lingering_s));
}

bool Connection::is_readable() const { return head_taken_ < head_.size() || body_left_ > 0; }

bool Connection::is_writable() const { return wait_on(socket_, POLLOUT, end_of_patience(now())); }

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  address_of(socket_, ::getpeername, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  address_of(socket_, ::getsockname, ip, port);
}

void turn_away(int socket, const Issue& issue) {
  const Time until = after(now(), kTurnAway_s);
  wait_on(socket, POLLIN, until);  // most clients ask at once, and read an answer only after that
  if (!send_text(socket, print_answer(refusal(issue)), until)) return;
  ::shutdown(socket, SHUT_WR);
  discard(socket, after(now(), kTurnAway_s));
}

std::string client_of(int socket) {
  std::string ip;
  int port = 0;
  address_of(socket, ::getpeername, ip, port);
  return ip;
}

}  // namespace contort::server
