// Compresses bytes with zlib. Browsers decompress them (DecompressionStream).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace contort {

// Returns the bytes in gzip format (RFC 1952), without a time: equal bytes give equal bytes.
std::vector<std::byte> gzipped(std::span<const std::byte> bytes);

}  // namespace contort
