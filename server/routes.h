// The table of calls. It dispatches calls, and the OpenAPI document is made from it. A new call is a row here, a
// handler and a test.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "server/app.h"

namespace contort::server {

struct Call {
  const Request& request;
  std::map<std::string, std::string> ids;  // the values of {names} in the pattern
  const std::string& id(const std::string& name) const { return ids.at(name); }
};

struct Route {
  std::string_view method;
  // "/api/sessions/{id}/push"; "{rest}" at the end matches the rest of the path, with slashes.
  std::string_view pattern;
  std::string_view summary;
  Answer (*handler)(App&, const Call&);
  std::string (*body_schema)() = nullptr;  // JSON Schema; nullptr: no body
  std::string_view parameters = "";        // names of query parameters, separated by spaces
  std::string_view answer = "application/json";
  int status = 200;        // status of success
  bool documented = true;  // false for pages
};

std::span<const Route> routes();

// Returns the refusal of a request by its address, or the methods that the address accepts; nothing if the request
// may continue. Codes call.not_found, call.wrong_method, call.too_large.
std::optional<Answer> refuse_route(const App& app, const Request& request, std::size_t body_bytes);

// Calls the handler of a request. Refuses for the same reasons as refuse_route().
Answer dispatch(App& app, const Request& request);

// Returns the OpenAPI 3.1 document as JSON.
std::string openapi(std::string_view version);

// The handlers, by the file in which they are defined.
namespace calls {  // server/calls_sessions.cpp
Answer open_session(App&, const Call&);
Answer show_session(App&, const Call&);
Answer close_session(App&, const Call&);
Answer enqueue(App&, const Call&);
Answer interrupt(App&, const Call&);
Answer aim(App&, const Call&);
Answer push(App&, const Call&);
Answer clock(App&, const Call&);
Answer change(App&, const Call&);
Answer stream(App&, const Call&);
Answer frames(App&, const Call&);
Answer model(App&, const Call&);
Answer motion_file(App&, const Call&);
Answer keep_case(App&, const Call&);
// server/calls_corpus.cpp
Answer list_corpus(App&, const Call&);
Answer show_bucket(App&, const Call&);
Answer acknowledge_bucket(App&, const Call&);
Answer quarantine_bucket(App&, const Call&);
Answer note_bucket(App&, const Call&);
Answer replay_bucket(App&, const Call&);
Answer shrink_bucket(App&, const Call&);
Answer make_report(App&, const Call&);
Answer show_job(App&, const Call&);
Answer events(App&, const Call&);
// server/calls_work.cpp
Answer document(App&, const Call&);
Answer catalogue(App&, const Call&);
Answer register_library(App&, const Call&);
Answer evaluate(App&, const Call&);
Answer generate_file(App&, const Call&);
Answer metrics(App&, const Call&);
Answer health(App&, const Call&);
Answer front_page(App&, const Call&);
Answer play_page(App&, const Call&);
Answer page_file(App&, const Call&);
Answer report_file(App&, const Call&);
}  // namespace calls

// Schemas of bodies: server/bodies.cpp.
namespace schemas {
std::string session();
std::string enqueue();
std::string interrupt();
std::string aim();
std::string push();
std::string clock();
std::string change();
std::string keep_case();
std::string acknowledge();
std::string quarantine();
std::string note();
std::string evaluate();
std::string library();
std::string nothing();
}  // namespace schemas

}  // namespace contort::server
