#include "server/request.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "server/work.h"

namespace contort::server {

namespace {

std::string find(const std::map<std::string, std::string>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "" : found->second;
}

// Whole codes, or prefixes that end with a dot. The first row that matches counts.
constexpr std::pair<std::string_view, int> kStatuses[] = {
    {"call.not_found", 404},
    {"call.wrong_method", 405},
    {"call.too_large", 413},
    {"call.too_long", 414},
    {"call.content_type", 415},
    {"call.content_encoding", 415},
    {"call.too_slow", 408},
    {"call.long_head", 431},
    {"json.", 400},
    {"call.", 400},
    {"guard.token", 401},
    {"guard.", 403},
    {"limit.", 429},
    {"full.", 503},
    {"work.busy", 503},
    {"work.gone", 503},
    {"session.not_found", 404},
    {"corpus.", 404},
    {"job.not_found", 404},
    {"library.not_found", 404},
    {"take.", 409},
    {"session.", 409},
    {"file.", 500},
    {"work.damaged", 500},
};

// All answers have these. Pages may not show an answer in a frame, where clicks could be misled, and browsers may not
// guess its type.
constexpr std::pair<const char*, const char*> kHeaders[] = {
    {"X-Content-Type-Options", "nosniff"},           {"X-Frame-Options", "DENY"}, {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"}, {"Accept-Ranges", "none"},
};
constexpr const char* kPolicy = "Content-Security-Policy";
constexpr const char* kNothing = "default-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const char* reason_of(int status) {
  switch (status) {
    case 400: return "Bad Request";
    case 408: return "Request Timeout";
    case 429: return "Too Many Requests";
    case 431: return "Request Header Fields Too Large";
    case 503: return "Service Unavailable";
    default: return "Error";
  }
}

}  // namespace

std::string Request::header(const std::string& name) const { return find(headers, name); }
std::string Request::parameter(const std::string& name) const { return find(query, name); }

int status_of(const Issue& issue) {
  for (const auto& [code, status] : kStatuses)
    if (code.back() == '.' ? issue.code.starts_with(code) : issue.code == code) return status;
  return 422;  // understood, but no motion can be made from it
}

Answer refusal(const Issue& issue) {
  Answer answer;
  answer.status = status_of(issue);
  answer.body = print_issue(issue);
  if (answer.status == 429 || answer.status == 503) answer.headers.emplace_back("Retry-After", "1");
  if (answer.status == 401) answer.headers.emplace_back("WWW-Authenticate", "Bearer");
  return answer;
}

std::vector<std::pair<std::string, std::string>> headers_of(const Answer& answer) {
  std::vector<std::pair<std::string, std::string>> all(std::begin(kHeaders), std::end(kHeaders));
  all.insert(all.end(), answer.headers.begin(), answer.headers.end());
  const auto is_policy = [](const auto& header) { return header.first == kPolicy; };
  if (std::ranges::none_of(all, is_policy)) all.emplace_back(kPolicy, kNothing);
  return all;
}

std::string print_answer(const Answer& answer) {
  std::string text = "HTTP/1.1 " + std::to_string(answer.status) + " " + reason_of(answer.status) + "\r\n";
  for (const auto& [name, value] : headers_of(answer)) text += name + ": " + value + "\r\n";
  return text + "Connection: close\r\nContent-Type: " + answer.type +
         "\r\nContent-Length: " + std::to_string(answer.body.size()) + "\r\n\r\n" + answer.body;
}

}  // namespace contort::server
