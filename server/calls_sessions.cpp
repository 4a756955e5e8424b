// Calls about sessions.
#include <charconv>

#include "server/bodies_fields.h"
#include "server/routes.h"

namespace contort::server::calls {

namespace {

using json_fields::Json;

using Found = Result<std::shared_ptr<Session>>;

Found session_of(App& app, const Call& call) { return app.sessions().find(call.id("session")); }

Answer json_answer(std::string body) {
  Answer answer;
  answer.body = std::move(body);
  return answer;
}

// The state after a command, or the reason of its failure.
Answer after(const std::shared_ptr<Session>& session, const Result<Done>& done) {
  return done ? json_answer(session->state()) : refusal(done.issue());
}

// Reads the body, finds the session, and passes both to a function.
template <class Body>
Answer with(App& app, const Call& call, Result<Done> (*act)(Session&, const Body&)) {
  const Result<Body> body = json_fields::read_document<Body>(call.request.body, "call");
  if (!body) return refusal(body.issue());
  const Found session = session_of(app, call);
  if (!session) return refusal(session.issue());
  return after(*session, act(**session, *body));
}

std::optional<Mode> mode_of(const Call& call, const Session& session) {
  const std::string name = call.request.parameter("mode");
  for (const Mode mode : session.modes())
    if (name.empty() || name == mode_names()[static_cast<std::size_t>(mode)]) return mode;
  return std::nullopt;
}

const Issue kNoMode{"call.no_mode", "", "that mode is not played in this session"};

// Returns -1 for text that is no number.
int number_of(const std::string& text, int fallback) {
  if (text.empty()) return fallback;
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1;
}

}  // namespace

Answer open_session(App& app, const Call& call) {
  const Result<SessionBody> body = json_fields::read_document<SessionBody>(call.request.body, "spec");
  if (!body) return refusal(body.issue());
  const Result<std::string> library = app.library_folder(body->library);
  if (!library) return refusal(library.issue());
  SessionDesc desc{"", call.request.client, body->spec, body->modes, *library};
  if (desc.modes.empty()) desc.modes = {desc.spec.dynamics.mode};
  const Found session = app.sessions().open(std::move(desc));
  return session ? json_answer((*session)->state()) : refusal(session.issue());
}

Answer show_session(App& app, const Call& call) {
  const Found session = session_of(app, call);
  return session ? json_answer((*session)->state()) : refusal(session.issue());
}

Answer close_session(App& app, const Call& call) {
  const Result<Done> closed = app.sessions().close(call.id("session"));
  return closed ? json_answer("{}") : refusal(closed.issue());
}

Answer enqueue(App& app, const Call& call) {
  return with<EnqueueBody>(app, call, [](Session& session, const EnqueueBody& body) {
    return session.command(
        [&](const Spec& spec, const Moment& now) { return with_sequence(spec, body.sequence, body.enter, true, now); });
  });
}

Answer interrupt(App& app, const Call& call) {
  return with<InterruptBody>(app, call, [](Session& session, const InterruptBody& body) {
    return session.command([&](const Spec& spec, const Moment& now) {
      return with_sequence(spec, body.sequence, Enter::front, body.resume, now);
    });
  });
}

Answer aim(App& app, const Call& call) {
  return with<AimBody>(app, call, [](Session& session, const AimBody& body) {
    const AimCommand command{body.slot, body.action, body.point, body.target_m, body.duration_frames};
    return session.command([&](const Spec& spec, const Moment& now) { return with_aim(spec, command, now); });
  });
}

Answer push(App& app, const Call& call) {
  return with<PushBody>(app, call, [](Session& session, const PushBody& body) {
    const PushCommand command{body.slot, body.joint, body.point_m, body.impulse_N_s};
    return session.command([&](const Spec& spec, const Moment& now) { return with_push(spec, command, now); });
  });
}

Answer clock(App& app, const Call& call) {
  return with<ClockBody>(app, call, [](Session& session, const ClockBody& body) -> Result<Done> {
    if (body.restart) session.restart();
    if (body.step) session.step(*body.step);
    if (body.play) session.play(*body.play);
    return Done{};
  });
}

Answer change(App& app, const Call& call) {
  return with<ChangeBody>(app, call, [](Session& session, const ChangeBody& body) {
    return session.change([&](Spec& spec, std::vector<Mode>& modes) -> Result<Done> {
      if (body.character) spec.character = *body.character;
      if (body.environment) spec.environment = *body.environment;
      if (body.loads) spec.dynamics.loads = *body.loads;
      if (body.modes && body.modes->empty()) return Issue{"call.no_mode", "/modes", "at least one mode is needed"};
      if (body.modes) modes = *body.modes;
      return Done{};
    });
  });
}

Answer stream(App& app, const Call& call) {
  const Found session = session_of(app, call);
  if (!session) return refusal(session.issue());
  auto state = std::make_shared<StreamState>();
  return app.stream(call.request.client, [session = *session, state](bool& more) {
    std::vector<Event> events = session->events(*state, std::chrono::steady_clock::now() + std::chrono::seconds(1));
    if (session->closed()) more = false;
    return events;
  });
}

Answer frames(App& app, const Call& call) {
  const Found session = session_of(app, call);
  if (!session) return refusal(session.issue());
  const std::optional<Mode> mode = mode_of(call, **session);
  if (!mode) return refusal(kNoMode);
  const int from = number_of(call.request.parameter("from"), 0);
  const int count = number_of(call.request.parameter("count"), 600);
  if (from < 0 || count < 0) return refusal({"call.no_number", "", "from and count are whole numbers, 0 or more"});
  Answer answer = json_answer((*session)->frames(*mode, from, count));
  answer.type = "application/octet-stream";
  return answer;
}

Answer model(App& app, const Call& call) {
  const Found session = session_of(app, call);
  return session ? json_answer((*session)->model()) : refusal(session.issue());
}

Answer motion_file(App& app, const Call& call) {
  const Found session = session_of(app, call);
  if (!session) return refusal(session.issue());
  const std::optional<Mode> mode = mode_of(call, **session);
  const std::optional<Spec> spec = mode ? (*session)->spec_of((*session)->take(), *mode) : std::nullopt;
  if (!spec) return refusal(kNoMode);
  const Worked worked =
      app.engine().run({TaskKind::model_file, *spec, 0, 0, (*session)->desc().library, "", ""}, call.request.client);
  if (!worked.reply) return refusal(worked.reply.issue());
  Answer answer = json_answer(worked.reply->bytes);
  answer.type = "model/gltf-binary";
  answer.headers.emplace_back("Content-Disposition", "attachment; filename=\"motion.glb\"");
  return answer;
}

Answer keep_case(App& app, const Call& call) {
  const Result<CaseBody> body = json_fields::read_document<CaseBody>(call.request.body, "call");
  if (!body) return refusal(body.issue());
  const Found session = session_of(app, call);
  if (!session) return refusal(session.issue());
  const Result<const Triage*> corpus = app.writable_corpus();
  if (!corpus) return refusal(corpus.issue());
  const int take = body->take == 0 ? (*session)->take() : body->take;
  const std::optional<Spec> spec = (*session)->spec_of(take, body->mode);
  if (!spec) return refusal({"take.gone", "", "that take does not exist any more, or not in that mode"});
  if (!(*session)->desc().library.empty())
    return refusal({"session.own_library", "",
                    "cases of registered libraries cannot be replayed from a corpus; start the "
                    "server with --library DIR"});
  const Worked worked =
      app.engine().run({TaskKind::make_case, *spec, 0, 0, "", body->check, body->subject}, call.request.client);
  if (!worked.reply) return refusal(worked.reply.issue());
  const Result<Case> made = parse_case(worked.reply->head);
  const Result<std::string> kept = made ? (*corpus)->keep(*made) : Result<std::string>(made.issue());
  if (!kept) return refusal(kept.issue());
  app.tick();
  return json_answer(*kept);
}

}  // namespace contort::server::calls
