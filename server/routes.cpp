#include "server/routes.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace contort::server {

namespace {

constexpr std::string_view kStream = "text/event-stream";
constexpr std::string_view kBytes = "application/octet-stream";
constexpr std::string_view kGlb = "model/gltf-binary";
constexpr std::string_view kHtml = "text/html";

constexpr Route kRoutes[] = {
    {"GET", "/api", "This document.", calls::document},
    {"GET", "/api/health", "Whether the server can work.", calls::health},
    {"GET", "/api/catalogue", "Characters, parts, objects, actions, checks, modes, limits.", calls::catalogue},
    {"POST", "/api/libraries", "Registers parts, objects, characters and actions.", calls::register_library,
     schemas::library, "", "application/json", 201},
    {"POST", "/api/evaluate", "Motion hash and findings of a spec.", calls::evaluate, schemas::evaluate},
    {"POST", "/api/generate", "The motion of a spec as .glb.", calls::generate_file, schemas::evaluate, "", kGlb},
    {"POST", "/api/sessions", "Opens a session.", calls::open_session, schemas::session, "", "application/json", 201},
    {"GET", "/api/sessions/{session}", "State of the session.", calls::show_session},
    {"DELETE", "/api/sessions/{session}", "Ends the session.", calls::close_session},
    {"POST", "/api/sessions/{session}/enqueue", "A sequence for the queue.", calls::enqueue, schemas::enqueue},
    {"POST", "/api/sessions/{session}/interrupt", "A sequence that runs at once.", calls::interrupt,
     schemas::interrupt},
    {"POST", "/api/sessions/{session}/aim", "Aims at a place while other actions run.", calls::aim, schemas::aim},
    {"POST", "/api/sessions/{session}/push", "A blow.", calls::push, schemas::push},
    {"POST", "/api/sessions/{session}/clock", "Plays, stops or steps the clock, or returns to frame 0.", calls::clock, schemas::clock},
    {"POST", "/api/sessions/{session}/change", "A new take with another character, ground, load or mode.",
     calls::change, schemas::change},
    {"GET", "/api/sessions/{session}/stream", "Frames and margins while they are made.", calls::stream, nullptr, "",
     kStream},
    {"GET", "/api/sessions/{session}/frames", "Compact frames.", calls::frames, nullptr, "from count mode", kBytes},
    {"GET", "/api/sessions/{session}/model", "The character and its surroundings.", calls::model},
    {"GET", "/api/sessions/{session}/motion.glb", "The take as glTF.", calls::motion_file, nullptr, "mode", kGlb},
    {"POST", "/api/sessions/{session}/case", "Stores a finding in the corpus as a case.", calls::keep_case, schemas::keep_case, "",
     "application/json", 201},
    {"GET", "/api/corpus", "All buckets.", calls::list_corpus},
    {"GET", "/api/corpus/{bucket}", "A bucket with its cases.", calls::show_bucket},
    {"POST", "/api/corpus/{bucket}/acknowledge", "Acknowledges the failure, so that it no longer gates.",
     calls::acknowledge_bucket, schemas::acknowledge},
    {"POST", "/api/corpus/{bucket}/quarantine", "Lets the failure pass until a day.", calls::quarantine_bucket,
     schemas::quarantine},
    {"POST", "/api/corpus/{bucket}/note", "Sets the note of the bucket.", calls::note_bucket, schemas::note},
    {"POST", "/api/corpus/{bucket}/replay", "Runs the case again.", calls::replay_bucket, schemas::nothing, "",
     "application/json", 202},
    {"POST", "/api/corpus/{bucket}/shrink", "A smaller case with the same failure.", calls::shrink_bucket,
     schemas::nothing, "", "application/json", 202},
    {"POST", "/api/report", "Makes the report again.", calls::make_report, schemas::nothing, "", "application/json",
     202},
    {"GET", "/api/jobs/{job}", "State of a job.", calls::show_job},
    {"GET", "/api/events", "Events of the corpus, the report and jobs.", calls::events, nullptr, "", kStream},
    {"GET", "/metrics", "Prometheus text.", calls::metrics, nullptr, "", "text/plain"},
    {"GET", "/", "The report, or the playground.", calls::front_page, nullptr, "", kHtml, 200, false},
    {"GET", "/play", "The playground.", calls::play_page, nullptr, "", kHtml, 200, false},
    {"GET", "/page/{rest}", "Files that the pages load.", calls::page_file, nullptr, "", kBytes, 200, false},
    {"GET", "/report/{rest}", "The report.", calls::report_file, nullptr, "", kBytes, 200, false},
};

// Takes the first step off the path.
std::string_view step(std::string_view& path) {
  path.remove_prefix(1);  // the slash
  const std::string_view head = path.substr(0, path.find('/'));
  path.remove_prefix(head.size());
  return head;
}

bool fits(std::string_view pattern, std::string_view path, std::map<std::string, std::string>& ids) {
  while (!pattern.empty() && !path.empty() && path.front() == '/') {
    const std::string_view rest = path.substr(1);
    const std::string_view wanted = step(pattern), found = step(path);
    if (wanted == "{rest}") return ids["rest"] = std::string(rest), true;
    if (wanted.starts_with('{') && !found.empty())
      ids[std::string(wanted.substr(1, wanted.size() - 2))] = std::string(found);
    else if (wanted != found)
      return false;
  }
  return pattern.empty() && path.empty();
}

}  // namespace

