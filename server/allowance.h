// Limits how much each client may use: an amount per second on average, and more after a pause (a token bucket).
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "server/played.h"

namespace contort::server {

class Allowance {
 public:
  Allowance(double per_s, double at_once) : per_s_(per_s), at_once_(at_once) {}

  // The amount that `client` has left now. It is negative if the client spent more than it had, because some costs
  // are known only afterwards.
  double left(const std::string& client, Time now);
  void spend(const std::string& client, double amount, Time now);
  // Spends the amount if it is available; returns false if not.
  bool take(const std::string& client, double amount, Time now);
  // seconds until the client may spend again
  double wait_s(const std::string& client, Time now);

 private:
  struct Account {
    double left = 0.0;
    Time since{};
  };
  Account& account_of(const std::string& client, Time now);  // with mutex_ held
  void forget_full(Time now);

  double per_s_;
  double at_once_;
  std::mutex mutex_;
  std::map<std::string, Account> accounts_;
};

}  // namespace contort::server
