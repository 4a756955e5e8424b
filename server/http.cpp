#include "server/http.h"

#include <httplib.h>

#include <algorithm>
#include <cctype>

namespace contort::server {

namespace {

constexpr std::size_t kMostTarget = 2048;  // of the request line: longer ones never reach a pattern
constexpr time_t kRead_s = 5, kWrite_s = 5, kKeepAlive_s = 10;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Request request_of(const httplib::Request& from) {
  Request request;
  request.method = from.method, request.path = from.path, request.body = from.body, request.client = from.remote_addr;
  for (const auto& [name, value] : from.headers) request.headers[lower(name)] = value;
  for (const auto& [name, value] : from.params) request.query[name] = value;
  return request;
}

void send(Answer answer, httplib::Response& to) {
  to.status = answer.status;
  to.set_header("X-Content-Type-Options", "nosniff");
  to.set_header("Referrer-Policy", "no-referrer");
  to.set_header("Cross-Origin-Resource-Policy", "same-origin");
  for (const auto& [name, value] : answer.headers) to.set_header(name, value);
  if (!answer.pieces) return to.set_content(answer.body, answer.type);
  to.set_chunked_content_provider(answer.type, [pieces = answer.pieces](std::size_t, httplib::DataSink& sink) {
    bool more = true;
    const std::string text = pieces(more);
    // A line that says nothing, so that a listener who has left is noticed.
    const bool sent = text.empty() ? sink.write(":\n\n", 3) : sink.write(text.data(), text.size());
    if (!more) sink.done();
    return sent;
  });
}

Issue issue_of(int status) {
  switch (status) {
    case 413: return {"call.too_large", "", "the body is too large"};
    case 414: return {"call.too_long", "", "the address is too long"};
    case 404: return {"call.wrong_method", "", "no call has this method"};
    default: return {"call.bad_request", "", "this is no request that HTTP knows"};
  }
}

// Two servers on one port would share its connections, which SO_REUSEPORT allows.
void set_options(socket_t socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

}  // namespace

struct Http::Impl {
  httplib::Server server;
};

Http::Http(const HttpConfig& config) : config_(config), impl_(std::make_unique<Impl>()) {
  httplib::Server& server = impl_->server;
  server.new_task_queue = [threads = config.threads] { return new httplib::ThreadPool(static_cast<std::size_t>(threads)); };
  server.set_socket_options(set_options);
  server.set_tcp_nodelay(true);
  server.set_payload_max_length(config.most_body);
  server.set_read_timeout(kRead_s);
  server.set_write_timeout(kWrite_s);
  server.set_keep_alive_timeout(kKeepAlive_s);
  server.set_keep_alive_max_count(100000);
  server.set_pre_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    if (request.target.size() <= kMostTarget) return httplib::Server::HandlerResponse::Unhandled;
    send(refusal({"call.too_long", "", "the address is too long"}), response);
    return httplib::Server::HandlerResponse::Handled;
  });
  server.set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (!response.body.empty()) return;
    Answer answer = refusal(issue_of(response.status));
    answer.status = response.status;
    send(std::move(answer), response);
  });
}

Http::~Http() = default;

Result<int> Http::bind() {
  httplib::Server& server = impl_->server;
  if (config_.port == 0) {
    const int port = server.bind_to_any_port(config_.host);
    if (port > 0) return port;
  } else if (server.bind_to_port(config_.host, config_.port)) {
    return config_.port;
  }
  return Issue{"serve.no_port", "", "cannot listen on " + config_.host + ":" + std::to_string(config_.port) +
                                        ": the address is not this machine's, or the port is taken"};
}

void Http::run(Handler handler) {
  httplib::Server& server = impl_->server;
  const auto answer = [handler](const httplib::Request& request, httplib::Response& response) {
    send(handler(request_of(request)), response);
  };
  server.Get(".*", answer);
  server.Post(".*", answer);
  server.Put(".*", answer);
  server.Patch(".*", answer);
  server.Delete(".*", answer);
  server.Options(".*", answer);
  server.listen_after_bind();
}

void Http::stop() { impl_->server.stop(); }

}  // namespace contort::server
