#include "corpus/guarded_replay.h"

#include <stdexcept>

#include "corpus/ending_case.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Json;

constexpr int kLook_ms = 100;

// Both ends of a message are this program.
Case parsed_case(const std::string& text) {
  Result<Case> read = parse_case(text);
  if (!read) throw std::logic_error(to_line(read.issue()));
  return std::move(read).value();
}

// A failure that shows now is sent as a case. Otherwise only the hash of the motion is sent.
std::string print_replay(const Case& stored, const Replay& shown) {
  Json out = {{"verdict", static_cast<int>(shown.verdict)},
              {"first_difference", shown.first_difference},
              {"character_changed", shown.character_changed},
              {"motion_hash", shown.now.motion_hash},
              {"issue", {shown.issue.code, shown.issue.pointer, shown.issue.text}}};
  if (!shown.now.check.empty()) out["now"] = print_case({stored.spec, shown.now, {}});
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Replay parse_replay(const std::string& text) {
  const Json in = Json::parse(text);
  Replay shown;
  shown.verdict = static_cast<Verdict>(in.at("verdict").get<int>());
  shown.first_difference = in.at("first_difference").get<int>();
  shown.character_changed = in.at("character_changed").get<bool>();
  if (const auto now = in.find("now"); now != in.end()) shown.now = parsed_case(now->get<std::string>()).expect;
  shown.now.motion_hash = in.at("motion_hash").get<std::string>();
  const Json& issue = in.at("issue");
  shown.issue = {issue[0].get<std::string>(), issue[1].get<std::string>(), issue[2].get<std::string>()};
  return shown;
}

WorkerPool::Work work_of(RunCase replay) {
  return [replay = std::move(replay)](const std::string& task, WorkerSlot&) {
    const Case stored = parsed_case(task);
    return print_replay(stored, replay(stored));
  };
}

// Cases that ended their process first run alone, up to their own time limit; the worker waits that much longer.
double patience_for(const Case& stored, const WorkerLimits& limits) {
  if (!is_abnormal_exit(stored.expect)) return 1.0;
  return 1.0 + isolation_of(stored.expect, isolation_of(limits)).seconds / limits.seconds;
}

}  // namespace

GuardedReplay::GuardedReplay(RunCase replay, const WorkerLimits& limits)
    : limits_(limits), pool_(1, limits, work_of(std::move(replay))) {}

Replay GuardedReplay::operator()(const Case& stored) {
  pool_.give(0, print_case(stored), patience_for(stored, limits_));
  for (;;)
    if (const std::optional<WorkerEvent> event = pool_.wait(kLook_ms))
      return event->end == WorkerEnd::replied ? parse_replay(event->text) : ended(stored, *event);
}

Replay GuardedReplay::ended(const Case& stored, const WorkerEvent& event) const {
  Replay shown;
  shown.now = ending_case(stored.spec, ending_of(event), isolation_of(limits_)).expect;
  const bool as_stored = shown.now.check == stored.expect.check && shown.now.subject == stored.expect.subject;
  shown.verdict = as_stored ? Verdict::same : Verdict::different;
  return shown;
}

}  // namespace contort
