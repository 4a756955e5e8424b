// Calls about the corpus, and jobs.
#include "corpus/lifecycle.h"
#include "server/bodies_fields.h"
#include "server/routes.h"

namespace contort::server::calls {

namespace {

Answer text_answer(const Result<std::string>& text) {
  if (!text) return refusal(text.issue());
  Answer answer;
  answer.body = *text;
  return answer;
}

Answer job_answer(App& app, const Result<std::string>& id) {
  if (!id) return refusal(id.issue());
  const Result<Job> job = app.jobs().find(*id);
  return job ? text_answer(print_job(*job)) : refusal(job.issue());
}

// Answers after the change is on disk.
template <class Body>
Answer change_bucket(App& app, const Call& call,
                     Result<Bucket> (*edit)(const Bucket&, const Body&, const std::string&)) {
  const Result<Body> body = json_fields::read_document<Body>(call.request.body, "call");
  if (!body) return refusal(body.issue());
  const Result<const Triage*> corpus = app.writable_corpus();
  if (!corpus) return refusal(corpus.issue());
  const std::string today = app.config().today();
  const Answer answer = text_answer((*corpus)->change(
      call.id("bucket"), [&](const Bucket& bucket) { return edit(bucket, *body, today); }, today));
  app.tick();
  return answer;
}

Answer start(App& app, const Call& call, const char* kind,
             Result<Jobs::Work> (Triage::*work)(const std::string&) const) {
  const Result<const Triage*> corpus = app.writable_corpus();
  if (!corpus) return refusal(corpus.issue());
  if (const Result<Done> may = app.engine().may_work(call.request.client); !may) return refusal(may.issue());
  const Result<Jobs::Work> made = ((*corpus)->*work)(call.id("bucket"));
  if (!made) return refusal(made.issue());
  return job_answer(app, app.jobs().add(kind, call.id("bucket"), call.request.client, *made));
}

}  // namespace

Answer list_corpus(App& app, const Call&) {
  const Result<const Triage*> corpus = app.corpus();
  return corpus ? text_answer((*corpus)->list(app.config().today())) : refusal(corpus.issue());
}

Answer show_bucket(App& app, const Call& call) {
  const Result<const Triage*> corpus = app.corpus();
  return corpus ? text_answer((*corpus)->show(call.id("bucket"), app.config().today())) : refusal(corpus.issue());
}

Answer acknowledge_bucket(App& app, const Call& call) {
  return change_bucket<AcknowledgeBody>(app, call,
                                        [](const Bucket& bucket, const AcknowledgeBody& body, const std::string&) {
                                          return acknowledge(bucket, body.owner, body.ticket);
                                        });
}

Answer quarantine_bucket(App& app, const Call& call) {
  return change_bucket<QuarantineBody>(app, call,
                                       [](const Bucket& bucket, const QuarantineBody& body, const std::string& today) {
                                         return quarantine(bucket, body.owner, body.reason, body.expires, today);
                                       });
}

Answer note_bucket(App& app, const Call& call) {
  return change_bucket<NoteBody>(app, call, [](const Bucket& bucket, const NoteBody& body, const std::string&) {
    return Result<Bucket>(annotate(bucket, body.text));
  });
}

Answer replay_bucket(App& app, const Call& call) { return start(app, call, "replay", &Triage::replay_work); }
Answer shrink_bucket(App& app, const Call& call) { return start(app, call, "shrink", &Triage::shrink_work); }

Answer make_report(App& app, const Call&) {
  if (const Result<const Triage*> corpus = app.writable_corpus(); !corpus) return refusal(corpus.issue());
  return job_answer(app, app.make_report());
}

Answer show_job(App& app, const Call& call) { return job_answer(app, call.id("job")); }

Answer events(App& app, const Call& call) {
  auto seen = std::make_shared<News::Seen>();
  return app.stream(call.request.client, [&app, seen](bool& more) {
    std::vector<Event> events = app.news().since(*seen);
    if (app.news().closed()) more = false;
    return events;
  });
}

}  // namespace contort::server::calls
