#include "model/core/hash.h"

#define XXH_INLINE_ALL  // header only: no library to link for one function
#include <xxhash.h>

#include <bit>
#include <cmath>

namespace contort {

namespace {
constexpr std::uint64_t kCanonicalNaN = 0x7ff8000000000000ULL;
constexpr std::string_view kHexDigits = "0123456789abcdef";
}  // namespace

void Hash64::add(double value) {
  if (value == 0.0) value = 0.0;  // -0 becomes 0
  add(std::isnan(value) ? kCanonicalNaN : std::bit_cast<std::uint64_t>(value));
}

void Hash64::add(std::span<const double> values) {
  for (const double value : values) add(value);
}

void Hash64::add(std::string_view text) {
  add(static_cast<std::uint64_t>(text.size()));
  for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
}

std::string to_hex(std::uint64_t value) {
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) text[static_cast<std::size_t>(i)] = kHexDigits[value & 15];
  return text;
}

bool from_hex(std::string_view text, std::uint64_t& value) {
  if (text.size() != 16) return false;
  value = 0;
  for (const char c : text) {
    const std::size_t digit = kHexDigits.find(c);
    if (digit == std::string_view::npos) return false;
    value = value << 4 | digit;
  }
  return true;
}

std::string content_id(std::string_view text) {
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  return to_hex(hash.high64) + to_hex(hash.low64);
}

}  // namespace contort
