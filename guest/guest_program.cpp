#include "guest/guest_program.h"

#include "guest/channel_fields.h"
#include "model/core/json_fields.h"
#include "process/ended.h"

namespace contort {

namespace {

using json_fields::Json;

constexpr char kHello[] = R"({"op":"hello","contort":[1]})";
constexpr std::size_t kMostRefusal = 500;  // greatest number of bytes of a text

// Avoids a shell if possible, because the program is then our child and ends with us.
std::vector<std::string> shell_command(const std::string& command) {
  const bool needs_shell = command.find_first_of("|&;<>()`\n") != std::string::npos;
  return {"/bin/sh", "-c", needs_shell ? command : "exec env " + command};
}

// Shortens long text, but never inside a UTF-8 character.
std::string text_of(const Json& reply, const char* name) {
  const auto found = reply.find(name);
  std::string text = found != reply.end() && found->is_string() ? found->get<std::string>() : "";
  if (text.size() <= kMostRefusal) return text;
  std::size_t end = kMostRefusal;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

std::string refusal_in(const Json& reply) {
  const std::string text = text_of(reply, "text");
  return text.empty() ? "it gives no reason" : text;
}

Issue issue_of(const Ending& ending) {
  const std::string printed = ending.printed.empty() ? "" : "; it printed: " + ending.printed;
  if (ending.kind == Ending::Kind::timeout)
    return {"generator.silent", "", "the generator did not send its manifest in time" + printed};
  return {"generator.ended", "", "the generator ended before its manifest: " + ending.signal + printed};
}

}  // namespace

GuestProgram::GuestProgram(const std::string& command, const GuestLimits& limits)
    : limits_(limits),
      program_(shell_command(command), {limits.case_s, limits.bytes}, Messages::kept, true) {}

Result<GuestManifest> GuestProgram::manifest_in(const std::string& line, const ModelReader& models) {
  Result<GuestManifest> manifest = parse_manifest(line, models);
  if (manifest && program_.has_connected() && manifest->token != program_.token())
    return Issue{"generator.bad_token", "/token", "found another value than CONTORT_TOKEN has"};
  return manifest;
}

// Reads the manifest. If the program connects, it is greeted again over the connection. Other lines before the manifest
// are its log.
Result<GuestManifest> GuestProgram::greet(const ModelReader& models) {
  program_.send_line(kHello);
  bool has_connected = false;
  for (;;) {
    const Ending heard = program_.read_line({}, limits_.start_s);
    if (heard.kind != Ending::Kind::finished) return issue_of(heard);
    if (heard.result.starts_with("{")) return manifest_in(heard.result, models);
    if (program_.has_connected() && !has_connected) program_.send_line(kHello);
    has_connected = program_.has_connected();
    program_.keep_message(heard.result + "\n");
  }
}

void GuestProgram::fail(const std::string& what, const std::string& details) {
  program_.keep_message("\n" + details);
  throw ProgramEnded(program_.end_because(what));
}

std::string GuestProgram::read(Ending ending) {
  if (ending.kind != Ending::Kind::finished) throw ProgramEnded(ending);
  return std::move(ending.result);
}

GuestAnswer GuestProgram::ask(const std::string& request, std::int64_t id, const AnswerSize& size,
                              std::span<const GuestChannel> channels) {
  program_.send_line(request);
  const std::string line = read(program_.read_line());
  const Result<Json> reply = json_fields::parse_document(line);
  if (!reply || !reply->is_object()) fail(kNoJson, "found instead of a reply: " + line.substr(0, kMostRefusal));
  if (const auto found = reply->find("id"); found == reply->end() || *found != id)
    fail(kWrongId, "found another id than " + std::to_string(id) + " in: " + line.substr(0, kMostRefusal));
  const std::string error = text_of(*reply, "error");
  if (error == "refused") return {refusal_in(*reply), {}, {}};
  if (!error.empty()) fail(kFailed, text_of(*reply, "text"));
  const auto count = reply->find("bytes");
  if (count == reply->end() || !count->is_number_integer() || *count != size.bytes)
    fail(kWrongLength, "asked for " + std::to_string(size.bytes) + " bytes of frames; the reply was: " +
                             line.substr(0, kMostRefusal));
  Result<ChannelFacts> facts = read_channels(*reply, channels, size.frames);
  if (!facts) fail(kWrongChannels, facts.issue().pointer + ": " + facts.issue().text);
  return {{}, read(program_.read_bytes(size.bytes)), std::move(facts).value()};
}

}  // namespace contort
