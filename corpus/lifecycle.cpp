#include "corpus/lifecycle.h"

#include <algorithm>
#include <cstdlib>

#include "checks/settings.h"

namespace contort {

namespace {

bool is_set_aside(const Bucket& bucket) {
  return bucket.state == BucketState::flaky || bucket.state == BucketState::invalid;
}

void set_aside(Bucket& bucket, BucketState state) {
  if (!is_set_aside(bucket)) bucket.was = bucket.state;
  bucket.state = state;
  bucket.streak = 0;
}

void take_back(Bucket& bucket) {
  bucket.state = bucket.was;
  bucket.was = BucketState::fresh;
  bucket.streak = 0;
}

void fail(Bucket& bucket) {
  bucket.passed_in.clear();
  if (bucket.state == BucketState::fixed) bucket.state = BucketState::regressed;
}

void pass(Bucket& bucket, const std::string& build) {
  if (bucket.state == BucketState::fixed || std::ranges::count(bucket.passed_in, build) > 0) return;
  bucket.passed_in.push_back(build);
  if (bucket.passed_in.size() >= kBuildsToFix) bucket.state = BucketState::fixed;
}

// Records a replay that ran and was steady.
void judge(Bucket& bucket, const Observation& seen) {
  if (bucket.state == BucketState::invalid) take_back(bucket);
  if (bucket.state == BucketState::flaky && ++bucket.streak < kSteadyReplays) return;
  if (bucket.state == BucketState::flaky) take_back(bucket);
  if (seen.shown == Shown::fails)
    fail(bucket);
  else
    pass(bucket, seen.build);
}

// All fields that a person or a replay may change, in the order in which copies are compared.
auto state_of(const Bucket& b) {
  return std::tie(b.changes, b.state, b.was, b.streak, b.passed_in, b.owner, b.ticket, b.reason, b.expires,
                  b.note);
}

// The number of days from a fixed day to "2027-03-01". Years begin in March, so that a leap day is the last of its year
// and the lengths of months repeat: 31, 30, 31, 30, 31 days (as in Fliegel and van Flandern, CACM 1968).
int day_number(const std::string& text) {
  const auto number = [&](std::size_t at, std::size_t length) { return std::atoi(text.substr(at, length).c_str()); };
  const int month = (number(5, 2) + 9) % 12;  // March is 0
  const int year = number(0, 4) - month / 10;
  return 365 * year + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + number(8, 2);
}

Issue refuse(const Bucket& bucket, const char* code, const std::string& why) {
  return {std::string("bucket.") + code, "", folder_name(bucket) + ": " + why};
}

Result<Done> check_day(const Bucket& bucket, const std::string& expires, const std::string& today) {
  if (!is_day(expires)) return refuse(bucket, "no_day", "\"" + expires + "\" is not a date; write YYYY-MM-DD");
  const int days = day_number(expires) - day_number(today);
  if (days < 0 || days > kLongestQuarantineDays)
    return refuse(bucket, "too_long",
                  "a quarantine until " + expires + " is refused, allowed are days from " + today + " to " +
                      std::to_string(kLongestQuarantineDays) + " days later");
  return Done{};
}

}  // namespace

bool is_expired(const Bucket& bucket, const std::string& today) {
  return bucket.state == BucketState::quarantined && bucket.expires < today;  // dates compare like texts
}

bool is_gating(const Bucket& bucket, const std::string& today) {
  return bucket.state == BucketState::fresh || bucket.state == BucketState::regressed || is_expired(bucket, today);
}

bool is_stale(const Bucket& bucket) {
  return bucket.state == BucketState::quarantined && bucket.streak >= kStalePasses;
}

Bucket next_state(const Bucket& bucket, const Observation& seen, const std::string& today) {
  Bucket next = bucket;
  if (is_expired(next, today)) next.state = BucketState::fresh, next.streak = 0;
  if (next.state == BucketState::quarantined)
    next.streak = seen.shown == Shown::gone ? next.streak + 1 : 0;
  else if (seen.shown == Shown::refused)
    set_aside(next, BucketState::invalid);
  else if (seen.shown == Shown::unsteady)
    set_aside(next, BucketState::flaky);
  else
    judge(next, seen);
  if (next != bucket) ++next.changes;
  return next;
}

Result<Bucket> acknowledge(const Bucket& bucket, const std::string& owner, const std::string& ticket) {
  if (owner.empty()) return refuse(bucket, "no_owner", "an acknowledged failure needs an owner");
  if (ticket.empty()) return refuse(bucket, "no_ticket", "an acknowledged failure needs a ticket");
  Bucket next = bucket;
  BucketState& state = is_set_aside(next) ? next.was : next.state;
  if (state == BucketState::fixed) return refuse(bucket, "is_fixed", "it is fixed, so there is nothing to acknowledge");
  state = BucketState::open;
  next.owner = owner, next.ticket = ticket;
  next.reason.clear(), next.expires.clear();
  if (next != bucket) ++next.changes;
  return next;
}

Result<Bucket> quarantine(const Bucket& bucket, const std::string& owner, const std::string& reason,
                          const std::string& expires, const std::string& today) {
  if (owner.empty()) return refuse(bucket, "no_owner", "a quarantine needs an owner");
  if (reason.empty()) return refuse(bucket, "no_reason", "a quarantine needs a reason");
  if ((is_set_aside(bucket) ? bucket.was : bucket.state) == BucketState::fixed)
    return refuse(bucket, "is_fixed", "it is fixed, so there is nothing to quarantine");
  if (const Result<Done> day = check_day(bucket, expires, today); !day) return day.issue();
  Bucket next = bucket;
  if (next.state != BucketState::quarantined) next.streak = 0;
  next.state = BucketState::quarantined;
  next.was = BucketState::fresh;
  next.owner = owner, next.reason = reason, next.expires = expires;
  if (next != bucket) ++next.changes;
  return next;
}

Bucket annotate(const Bucket& bucket, const std::string& note) {
  Bucket next = bucket;
  next.note = note;
  if (next != bucket) ++next.changes;
  return next;
}

void merge_state(Bucket& into, const Bucket& other) {
  if (state_of(into) < state_of(other))
    std::tie(into.changes, into.state, into.was, into.streak, into.passed_in, into.owner, into.ticket, into.reason,
             into.expires, into.note) = state_of(other);
}

}  // namespace contort
