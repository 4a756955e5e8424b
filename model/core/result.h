// Result is for bad input (a file, a flag, a spec), one of three kinds of errors (assert.h). Bad input never aborts,
// and never throws across a header.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "model/core/assert.h"

namespace contort {

// The reason why an input was refused.
struct Issue {
  std::string code;     // "spec.unknown_action": stable, lower case, area first; for scripts and tests.
  std::string pointer;  // JSON pointer (RFC 6901) into the input, "/sequences/0/clips/1"; "" for the whole input.
  std::string text;     // One sentence for people: the value that was found, and the allowed ones.
  bool operator==(const Issue&) const = default;
};

// "spec.out_of_range at /sequences/0/speed: …", the one line that a user sees.
std::string to_line(const Issue& issue);

// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Issue why) : state_(std::in_place_index<1>, std::move(why)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  const T& value() const& {
    CONTORT_ASSERT(ok());
    return *std::get_if<0>(&state_);
  }
  T&& value() && {
    CONTORT_ASSERT(ok());
    return std::move(*std::get_if<0>(&state_));
  }
  const T* operator->() const { return &value(); }
  const T& operator*() const& { return value(); }

  const Issue& issue() const {
    CONTORT_ASSERT(!ok());
    return *std::get_if<1>(&state_);
  }

 private:
  std::variant<T, Issue> state_;
};

struct Done {  // Result<Done>: success without a value.
  bool operator==(const Done&) const = default;
};

}  // namespace contort
