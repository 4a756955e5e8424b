#include "server/request.h"

#include <array>
#include <string_view>

#include "server/work.h"

namespace contort::server {

namespace {

std::string find(const std::map<std::string, std::string>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? "" : found->second;
}

// Whole codes, or areas that end with a dot. The first that fits counts.
constexpr std::pair<std::string_view, int> kStatuses[] = {
    {"call.not_found", 404},     {"call.wrong_method", 405}, {"call.too_large", 413}, {"call.too_long", 414},
    {"call.wrong_type", 415},    {"json.", 400},             {"call.", 400},          {"guard.token", 401},
    {"guard.", 403},             {"limit.", 429},            {"full.", 503},          {"work.busy", 503},
    {"work.gone", 503},          {"session.not_found", 404}, {"corpus.", 404},        {"job.not_found", 404},
    {"library.not_found", 404},  {"take.", 409},             {"session.", 409},       {"file.", 500},
    {"work.damaged", 500},
};

}  // namespace

std::string Request::header(const std::string& name) const { return find(headers, name); }
std::string Request::parameter(const std::string& name) const { return find(query, name); }

int status_of(const Issue& issue) {
  for (const auto& [code, status] : kStatuses)
    if (code.back() == '.' ? issue.code.starts_with(code) : issue.code == code) return status;
  return 422;  // understood, but no motion can be made of it
}

Answer refusal(const Issue& issue) {
  Answer answer;
  answer.status = status_of(issue);
  answer.body = print_issue(issue);
  if (answer.status == 429 || answer.status == 503) answer.headers.emplace_back("Retry-After", "1");
  return answer;
}

}  // namespace contort::server
