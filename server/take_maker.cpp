#include "server/take_maker.h"

#include <utility>

#include "model/core/json_fields.h"

namespace contort::server {

namespace {

using json_fields::Json;

Spec in_mode(Spec spec, Mode mode) {
  spec.dynamics.mode = mode;
  return spec;
}

}  // namespace

TakeMaker::TakeMaker(Engine& engine, std::string client, std::string library)
    : engine_(engine), client_(std::move(client)), library_(std::move(library)) {}

Result<Reply> TakeMaker::run(TaskKind kind, const Spec& spec, Urgency urgency) {
  Task task{kind, spec, 0, 0, library_, "", ""};
  if (kind == TaskKind::play) {
    task.take_frames = static_cast<int>(engine_.limits().take_s * spec.rate_hz) + 1;
    task.most_frames = static_cast<int>(engine_.limits().most_s * spec.rate_hz) + 1;
  }
  Worked worked = engine_.run(task, client_, urgency);
  cpu_s_ += worked.cpu_s;
  return std::move(worked.reply);
}

Result<PlayedTake> TakeMaker::take(int number, const Spec& spec, const std::vector<Mode>& modes) {
  PlayedTake take{number, spec, {}};
  for (const Mode mode : modes) {
    const Result<Reply> reply = run(TaskKind::play, in_mode(spec, mode));
    if (!reply) return reply.issue();
    if (reply->bytes.size() > static_cast<std::size_t>(engine_.limits().frame_bytes))
      return Issue{"take.too_long", "", "the motion has too many frames and joints to be shown"};
    Result<std::shared_ptr<const Played>> played = played_of(*reply);
    if (!played) return played.issue();
    take.spec.hold_frames = json_fields::parse_document(reply->head)->value("hold_frames", 0);
    take.played[mode] = *played;
  }
  return take;
}

Result<PlayedModel> TakeMaker::model(const Spec& spec) {
  const Result<Reply> reply = run(TaskKind::model, spec);
  if (!reply) return reply.issue();
  const Result<Json> head = json_fields::parse_document(reply->head);
  if (!head) return head.issue();
  const Json rest = head->at("rest");
  const auto part = [&](std::size_t i) { return rest[i].get<double>(); };
  return PlayedModel{reply->head, Quat(part(3), part(0), part(1), part(2))};
}

Result<std::string> TakeMaker::judged(const Spec& spec, Mode mode) {
  const Result<Reply> reply = run(TaskKind::judge, in_mode(spec, mode), Urgency::later);
  if (!reply) return reply.issue();
  return reply->head.substr(1);
}

}  // namespace contort::server
