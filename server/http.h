// The server's sockets: HTTP/1.1 with cpp-httplib, one thread for each connection.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "server/request.h"

namespace contort::server {

struct HttpConfig {
  std::string host = "127.0.0.1";
  int port = 8080;        // 0: any free port
  int connections = 192;  // greatest number at a time, streams included
  int connections_of_client = 64;
  std::size_t most_body = 1 << 20;
};

// The functions that answer requests. `refuse` gets a request before its body is read; if it returns an answer, the
// answer is sent and the body is never read.
struct Service {
  std::function<std::optional<Answer>(const Request& head)> refuse;
  std::function<Answer(const Request&)> answer;
};

class Http {
 public:
  explicit Http(const HttpConfig& config);
  ~Http();

  // Opens the port and returns it. Code serve.no_port if that fails.
  Result<int> bind();
  // Answers requests until another thread calls stop(); then waits for the running ones.
  void run(Service service);
  void stop();  // run() was called, or is about to be; returns when run() has ended

 private:
  class Impl;
  HttpConfig config_;
  std::unique_ptr<Impl> impl_;
};

}  // namespace contort::server
