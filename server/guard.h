// Decides whether a request is allowed. Every request passes here first.
#pragma once

#include <string>
#include <vector>

#include "server/request.h"

namespace contort::server {

struct GuardConfig {
  std::vector<std::string> hosts;  // allowed Host headers: "127.0.0.1:8080", "localhost:8080"
  std::string token;               // "": no token is needed
};

// Checks the head of a request only, so that no body is read for a client that may not call. Codes guard.host,
// guard.origin, guard.token, call.content_type, call.content_encoding, call.too_long. A foreign name that resolves to
// this machine (DNS rebinding) fails by its Host; a foreign page fails by its Origin or by its content type.
Result<Done> admit(const Request& request, const GuardConfig& config);

// Returns true if the address is this machine's own.
bool is_loopback(const std::string& host);

}  // namespace contort::server
