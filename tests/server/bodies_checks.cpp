// A field of the wrong type in a body is the caller's mistake, and the answer has its pointer; 415 is about
// Content-Type.
#include <gtest/gtest.h>

#include "server/routes.h"
#include "tests/corpus/sample_cases.h"
#include "tests/server/app_fixture.h"

namespace contort::server {
namespace {

Json wrong_for(const Json& schema) {
  return schema.value("type", "") == "string" || schema.contains("enum") ? Json(5) : Json("x");
}

// The required fields of a body, with values that they may have.
Json valid_for(const std::string& name, const Json& schema) {
  if (name == "spec") return Json::parse(print_spec(bent_elbow(100)));
  if (name == "sequence") return Json::object();
  if (schema.contains("enum")) return schema["enum"].at(0);
  const std::string type = schema.value("type", "string");
  if (type == "array") return Json(std::vector<double>(schema.value("minItems", 0U), 1.0));
  if (type == "object") return Json::object();
  if (type == "string") return Json("x");
  return Json(1);
}

Json required_of(const Json& schema) {
  Json body = Json::object();
  for (const std::string name : schema.value("required", Json::array()))
    body[name] = valid_for(name, schema["properties"].value(name, Json::object()));
  return body;
}

std::string path_of(const Route& route) {
  std::string path(route.pattern);
  for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{'))
    path.replace(at, path.find('}') - at + 1, "1");
  return path;
}

void expect_refused(const Server& server, const std::string& path, const std::string& body,
                    const std::string& pointer) {
  const Answer answer = server.call("POST", path, body);
  EXPECT_TRUE(answer.status == 400 || answer.status == 422)
      << path << " " << body << " " << answer.status << answer.body;
  const Json issue = Json::parse(answer.body);
  EXPECT_EQ(issue["pointer"], pointer) << path << " " << body << answer.body;
  EXPECT_NE(issue["text"], "") << path;
}

TEST(Bodies, AFieldOfAnotherTypeIsABadBodyAndThePointerSaysWhere) {
  Server server({.calls_at_once = 1e6});
  int tried = 0;
  for (const Route& route : routes()) {
    if (route.body_schema == nullptr) continue;
    const Json schema = Json::parse(route.body_schema());
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [name, property] : properties.items()) {
      Json body = required_of(schema);
      body[name] = wrong_for(property);
      expect_refused(server, path_of(route), body.dump(), "/" + name);
      ++tried;
    }
    if (!properties.empty() && route.handler != calls::register_library)
      for (const char* body : {"[]", "5", "\"x\"", "null"}) expect_refused(server, path_of(route), body, "");
  }
  EXPECT_GT(tried, 25);
}

TEST(Bodies, OnlyTheContentTypeIsAnsweredWithUnsupportedMediaType) {
  const Server server;
  Request request;
  request.method = "POST", request.path = "/api/evaluate", request.client = "a";
  request.headers = {{"host", kHost}, {"content-type", "text/plain"}};
  EXPECT_EQ(server.app->answer(request).status, 415);
  request.headers["content-type"] = "application/json";
  EXPECT_EQ(server.app->answer(request).status, 400) << "an empty body is no JSON";
  const Answer wrong = server.call("POST", "/api/sessions/1/clock", R"({"play":"yes"})");
  EXPECT_EQ(wrong.status, 400);
  EXPECT_EQ(code_of(wrong), "call.wrong_type");
}

}  // namespace
}  // namespace contort::server
