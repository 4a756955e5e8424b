// The OpenAPI document, from the table of calls.
#include <sstream>

#include "model/core/json_fields.h"
#include "server/routes.h"

namespace contort::server {

namespace {

using json_fields::Json;

Json id_parameters(std::string_view pattern) {
  Json all = Json::array();
  for (std::size_t at = pattern.find('{'); at != std::string_view::npos; at = pattern.find('{', at + 1)) {
    const std::string name(pattern.substr(at + 1, pattern.find('}', at) - at - 1));
    all.push_back({{"name", name}, {"in", "path"}, {"required", true}, {"schema", {{"type", "string"}}}});
  }
  return all;
}

Json parameters_of(const Route& route) {
  Json all = id_parameters(route.pattern);
  std::istringstream names{std::string(route.parameters)};
  for (std::string name; names >> name;)
    all.push_back({{"name", name},
                   {"in", "query"},
                   {"required", false},
                   {"schema", {{"type", name == "mode" ? "string" : "integer"}}}});
  return all;
}

Json answers_of(const Route& route) {
  const std::string type(route.answer);
  const Json content = type == "application/json" ? Json{{type, {{"schema", {{"type", "object"}}}}}}
                                                  : Json{{type, {{"schema", {{"type", "string"}}}}}};
  return {{std::to_string(route.status), {{"description", std::string(route.summary)}, {"content", content}}},
          {"default", {{"$ref", "#/components/responses/Error"}}}};
}

// "post /api/sessions/{session}/push" -> "post_sessions_session_push"
std::string name_of(const Route& route) {
  std::string name;
  for (const char c : route.method) name += static_cast<char>(c - 'A' + 'a');
  for (const char c : route.pattern.substr(route.pattern.starts_with("/api") ? 4 : 0))
    if (c == '/' || c == '.')
      name += '_';
    else if (c != '{' && c != '}')
      name += c;
  return name;
}

Json operation(const Route& route) {
  Json json = {
      {"operationId", name_of(route)}, {"summary", std::string(route.summary)}, {"responses", answers_of(route)}};
  if (Json parameters = parameters_of(route); !parameters.empty()) json["parameters"] = std::move(parameters);
  if (route.body_schema != nullptr)
    json["requestBody"] = {
        {"required", true},
        {"content", {{"application/json", {{"schema", *json_fields::parse_document(route.body_schema())}}}}}};
  return json;
}

Json error_components() {
  const Json text = {{"type", "string"}};
  const Json error = {{"type", "object"},
                      {"required", {"code", "pointer", "text"}},
                      {"properties", {{"code", text}, {"pointer", text}, {"text", text}}}};
  const Json answer = {
      {"description", "Reason for the refusal: a stable code, a JSON pointer into the body, a sentence."},
      {"content", {{"application/json", {{"schema", {{"$ref", "#/components/schemas/Error"}}}}}}}};
  return {{"schemas", {{"Error", error}}},
          {"responses", {{"Error", answer}}},
          {"securitySchemes", {{"token", {{"type", "http"}, {"scheme", "bearer"}}}}}};
}

}  // namespace

std::string openapi(std::string_view version) {
  Json paths = Json::object();
  for (const Route& route : routes()) {
    if (!route.documented) continue;
    std::string method;
    for (const char c : route.method) method += static_cast<char>(c - 'A' + 'a');
    paths[std::string(route.pattern)][method] = operation(route);
  }
  return Json{
      {"openapi", "3.1.0"},
      {"info",
       {{"title", "Contort"},
        {"version", std::string(version)},
        {"description", "Browse and triage a corpus, and drive characters. docs/reference/server.md explains the "
                        "calls."}}},
      {"security", {Json::object(), {{"token", Json::array()}}}},
      {"paths", paths},
      {"components", error_components()}}
      .dump();
}

}  // namespace contort::server
