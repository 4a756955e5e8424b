// Hashes of values: fields one by one, never memory with padding, never pointers or capacity.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace contort {

// Multiply-xorshift over exact bits, one word at a time. -0 counts as 0 and every NaN as one NaN, so that values which
// compare equal hash equal.
class Hash64 {
 public:
  void add(std::uint64_t bits) {
    state_ = (state_ ^ bits) * 0x9e3779b97f4a7c15ULL;
    state_ ^= state_ >> 32;
  }
  void add(double value);
  void add(std::span<const double> values);
  void add(std::string_view text);
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

// Converts a hash to 16 lower-case hex digits, and back. from_hex returns false for any other text.
std::string to_hex(std::uint64_t value);
bool from_hex(std::string_view text, std::uint64_t& value);

// Returns the name of a text by its content: 32 hex digits of XXH3 128 (xxhash). It is not cryptographic: it names
// files, and proves nothing about who wrote them.
std::string content_id(std::string_view text);

}  // namespace contort
