#include "server/head.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>

namespace contort::server {

namespace {

// Headers that decide about access or about the end of the body. They must not be repeated, because the library would
// use the first of two.
constexpr std::string_view kOnce[] = {"authorization",  "content-encoding", "content-length", "content-type",
                                      "cookie",         "expect",           "host",           "origin",
                                      "sec-fetch-site", "transfer-encoding"};

Issue bad(const std::string& why) { return {"call.bad_request", "", "the head of the request is not HTTP: " + why}; }

std::string lower(std::string_view text) {
  std::string all(text);
  std::ranges::transform(all, all.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return all;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

bool is_token(std::string_view name) {
  constexpr std::string_view kSigns = "!#$%&'*+-.^_`|~";
  return !name.empty() && std::ranges::all_of(name, [&](unsigned char c) {
    return std::isalnum(c) != 0 || kSigns.find(static_cast<char>(c)) != std::string_view::npos;
  });
}

bool has_controls(std::string_view line) {
  return std::ranges::any_of(line, [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7f; });
}

// Takes the first line off the text, and returns it without its line end.
Result<std::string_view> take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string_view::npos || end == 0 || text[end - 1] != '\r') return bad("a line does not end with CR LF");
  const std::string_view line = text.substr(0, end - 1);
  text.remove_prefix(end + 1);
  if (has_controls(line)) return bad("it has control characters");
  return line;
}

Result<Done> read_length(std::string_view value, Head& head) {
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), head.body_bytes);
  if (value.empty() || error != std::errc() || end != value.data() + value.size())
    return bad("Content-Length is not the number of bytes of the body");
  return Done{};
}

// Reads a header. It is passed on to the library unless the library must not see it.
Result<Done> read_header(const std::string& name, std::string_view value, Head& head) {
  if (name == "range" || name == "if-range") return Done{};
  if (name == "accept-encoding") {
    const std::string all = lower(value);
    const bool takes_gzip = all.find("gzip") != std::string::npos && all.find("gzip;q=0") == std::string::npos;
    if (takes_gzip) head.text += "accept-encoding: gzip\r\n";
    return Done{};
  }
  if (name == "transfer-encoding") {
    if (lower(value) != "chunked") return bad("Transfer-Encoding may only be chunked");
    head.is_chunked = true;
  }
  head.text.append(name).append(": ").append(value).append("\r\n");
  return name == "content-length" ? read_length(value, head) : Result<Done>(Done{});
}

Result<Done> read_headers(std::string_view text, Head& head) {
  std::set<std::string> seen;
  for (std::size_t count = 0;; ++count) {
    const Result<std::string_view> line = take_line(text);
    if (!line) return line.issue();
    if (line->empty()) return Done{};
    if (count == kMostHeaders)
      return Issue{"call.long_head", "", "a request has at most " + std::to_string(kMostHeaders) + " headers"};
    const std::size_t colon = line->find(':');
    if (colon == std::string_view::npos || !is_token(line->substr(0, colon)))
      return bad("a header is not a name, a colon and a value");
    const std::string name = lower(line->substr(0, colon));
    if (!seen.insert(name).second && std::ranges::find(kOnce, name) != std::end(kOnce))
      return bad("the header " + name + " is there twice");
    if (const Result<Done> read = read_header(name, trimmed(line->substr(colon + 1)), head); !read) return read;
  }
}

}  // namespace

Result<Head> read_head(std::string_view text) {
  Head head;
  const Result<std::string_view> request_line = take_line(text);
  if (!request_line) return request_line.issue();
  head.text.append(*request_line).append("\r\n");
  head.is_read_only = request_line->starts_with("GET ") || request_line->starts_with("HEAD ");
  if (const Result<Done> read = read_headers(text, head); !read) return read.issue();
  if (head.is_chunked && head.text.find("\r\ncontent-length: ") != std::string::npos)
    return bad("it has both Content-Length and Transfer-Encoding");
  head.text += "\r\n";
  return head;
}

}  // namespace contort::server
