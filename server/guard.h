// Decides who may call. Every request passes here before anything else looks at it.
#pragma once

#include <string>
#include <vector>

#include "server/request.h"

namespace contort::server {

struct GuardConfig {
  std::vector<std::string> hosts;  // "127.0.0.1:8080", "localhost:8080": what a Host header may say
  std::string token;               // "": none is needed
};

// Looks at the head of a request only, so that no body is read for somebody who may not call. Codes guard.host,
// guard.origin, guard.token, call.content_type, call.content_encoding, call.too_long. A name of elsewhere that resolves
// to this machine (DNS rebinding) fails by its Host; a page of elsewhere by its Origin or by its type of content.
Result<Done> admit(const Request& request, const GuardConfig& config);

// The address is this machine's own.
bool is_loopback(const std::string& host);

}  // namespace contort::server
