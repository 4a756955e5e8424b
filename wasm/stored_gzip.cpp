// Replaces renders/gzip.cpp without zlib: the same format, without compression. The data stays in one page, from the
// engine to the viewer, so its size does not matter.
#include <algorithm>
#include <array>
#include <cstdint>

#include "renders/gzip.h"

namespace contort {

namespace {

// The checksum of RFC 1952, section 8.
std::uint32_t checksum(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0xffffffffU;
  for (const std::byte byte : bytes) {
    sum ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) != 0 ? (sum >> 1) ^ 0xedb88320U : sum >> 1;
  }
  return ~sum;
}

// Appends bytes, the lowest one first.
void append(std::vector<std::byte>& out, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) out.push_back(static_cast<std::byte>(value >> (8 * i)));
}

}  // namespace

std::vector<std::byte> gzipped(std::span<const std::byte> bytes) {
  constexpr std::size_t kMostInBlock = 0xffff;  // RFC 1951, section 3.2.4
  constexpr std::array<unsigned char, 10> kHeader = {0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 255};
  std::vector<std::byte> out;
  for (const unsigned char byte : kHeader) out.push_back(std::byte{byte});
  std::size_t at = 0;
  do {
    const std::size_t size = std::min(kMostInBlock, bytes.size() - at);
    append(out, at + size == bytes.size() ? 1 : 0, 1);
    append(out, static_cast<std::uint32_t>(size), 2);
    append(out, ~static_cast<std::uint32_t>(size), 2);
    out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
               bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
    at += size;
  } while (at < bytes.size());
  append(out, checksum(bytes), 4);
  append(out, static_cast<std::uint32_t>(bytes.size()), 4);
  return out;
}

}  // namespace contort