std::span<const Route> routes() { return kRoutes; }

namespace {

// The calls of an address. `ids` receives the values of the {names} in their pattern.
std::vector<const Route*> routes_of(const std::string& path, std::map<std::string, std::string>& ids) {
  std::vector<const Route*> found;
  for (const Route& route : kRoutes) {
    std::map<std::string, std::string> own;
    if (!fits(route.pattern, path, own)) continue;
    if (found.empty() || found.front()->pattern == route.pattern) found.push_back(&route), ids = std::move(own);
  }
  return found;
}

const Route* with_method(const std::vector<const Route*>& all, std::string_view method) {
  const std::string_view wanted = method == "HEAD" ? "GET" : method;
  const auto found = std::ranges::find_if(all, [&](const Route* route) { return route->method == wanted; });
  return found == all.end() ? nullptr : *found;
}

// The methods as text: "GET, HEAD, OPTIONS".
std::string allowed(const std::vector<const Route*>& all) {
  std::string names;
  for (const Route* route : all) names += std::string(route->method) + (route->method == "GET" ? ", HEAD, " : ", ");
  return names + "OPTIONS";
}

// The answer to a method that an address does not accept. It lists the accepted methods.
Answer other_methods(const std::vector<const Route*>& all, const std::string& method) {
  Answer answer = refusal({"call.wrong_method", "", "this address does not take " + method});
  if (method == "OPTIONS") answer.status = 200, answer.body.clear();
  answer.headers.emplace_back("Allow", allowed(all));
  return answer;
}

}  // namespace

std::optional<Answer> refuse_route(const App& app, const Request& request, std::size_t body_bytes) {
  std::map<std::string, std::string> ids;
  const std::vector<const Route*> all = routes_of(request.path, ids);
  if (all.empty()) return refusal({"call.not_found", "", "there is no such call; GET /api lists them"});
  const Route* route = with_method(all, request.method);
  if (route == nullptr) return other_methods(all, request.method);
  const Limits& limits = app.limits();
  const auto most =
      static_cast<std::size_t>(route->handler == calls::register_library ? limits.library_bytes : limits.spec_bytes);
  if (body_bytes <= most) return std::nullopt;
  return refusal({"call.too_large", "",
                  "the body has " + std::to_string(body_bytes) + " bytes, allowed are " + std::to_string(most)});
}

Answer dispatch(App& app, const Request& request) {
  if (std::optional<Answer> refused = refuse_route(app, request, request.body.size())) return std::move(*refused);
  Call call{request, {}};
  const Route* route = with_method(routes_of(request.path, call.ids), request.method);
  Answer answer = route->handler(app, call);
  if (answer.status == 200) answer.status = route->status;
  return answer;
}

}  // namespace contort::server
