// Reads the head of a request, as bytes. It is checked before the HTTP library sees it, because the library accepts
// heads of any size, and interprets some of them differently from proxies in front of it.
#pragma once

#include <string>
#include <string_view>

#include "model/core/result.h"

namespace contort::server {

inline constexpr std::size_t kMostHeadBytes = 32 << 10;
inline constexpr std::size_t kMostHeaders = 100;

struct Head {
  std::string text;            // for the library: the request line and the headers that it may see
  std::size_t body_bytes = 0;  // from Content-Length; 0 without it
  bool is_chunked = false;     // the body contains its own end
  bool is_read_only = false;   // GET or HEAD: the library does not read their bodies

  bool has_body() const { return is_chunked || body_bytes > 0; }
};

// `text` contains the request line up to and including the empty line. The function refuses everything that two
// readers could interpret as different ends of the request: lines without CR, folded lines, control characters,
// spaces before a colon, invalid lengths, a length together with chunks, and repeated headers of which one would be
// ignored. It removes ranges, because the library answers any number of them, each as long as the file. It also
// removes every compression except gzip, because the library would choose Brotli, which takes a second of CPU time
// for 1 MB. Codes call.bad_request, call.long_head.
Result<Head> read_head(std::string_view text);

}  // namespace contort::server
