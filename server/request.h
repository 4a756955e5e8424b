// A call and its answer, without sockets. Tests use them directly; server/http.cpp fills them from the connection.
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
  std::string client;  // address of the client

  std::string header(const std::string& name) const;
  std::string parameter(const std::string& name) const;
};

// Returns the next piece of a stream, or "" if there is none within about a second; sets `more` to false at its end.
using Pieces = std::function<std::string(bool& more)>;

struct Answer {
  int status = 200;
  std::string type = "application/json";
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  Pieces pieces;  // if it is not empty, the body is a stream
};

// The HTTP status of a code; see docs/reference/server.md.
int status_of(const Issue& issue);
Answer refusal(const Issue& issue);

// Returns the headers of the answer and those of all answers, which restrict what a browser may do. A page that needs
// more has its own Content-Security-Policy.
std::vector<std::pair<std::string, std::string>> headers_of(const Answer& answer);

// Prints an answer as it is sent without the HTTP library; the connection is then closed.
std::string print_answer(const Answer& answer);

}  // namespace contort::server
