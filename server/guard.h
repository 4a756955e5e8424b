// Who may call. Every request passes here before anything else looks at it.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "server/played.h"
#include "server/request.h"

namespace contort::server {

struct GuardConfig {
  std::vector<std::string> hosts;  // "127.0.0.1:8080", "localhost:8080": what a Host header may say
  std::string token;               // "": none is needed
};

// Codes guard.host, guard.origin, guard.token, call.wrong_type, call.too_long. A name of elsewhere that resolves to this
// machine (DNS rebinding) fails by its Host; a page of elsewhere by its Origin or by its type of content.
Result<Done> admit(const Request& request, const GuardConfig& config);

// The address is this machine's own.
bool is_loopback(const std::string& host);

// How often each client has called of late: a bucket of tokens that refills.
class CallRate {
 public:
  CallRate(double per_s, double at_once) : per_s_(per_s), at_once_(at_once) {}
  // Code limit.calls.
  Result<Done> count(const std::string& client, Time now);

 private:
  struct Left {
    double calls = 0.0;
    Time since{};
  };
  void forget_quiet(Time now);

  double per_s_;
  double at_once_;
  std::mutex mutex_;
  std::map<std::string, Left> clients_;
};

}  // namespace contort::server
