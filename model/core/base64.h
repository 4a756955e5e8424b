// Encodes bytes as text (RFC 4648, section 4), for data inside of JSON.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace contort {

std::string to_base64(std::span<const std::byte> bytes);

}  // namespace contort
