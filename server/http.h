// The server's sockets: HTTP/1.1 by cpp-httplib, one thread for each connection.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "server/request.h"

namespace contort::server {

struct HttpConfig {
  std::string host = "127.0.0.1";
  int port = 8080;               // 0: any that is free
  int threads = 128;             // connections at a time, streams among them
  std::size_t most_body = 1 << 20;
};

class Http {
 public:
  using Handler = std::function<Answer(const Request&)>;

  explicit Http(const HttpConfig& config);
  ~Http();

  // The port. Code serve.no_port where it cannot be had.
  Result<int> bind();
  // Answers until stop(), from another thread; then waits for what is being answered.
  void run(Handler handler);
  void stop();

 private:
  struct Impl;
  HttpConfig config_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contort::server
