#include "server/allowance.h"

#include <algorithm>

namespace contort::server {

namespace {

constexpr std::size_t kMostAccounts = 4096;

double seconds_between(Time from, Time to) { return std::max(0.0, std::chrono::duration<double>(to - from).count()); }

}  // namespace

double Allowance::left(const std::string& client, Time now) {
  const std::lock_guard lock(mutex_);
  return account_of(client, now).left;
}

void Allowance::spend(const std::string& client, double amount, Time now) {
  const std::lock_guard lock(mutex_);
  account_of(client, now).left -= amount;
}

bool Allowance::take(const std::string& client, double amount, Time now) {
  const std::lock_guard lock(mutex_);
  Account& account = account_of(client, now);
  if (account.left < amount) return false;
  account.left -= amount;
  return true;
}

double Allowance::wait_s(const std::string& client, Time now) { return std::max(0.0, -left(client, now) / per_s_); }

Allowance::Account& Allowance::account_of(const std::string& client, Time now) {
  if (accounts_.size() >= kMostAccounts) forget_full(now);
  Account& account = accounts_.try_emplace(client, Account{at_once_, now}).first->second;
  account.left = std::min(at_once_, account.left + per_s_ * seconds_between(account.since, now));
  account.since = now;
  return account;
}

// Forgets clients that have their whole allowance: they are like unknown ones.
void Allowance::forget_full(Time now) {
  std::erase_if(accounts_, [&](const auto& entry) {
    return entry.second.left + per_s_ * seconds_between(entry.second.since, now) >= at_once_;
  });
  if (accounts_.size() >= kMostAccounts) accounts_.clear();
}

}  // namespace contort::server
