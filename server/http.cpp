#include "server/http.h"

#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "server/connection.h"

namespace contort::server {

namespace {

// Greatest length of an address; longer ones are refused before they are compared with patterns.
constexpr std::size_t kMostTarget = 2048;
constexpr int kBacklog = 512;  // greatest number of connections that the kernel keeps until they are accepted
constexpr int kTurnedAway = 32;            // threads that refuse connections when the server is full
constexpr int kMostRequests = 100000;      // greatest number of requests of one connection
constexpr std::chrono::milliseconds kStopAgain{5};
constexpr std::size_t kChunkOverhead = 8;  // network bytes for each byte of the body, in chunks of one byte

using Handled = httplib::Server::HandlerResponse;

Request request_of(const httplib::Request& from) {
  Request request;
  request.method = from.method, request.path = from.path, request.client = from.remote_addr;
  for (const auto& [name, value] : from.headers) request.headers[name] = value;  // in lower case, by read_head
  for (const auto& [name, value] : from.params) request.query[name] = value;
  return request;
}

void send(Answer answer, httplib::Response& to) {
  to.status = answer.status;
  for (const auto& [name, value] : headers_of(answer)) to.set_header(name, value);
  if (!answer.pieces) return to.set_content(answer.body, answer.type);
  to.set_chunked_content_provider(answer.type, [pieces = answer.pieces](std::size_t, httplib::DataSink& sink) {
    bool more = true;
    const std::string text = pieces(more);
    // Sends an empty comment if there is no event, to notice listeners that have left.
    const bool sent = text.empty() ? !more || sink.write(":\n\n", 3) : sink.write(text.data(), text.size());
    if (!more) sink.done();
    return sent;
  });
}

Issue issue_of(int status) {
  switch (status) {
    case 413: return {"call.too_large", "", "the body is too large"};
    case 414: return {"call.too_long", "", "the address is too long"};
    case 404: return {"call.wrong_method", "", "no call accepts this method"};
    default: return {"call.bad_request", "", "this is not a valid HTTP request"};
  }
}

void send_error(int status, httplib::Response& to) {
  Answer answer = refusal(issue_of(status));
  answer.status = status;
  send(std::move(answer), to);
}

bool announces_body(const httplib::Request& request) {
  const std::string length = request.get_header_value("content-length");
  return request.has_header("transfer-encoding") || (!length.empty() && length != "0");
}

// Does not set SO_REUSEPORT: two servers on one port would share its connections.
void set_options(socket_t socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

class Http::Impl : public httplib::Server {
 public:
  explicit Impl(const HttpConfig& config);

  void widen_backlog() const { ::listen(svr_sock_, kBacklog); }
  void serve(Service service);
  void end();

 private:
  bool process_and_close_socket(socket_t socket) override;
  void converse(int socket);
  // Returns true if the request was refused. If its body was not read, the connection ends.
  bool refuse(const httplib::Request& request, httplib::Response& response) const;
  void answer(const httplib::Request& request, httplib::Response& response) const;
  void read_and_answer(const httplib::Request&, httplib::Response&, const httplib::ContentReader&) const;

  HttpConfig config_;
  Connections connections_;
  Service service_;
  std::atomic<bool> over_ = false;  // run() will answer nothing more
};

Http::Impl::Impl(const HttpConfig& config)
    : config_(config), connections_(config.connections, config.connections_of_client) {
  new_task_queue = [threads = config.connections + kTurnedAway] {
    return new httplib::ThreadPool(static_cast<std::size_t>(threads));
  };
  set_socket_options(set_options);
  set_tcp_nodelay(true);
  set_payload_max_length(config.most_body);
  set_keep_alive_timeout(static_cast<time_t>(Patience{}.next_request_s));
  set_keep_alive_max_count(kMostRequests);
  set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty()) send_error(response.status, response);
  });
  set_exception_handler([](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
    send(refusal({"file.internal", "", "an internal error"}), response);
  });
}

