// The head of a request, as bytes. It is looked at before the HTTP library sees it, because the library takes heads of
// any size, and reads some of them otherwise than the machines in front of it do.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort::server {

inline constexpr std::size_t kMostHeadBytes = 32 << 10;
inline constexpr std::size_t kMostHeaders = 100;

struct Head {
  std::string text;            // for the library: the request line and the headers that it may see
  std::size_t body_bytes = 0;  // as Content-Length says; 0 where it says nothing
  bool is_chunked = false;     // the body itself says where it ends
  bool is_read_only = false;   // GET or HEAD: the library does not read their bodies

  bool has_body() const { return is_chunked || body_bytes > 0; }
};

// `text` goes from the request line to the empty line, both included. Refused is everything of which two readers could
// think differently where the request ends: lines without CR, folded lines, control characters, spaces before a colon,
// lengths that are no number, a length beside chunks, and headers that are given twice although one of them would be
// ignored. Ranges are taken out, because the library makes an answer of any number of them, each as long as the file.
// So is every compression but gzip, because the library would choose Brotli, which takes a second of the CPU for 1 MB.
// Codes call.bad_request, call.long_head.
Result<Head> read_head(std::string_view text);

}  // namespace contort::server
