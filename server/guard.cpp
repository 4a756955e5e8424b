#include "server/guard.h"

#include <algorithm>
#include <cctype>

namespace contort::server {

namespace {

constexpr std::size_t kMostPath = 1024;

bool writes(const Request& request) {
  return request.method == "POST" || request.method == "PUT" || request.method == "PATCH" || request.method == "DELETE";
}

// Returns true for "Application/JSON; charset=utf-8", and false for "application/json-seq".
bool is_json(const std::string& type) {
  std::string name = type.substr(0, type.find(';'));
  name.erase(name.find_last_not_of(" \t") + 1);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "application/json";
}

// Refuses compressed bodies, because 1 kB could become any size in memory, and bodies that are not JSON.
Result<Done> admit_body(const Request& request) {
  const std::string encoding = request.header("content-encoding");
  if (!encoding.empty() && encoding != "identity")
    return Issue{"call.content_encoding", "", "this server takes no compressed bodies: leave Content-Encoding out"};
  if (writes(request) && request.method != "DELETE" && !is_json(request.header("content-type")))
    return Issue{"call.content_type", "", "a call that writes has Content-Type: application/json"};
  return Done{};
}

// Takes the same time wherever the texts differ.
bool equal(const std::string& a, const std::string& b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    different |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b.empty() ? 0 : b[i % b.size()]);
  return different == 0;
}

// Finds "contort=<token>" in "a=b; c=d".
std::string cookie_of(const Request& request) {
  const std::string all = "; " + request.header("cookie");
  const std::size_t at = all.find("; contort=");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + 10;
  return all.substr(begin, all.find(';', begin) - begin);
}

bool has_token(const Request& request, const std::string& token) {
  const std::string bearer = request.header("authorization");
  const bool asked = request.path == "/" && equal(token, request.parameter("token"));
  return asked || equal("Bearer " + token, bearer) || equal(token, cookie_of(request));
}

}  // namespace

bool is_loopback(const std::string& host) { return host == "localhost" || host == "::1" || host.starts_with("127."); }

Result<Done> admit(const Request& request, const GuardConfig& config) {
  if (request.path.size() > kMostPath) return Issue{"call.too_long", "", "the address is too long"};
  const std::string host = request.header("host");
  if (std::ranges::find(config.hosts, host) == config.hosts.end())
    return Issue{"guard.host", "", "this server does not go by that name; --allow-host adds one"};
  const std::string origin = request.header("origin");
  if (!origin.empty() && origin != "http://" + host && origin != "https://" + host)
    return Issue{"guard.origin", "", "pages of other servers may not call this one"};
  if (!config.token.empty() && !has_token(request, config.token))
    return Issue{"guard.token", "", "a token is needed: Authorization: Bearer, or once /?token= in a browser"};
  if (const Result<Done> fine = admit_body(request); !fine) return fine;
  if (writes(request) && !request.header("sec-fetch-site").empty() && request.header("sec-fetch-site") != "same-origin")
    return Issue{"guard.origin", "", "pages of other servers may not call this one"};
  return Done{};
}

}  // namespace contort::server