void Http::Impl::serve(Service service) {
  service_ = std::move(service);
  const auto by_reading = [this](const httplib::Request& request, httplib::Response& response,
                                 const httplib::ContentReader& reader) { read_and_answer(request, response, reader); };
  // Clients that ask before sending a body are refused here.
  set_expect_100_continue_handler([this](const httplib::Request& request, httplib::Response& response) {
    return refuse(request, response) ? response.status : 100;
  });
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    if (request.get_header_value("expect") == "100-continue") return Handled::Unhandled;
    return refuse(request, response) ? Handled::Handled : Handled::Unhandled;
  });
  Get(".*", [this](const httplib::Request& request, httplib::Response& response) { answer(request, response); });
  Post(".*", by_reading);
  Delete(".*", by_reading);
  listen_after_bind();
  over_ = true;
}

// httplib's stop() does nothing between the call of listen_after_bind() and its first accept(), so it is repeated.
void Http::Impl::end() {
  connections_.close();
  for (stop(); !over_; stop()) std::this_thread::sleep_for(kStopAgain);
}

bool Http::Impl::refuse(const httplib::Request& request, httplib::Response& response) const {
  const bool is_long = request.target.size() > kMostTarget;
  std::optional<Answer> refused =
      is_long ? refusal({"call.too_long", "", "the address is too long"}) : service_.refuse(request_of(request));
  if (!refused) return false;
  if (announces_body(request)) refused->headers.emplace_back("Connection", "close");
  send(std::move(*refused), response);
  return true;
}

void Http::Impl::answer(const httplib::Request& request, httplib::Response& response) const {
  send(service_.answer(request_of(request)), response);
}

// The limit applies to the decoded body, for all encodings.
void Http::Impl::read_and_answer(const httplib::Request& from, httplib::Response& response,
                                 const httplib::ContentReader& reader) const {
  Request request = request_of(from);
  bool too_large = false;
  const bool complete = reader([&](const char* bytes, std::size_t count) {
    too_large = request.body.size() + count > config_.most_body;
    if (!too_large) request.body.append(bytes, count);
    return !too_large;
  });
  if (!complete) return send_error(too_large ? 413 : 400, response);
  send(service_.answer(request), response);
}

void Http::Impl::converse(int socket) {
  const auto seat = connections_.enter(socket, client_of(socket));
  if (!seat) return turn_away(socket, seat.issue());
  Connection connection(socket, **seat, kChunkOverhead * config_.most_body);
  for (int count = 1; count <= kMostRequests; ++count) {
    const Result<Head> head = connection.next_request();
    if (!head && head.issue().code != "connection.over") connection.refuse(head.issue());
    if (!head) return;
    const bool last = count == kMostRequests || head->is_chunked || (head->is_read_only && head->has_body());
    bool closed = false;
    const bool fine = process_request(connection, last, closed, nullptr);
    if (connection.has_unread()) return connection.linger();
    if (!fine || last || closed) return;
  }
}

// Runs in a thread of its own.
bool Http::Impl::process_and_close_socket(socket_t socket) {
  converse(socket);
  ::close(socket);
  return true;
}

Http::Http(const HttpConfig& config) : config_(config), impl_(std::make_unique<Impl>(config)) {}

Http::~Http() = default;

Result<int> Http::bind() {
  int port = config_.port;
  const bool bound =
      port == 0 ? (port = impl_->bind_to_any_port(config_.host)) > 0 : impl_->bind_to_port(config_.host, port);
  if (!bound)
    return Issue{"serve.no_port", "",
                 "cannot listen on " + config_.host + ":" + std::to_string(config_.port) +
                     ": the address is not this machine's, or the port is taken"};
  impl_->widen_backlog();
  return port;
}

void Http::run(Service service) { impl_->serve(std::move(service)); }

void Http::stop() { impl_->end(); }

}  // namespace contort::server
