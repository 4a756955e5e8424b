// Smaller bytes, by zlib; browsers take them apart by themselves (DecompressionStream).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace contort {

// In the format of gzip (RFC 1952), without a time: equal bytes give equal bytes.
std::vector<std::byte> gzipped(std::span<const std::byte> bytes);

}  // namespace contort
