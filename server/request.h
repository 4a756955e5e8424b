// A call and its answer, without sockets: what tests use, and what server/http.cpp fills from the wire.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "model/core/result.h"

namespace contort::server {

struct Request {
  std::string method = "GET";
  std::string path;                            // decoded, without the query
  std::map<std::string, std::string> query;    // decoded
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;
  std::string client;  // address

  std::string header(const std::string& name) const;
  std::string parameter(const std::string& name) const;
};

// The next piece of a stream, "" for none within about a second; sets `more` to false at its end.
using Pieces = std::function<std::string(bool& more)>;

struct Answer {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  Pieces pieces;  // where it is not empty, the body is a stream
};

// The status that a code stands for; docs/server.md.
int status_of(const Issue& issue);
Answer refusal(const Issue& issue);

// Those of the answer and those that all answers have: what a browser may do with them. A page that may do more says so
// in a Content-Security-Policy of its own.
std::vector<std::pair<std::string, std::string>> headers_of(const Answer& answer);

// An answer as it is sent where the HTTP library is not asked; the connection ends with it.
std::string print_answer(const Answer& answer);

}  // namespace contort::server
