#include "server/session.h"

#include <algorithm>
#include <utility>

namespace contort::server {

namespace {

constexpr auto kLookEvery = std::chrono::milliseconds(20);

}  // namespace

Result<std::shared_ptr<Session>> Session::open(const SessionDesc& desc, Engine& engine) {
  std::shared_ptr<Session> session(new Session(desc, engine));
  Result<PlayedModel> model = session->maker_.model(desc.spec);
  if (!model) return model.issue();
  Result<PlayedTake> take = session->maker_.take(1, desc.spec, desc.modes);
  if (!take) return take.issue();
  const std::lock_guard lock(session->mutex_);
  session->used_ = now();
  session->shown_.set_model(std::move(model).value());
  session->shown_.begin_take(std::move(take).value(), desc.modes, now());
  session->tell();
  return session;
}

void Session::tell() {
  changed_.notify_all();
  judge_soon();
}

// ---- judging

void Session::judge_soon() {
  engine_.later(desc_.id, [weak = weak_from_this()] {
    if (const std::shared_ptr<Session> session = weak.lock()) session->judge();
  });
}

// Stops if the spec is edited, because the results would be about a spec that is not shown any more.
void Session::judge() {
  std::unique_lock lock(mutex_);
  const std::int64_t revision = shown_.revision();
  const Spec spec = shown_.take().spec;
  const std::vector<Mode> modes = shown_.modes();
  for (const Mode mode : modes) {
    if (revision != shown_.revision() || closed_) return;
    lock.unlock();
    const Result<std::string> judged = maker_.judged(spec, mode);
    lock.lock();
    if (revision != shown_.revision()) return;
    if (judged) shown_.set_judged(mode, {revision, *judged});
    if (!judged) shown_.set_problem(print_issue(judged.issue()));
    changed_.notify_all();
  }
}

// ---- commands

Result<Done> Session::command(const Edit& edit) {
  touch();
  if (has_ended()) roll();
  const std::lock_guard command(commands_);
  std::unique_lock lock(mutex_);
  const std::vector<Mode> modes = shown_.modes();
  const int number = shown_.take().number;
  const Result<Spec> spec = edit(shown_.take().spec, {shown_.frame(now()), shown_.main().queue});
  lock.unlock();
  if (!spec) return spec.issue();
  Result<PlayedTake> take = maker_.take(number, *spec, modes);
  if (!take) return take.issue();
  lock.lock();
  shown_.amend_take(std::move(take).value());
  tell();
  return Done{};
}

Result<Done> Session::change(const Change& change) {
  touch();
  const std::lock_guard command(commands_);
  std::unique_lock lock(mutex_);
  std::vector<Mode> modes = shown_.modes();
  Spec spec = shown_.standing_spec(shown_.frame(now()));
  const int number = shown_.take().number + 1;
  lock.unlock();
  if (const Result<Done> done = change(spec, modes); !done) return done.issue();
  Result<PlayedModel> model = maker_.model(spec);
  if (!model) return model.issue();
  Result<PlayedTake> take = maker_.take(number, spec, modes);
  if (!take) return take.issue();
  lock.lock();
  shown_.set_model(std::move(model).value());
  shown_.begin_take(std::move(take).value(), std::move(modes), now());
  tell();
  return Done{};
}

void Session::move_clock(const std::function<void(SessionState&)>& move) {
  touch();
  {
    const std::lock_guard lock(mutex_);
    move(shown_);
  }
  changed_.notify_all();
}

void Session::play(bool playing) {
  move_clock([playing](SessionState& shown) { shown.play(playing, now()); });
}

void Session::step(int frames) {
  move_clock([frames](SessionState& shown) { shown.stop_at(shown.frame(now()) + frames, now()); });
}

void Session::restart() {
  move_clock([](SessionState& shown) { shown.restart(now()); });
}

// ---- the next take

bool Session::has_ended() const {
  const std::lock_guard lock(mutex_);
  return shown_.has_ended(now());
}

bool Session::ends_soon() const {
  const std::lock_guard lock(mutex_);
  return shown_.needs_next(now());
}

// Does nothing while another thread changes the take, because that makes the next take useless.
void Session::prepare_next() {
  const std::unique_lock command(commands_, std::try_to_lock);
  if (!command.owns_lock()) return;
  std::unique_lock lock(mutex_);
  if (shown_.has_tried_next()) return;
  const std::int64_t revision = shown_.revision();
  const Spec spec = shown_.standing_spec(shown_.last_frame());
  const std::vector<Mode> modes = shown_.modes();
  const int number = shown_.take().number + 1;
  lock.unlock();
  Result<PlayedTake> take = maker_.take(number, spec, modes);
  lock.lock();
  shown_.set_next(take ? std::optional(*take) : std::nullopt, revision);
  if (!take) shown_.set_problem(print_issue(take.issue()));
}

void Session::roll() {
  prepare_next();
  const std::unique_lock command(commands_, std::try_to_lock);
  if (!command.owns_lock()) return;
  const std::lock_guard lock(mutex_);
  if (!shown_.has_ended(now())) return;
  const std::int64_t before = shown_.revision();
  shown_.roll(now());
  changed_.notify_all();
  if (shown_.revision() != before) judge_soon();
}

// ---- what is asked

std::vector<Event> Session::events(StreamState& stream, Time until) {
  for (;;) {
    touch();
    if (ends_soon()) prepare_next();
    if (has_ended()) roll();
    std::unique_lock lock(mutex_);
    const Time at = now();
    std::vector<Event> events = events_of(shown_, stream, at);
    if (!events.empty() || closed_ || at >= until) return events;
    changed_.wait_until(lock, shown_.clock().playing() ? std::min(until, at + kLookEvery) : until);
  }
}

std::string Session::state() const {
  const std::lock_guard lock(mutex_);
  return print_state(shown_, desc_.id, cpu_s(), now());
}

std::string Session::model() const {
  const std::lock_guard lock(mutex_);
  return "{\"model\":" + std::to_string(shown_.model_number()) + "," + shown_.model().substr(1);
}

std::string Session::frames(Mode mode, int from, int count) const {
  const std::lock_guard lock(mutex_);
  const auto found = shown_.take().played.find(mode);
  return found == shown_.take().played.end() ? "" : found->second->frames_from(from, count);
}

std::optional<Spec> Session::spec_of(int take, Mode mode) const {
  const std::lock_guard lock(mutex_);
  return shown_.spec_of(take, mode);
}

int Session::take() const {
  const std::lock_guard lock(mutex_);
  return shown_.take().number;
}

std::vector<Mode> Session::modes() const {
  const std::lock_guard lock(mutex_);
  return shown_.modes();
}

void Session::touch() {
  const std::lock_guard lock(mutex_);
  used_ = now();
}

double Session::idle_s(Time at) const {
  const std::lock_guard lock(mutex_);
  return std::chrono::duration<double>(at - used_).count();
}

std::size_t Session::bytes() const {
  const std::lock_guard lock(mutex_);
  return shown_.bytes();
}

void Session::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool Session::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace contort::server
