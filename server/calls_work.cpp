// Calls without a session or a corpus, and pages.
#include "server/bodies_fields.h"
#include "server/files.h"
#include "server/routes.h"

namespace contort::server::calls {

namespace {

using json_fields::Json;

constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
    "font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

Answer text_answer(std::string text, std::string type = "application/json") {
  Answer answer;
  answer.body = std::move(text);
  answer.type = std::move(type);
  return answer;
}

constexpr std::size_t kAtOnce = 1 << 20;  // larger files are sent in pieces

Answer file_answer(const std::string& folder, const std::string& path) {
  const Result<std::shared_ptr<PlainFile>> opened = open_below(folder, path);
  if (!opened) return refusal(opened.issue());
  const std::shared_ptr<PlainFile> file = *opened;
  Answer answer = text_answer(file->left() > kAtOnce ? "" : file->read(kAtOnce), type_of(path));
  if (file->left() == 0) return answer;
  answer.pieces = [file](bool& more) {
    std::string piece = file->read(kAtOnce);
    more = file->left() > 0;
    return piece;
  };
  return answer;
}

Answer page_answer(std::string page, std::string policy) {
  Answer answer = text_answer(std::move(page), type_of(".html"));
  if (!policy.empty()) answer.headers.emplace_back("Content-Security-Policy", std::move(policy));
  return answer;
}

void replace_once(std::string& text, std::string_view what, std::string_view by) {
  if (const std::size_t at = text.find(what); at != std::string::npos) text.replace(at, what.size(), by);
}

// The report on disk may be copied anywhere. When it is served, it gets one more script, which may call the server.
std::string made_live(std::string page) {
  replace_once(page, "style-src ", "connect-src 'self'; style-src 'self' ");
  replace_once(page, "script-src ", "script-src 'self' ");
  replace_once(page, "</head>", "<script src='/page/live.js' defer></script>\n</head>");
  return page;
}

// The page's content security policy, with frame-ancestors added, which only a header can set; "" if the page has none.
std::string policy_of(const std::string& page) {
  constexpr std::string_view kMeta = "<meta http-equiv='Content-Security-Policy' content=\"";
  const std::size_t at = page.find(kMeta);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + kMeta.size(), end = page.find('"', begin);
  const std::string policy = page.substr(begin, end - begin);
  const bool is_line = end != std::string::npos && policy.find_first_of("\r\n") == std::string::npos;
  return is_line ? policy + "; frame-ancestors 'none'" : "";
}

Answer report_page(const std::string& folder, const std::string& path) {
  const Result<std::string> bytes = read_below(folder, path);
  if (!bytes) return refusal(bytes.issue());
  std::string page = path == "index.html" ? made_live(*bytes) : *bytes;
  std::string policy = policy_of(page);
  return page_answer(std::move(page), std::move(policy));
}

Result<Worked> work(App& app, const Call& call, TaskKind kind) {
  const Result<EvaluateBody> body = json_fields::read_document<EvaluateBody>(call.request.body, "spec");
  if (!body) return body.issue();
  const Result<std::string> library = app.library_folder(body->library);
  if (!library) return library.issue();
  const int most = static_cast<int>(app.engine().limits().most_s * body->spec.rate_hz) + 1;
  Worked worked = app.engine().run({kind, body->spec, 0, most, *library, "", ""}, call.request.client);
  if (!worked.reply) return worked.reply.issue();
  return worked;
}

}  // namespace

Answer document(App&, const Call&) { return text_answer(openapi(CONTORT_VERSION)); }

Answer catalogue(App& app, const Call&) { return text_answer(app.config().catalogue); }

Answer health(App& app, const Call&) {
  if (app.closed()) return refusal({"full.closing", "", "the server ends"});
  return text_answer("{\"ok\":true}");
}

Answer metrics(App& app, const Call&) { return text_answer(app.metrics(), "text/plain; version=0.0.4; charset=utf-8"); }

Answer evaluate(App& app, const Call& call) {
  const Result<Worked> worked = work(app, call, TaskKind::evaluate);
  return worked ? text_answer(worked->reply->head) : refusal(worked.issue());
}

Answer generate_file(App& app, const Call& call) {
  const Result<Worked> worked = work(app, call, TaskKind::model_file);
  return worked ? text_answer(worked->reply->bytes, "model/gltf-binary") : refusal(worked.issue());
}

// An invalid library is refused here, not when it is used.
Answer register_library(App& app, const Call& call) {
  if (call.request.body.size() > static_cast<std::size_t>(app.engine().limits().library_bytes))
    return refusal({"call.too_large", "", "the library is larger than the limit in /api/catalogue"});
  const Result<Json> body = json_fields::parse_document(call.request.body);
  if (!body) return refusal(body.issue());
  if (!body->is_object() || body->size() != 1 || !body->contains("files") || !(*body)["files"].is_object() ||
      (*body)["files"].empty() || (*body)["files"].size() > 256)
    return refusal({"call.no_files", "/files", "expected an object of 1 to 256 files"});
  std::map<std::string, std::string> files;
  for (const auto& [name, file] : (*body)["files"].items()) files[name] = file.dump();
  const Result<std::string> id = app.register_library(files);
  if (!id) return refusal(id.issue());
  Spec probe;
  probe.character.name = "human";
  const Result<std::string> folder = app.library_folder(*id);
  const Worked worked = app.engine().run({TaskKind::model, probe, 0, 0, *folder, "", ""}, call.request.client);
  if (!worked.reply) return refusal(app.forget_library(*id, worked.reply.issue()));
  return text_answer(Json{{"library", *id}}.dump());
}

Answer front_page(App& app, const Call& call) {
  Answer answer;
  answer.status = 302;
  answer.headers.emplace_back("Location", app.config().report.empty() ? "/play" : "/report/index.html");
  if (!app.config().guard.token.empty() && !call.request.parameter("token").empty())
    answer.headers.emplace_back(
        "Set-Cookie", "contort=" + app.config().guard.token + "; HttpOnly; SameSite=Strict; Path=/; Max-Age=43200");
  return answer;
}

Answer play_page(App& app, const Call&) {
  const Result<std::string> read = read_below(app.config().pages, "play.html");
  if (!read) return refusal(read.issue());
  std::string page = *read, policy = kPolicy;
  if (!app.config().library.empty()) {
    replace_once(page, "<html ", "<html data-engine ");
    replace_once(policy, "script-src 'self'", "script-src 'self' 'wasm-unsafe-eval'");
  }
  return page_answer(std::move(page), std::move(policy));
}

Answer page_file(App& app, const Call& call) {
  const std::string& path = call.id("rest");
  if (path == "library.js" && !app.config().library.empty()) return text_answer(app.config().library, type_of(path));
  return file_answer(app.config().pages, path);
}

// The report contains its own policy for scripts.
Answer report_file(App& app, const Call& call) {
  if (app.config().report.empty()) return refusal({"call.not_found", "", "this server has no corpus to report"});
  const std::string& path = call.id("rest");
  Answer answer =
      path.ends_with(".html") ? report_page(app.config().report, path) : file_answer(app.config().report, path);
  answer.headers.emplace_back("Cache-Control", "no-cache");
  return answer;
}

}  // namespace contort::server::calls
