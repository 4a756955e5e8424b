#include "server/session.h"

#include <algorithm>
#include <cmath>

#include "model/core/json_fields.h"

namespace contort::server {

namespace {

using json_fields::Json;

constexpr double kPrepare_s = 1.5;  // before the end of a take the next one is made

bool is_finite(const Rigid& place) {
  return std::isfinite(glm::dot(place.p_m, place.p_m)) && std::isfinite(place.q.w + place.q.x + place.q.y + place.q.z);
}

}  // namespace

// ---- making motions

Result<std::shared_ptr<Session>> Session::open(const SessionDesc& desc, Engine& engine) {
  std::shared_ptr<Session> session(new Session(desc, engine));
  const Result<std::string> model = session->made_model(desc.spec);
  if (!model) return model.issue();
  Result<PlayedTake> take = session->made(1, desc.spec, desc.modes);
  if (!take) return take.issue();
  const std::lock_guard lock(session->mutex_);
  session->model_ = *model;
  session->model_number_ = 1;
  session->used_ = now();
  session->begin_take(std::move(take).value(), desc.modes);
  return session;
}

Result<PlayedTake> Session::made(int number, const Spec& spec, const std::vector<Mode>& modes) {
  PlayedTake take{number, spec, {}};
  for (const Mode mode : modes) {
    Task task{TaskKind::play,
              spec,
              static_cast<int>(engine_.limits().take_s * spec.rate_hz) + 1,
              static_cast<int>(engine_.limits().most_s * spec.rate_hz) + 1,
              desc_.library,
              "",
              ""};
    task.spec.dynamics.mode = mode;
    const Worked worked = engine_.run(task, desc_.client);
    {
      const std::lock_guard lock(mutex_);
      cpu_s_ += worked.cpu_s;
    }
    if (!worked.reply) return worked.reply.issue();
    if (worked.reply->bytes.size() > static_cast<std::size_t>(engine_.limits().frame_bytes))
      return Issue{"take.too_long", "", "the motion has too many frames and joints to be shown"};
    Result<std::shared_ptr<const Played>> played = played_of(*worked.reply);
    if (!played) return played.issue();
    take.spec.hold_frames = json_fields::parse_document(worked.reply->head)->value("hold_frames", 0);
    take.played[mode] = *played;
  }
  return take;
}

Result<std::string> Session::made_model(const Spec& spec) {
  const Worked worked = engine_.run({TaskKind::model, spec, 0, 0, desc_.library, "", ""}, desc_.client);
  if (!worked.reply) return worked.reply.issue();
  const Result<Json> head = json_fields::parse_document(worked.reply->head);
  if (!head) return head.issue();
  const Json rest = head->at("rest");
  const std::lock_guard lock(mutex_);
  rest_ = Quat(rest[3].get<double>(), rest[0].get<double>(), rest[1].get<double>(), rest[2].get<double>());
  cpu_s_ += worked.cpu_s;
  return worked.reply->head;
}

// All of these with mutex_ held, and with commands_ unless nobody knows the session yet. Takes change under one lock:
// whoever reads between two would find a session without motions.
void Session::install(PlayedTake take, std::vector<Mode> modes) {
  ++revision_;
  take_ = std::move(take);
  modes_ = std::move(modes);
  judged_.clear();
  changed_.notify_all();
  judge_soon();
}

void Session::begin_take(PlayedTake take, std::vector<Mode> modes) {
  if (revision_ > 0) before_ = std::move(take_);
  changes_.clear();
  clock_.set(0, clock_.playing(), now());
  ++clock_version_;
  install(std::move(take), std::move(modes));
}

void Session::amend_take(PlayedTake take) {
  std::map<Mode, int> from;
  for (const auto& [mode, played] : take.played) from[mode] = played->first_difference(*take_.played.at(mode));
  changes_.emplace_back(revision_ + 1, std::move(from));
  install(std::move(take), modes_);
}

void Session::judge_soon() {
  engine_.later(desc_.id, [weak = weak_from_this()] {
    if (const std::shared_ptr<Session> session = weak.lock()) session->judge();
  });
}

void Session::judge() {
  std::unique_lock lock(mutex_);
  const std::int64_t revision = revision_;
  const Spec spec = take_.spec;
  const std::vector<Mode> modes = modes_;
  for (const Mode mode : modes) {
    if (revision != revision_ || closed_) return;
    lock.unlock();
    Task task{TaskKind::judge, spec, 0, 0, desc_.library, "", ""};
    task.spec.dynamics.mode = mode;
    const Worked worked = engine_.run(task, desc_.client, Urgency::later);
    lock.lock();
    cpu_s_ += worked.cpu_s;
    if (revision != revision_) return;
    if (worked.reply) judged_[mode] = {revision, worked.reply->head.substr(1)};
    if (!worked.reply) problem_ = print_issue(worked.reply.issue()), ++problem_number_;
    changed_.notify_all();
  }
}

// ---- commands

int Session::last_frame() const { return take_.played.at(modes_.front())->frame_count - 1; }

int Session::frame_now() const {
  const auto& played = *take_.played.at(modes_.front());
  return std::clamp(clock_.frame(played.rate_hz, now()), 0, played.frame_count - 1);
}

Result<Done> Session::command(const Edit& edit) {
  touch();
  if (has_ended()) roll();
  const std::lock_guard command(commands_);
  std::unique_lock lock(mutex_);
  const std::vector<Mode> modes = modes_;
  const int number = take_.number;
  const auto played = take_.played.at(modes.front());
  const Result<Spec> spec = edit(take_.spec, {frame_now(), played->queue});
  lock.unlock();
  if (!spec) return spec.issue();
  Result<PlayedTake> take = made(number, *spec, modes);
  if (!take) return take.issue();
  lock.lock();
  amend_take(std::move(take).value());
  return Done{};
}

Spec Session::standing_spec(const Spec& base, int frame) const {
  const Rigid root = take_.played.at(modes_.front())->root(frame);
  if (is_finite(root)) return next_take(base, root, rest_);
  Spec again = next_take(base, {rest_, base.start.position_m}, rest_);
  again.start = base.start;
  return again;
}

Result<Done> Session::change(const Change& change) {
  touch();
  const std::lock_guard command(commands_);
  std::unique_lock lock(mutex_);
  std::vector<Mode> modes = modes_;
  Spec spec = standing_spec(take_.spec, frame_now());
  const int number = take_.number + 1;
  lock.unlock();
  if (const Result<Done> done = change(spec, modes); !done) return done.issue();
  const Quat rest = rest_;
  const Result<std::string> model = made_model(spec);
  if (!model) return model.issue();
  Result<PlayedTake> take = made(number, spec, modes);
  if (!take) {
    const std::lock_guard again(mutex_);
    return rest_ = rest, take.issue();
  }
  lock.lock();
  if (model_ != *model) model_ = *model, ++model_number_;
  begin_take(std::move(take).value(), std::move(modes));
  return Done{};
}

void Session::play(bool playing) {
  touch();
  {
    const std::lock_guard lock(mutex_);
    clock_.set(frame_now(), playing, now());
    ++clock_version_;
  }
  changed_.notify_all();
}

void Session::step(int frames) {
  touch();
  {
    const std::lock_guard lock(mutex_);
    clock_.set(std::clamp(frame_now() + frames, 0, last_frame()), false, now());
    ++clock_version_;
  }
  changed_.notify_all();
}

void Session::restart() {
  touch();
  {
    const std::lock_guard lock(mutex_);
    clock_.set(0, clock_.playing(), now());
    ++clock_version_;
  }
  changed_.notify_all();
}

// ---- takes

bool Session::has_ended() const {
  const std::lock_guard lock(mutex_);
  return clock_.playing() && frame_now() >= last_frame();
}

bool Session::ends_soon() const {
  const std::lock_guard lock(mutex_);
  const double rate_hz = take_.played.at(modes_.front())->rate_hz;
  return clock_.playing() && next_for_ != revision_ && frame_now() + kPrepare_s * rate_hz > last_frame();
}

// Somebody else who changes the take now makes this needless.
void Session::prepare_next() {
  const std::unique_lock command(commands_, std::try_to_lock);
  if (!command.owns_lock()) return;
  std::unique_lock lock(mutex_);
  if (next_for_ == revision_) return;
  const std::int64_t revision = revision_;
  const Spec spec = standing_spec(take_.spec, last_frame());
  const std::vector<Mode> modes = modes_;
  const int number = take_.number + 1;
  lock.unlock();
  Result<PlayedTake> take = made(number, spec, modes);
  lock.lock();
  next_for_ = revision;
  next_.reset();
  if (take) next_ = std::move(take).value();
  if (!take) problem_ = print_issue(take.issue()), ++problem_number_;
}

void Session::roll() {
  prepare_next();
  const std::unique_lock command(commands_, std::try_to_lock);
  if (!command.owns_lock() || !has_ended()) return;
  const std::lock_guard lock(mutex_);
  if (!next_ || next_for_ != revision_) {  // it could not be made: stand still
    next_for_ = -1;                        // who plays again asks again
    clock_.set(last_frame(), false, now());
    ++clock_version_;
    changed_.notify_all();
    return;
  }
  begin_take(*std::exchange(next_, std::nullopt), modes_);
}

// ---- what is asked

std::string Session::state() const {
  const std::lock_guard lock(mutex_);
  const Played& played = *take_.played.at(modes_.front());
  Json modes = Json::array(), findings = Json::object(), queue = Json::array(), hashes = Json::object();
  for (const Mode mode : modes_) {
    const std::string name(mode_names()[static_cast<std::size_t>(mode)]);
    modes.push_back(name);
    hashes[name] = take_.played.at(mode)->motion_hash;
    if (const auto judged = judged_.find(mode); judged != judged_.end())
      findings[name] = json_fields::parse_document("{" + judged->second.second)->at("findings");
  }
  for (const QueueSpan& span : played.queue)
    queue.push_back({{"first_frame", span.first_frame}, {"last_frame", span.last_frame}, {"sequence", span.sequence}});
  return json_fields::compact_text({{"session", desc_.id},
                                    {"spec", *json_fields::parse_document(print_spec(take_.spec))},
                                    {"take", take_.number},
                                    {"revision", revision_},
                                    {"frame", frame_now()},
                                    {"frame_count", played.frame_count},
                                    {"rate_hz", played.rate_hz},
                                    {"playing", clock_.playing()},
                                    {"modes", modes},
                                    {"model", model_number_},
                                    {"motion_hashes", hashes},
                                    {"findings", findings},
                                    {"queue", queue},
                                    {"cpu_s", cpu_s_}});
}

std::string Session::model() const {
  const std::lock_guard lock(mutex_);
  return "{\"model\":" + std::to_string(model_number_) + "," + model_.substr(1);
}

std::string Session::frames(Mode mode, int from, int count) const {
  const std::lock_guard lock(mutex_);
  const auto found = take_.played.find(mode);
  if (found == take_.played.end() || from < 0 || from >= found->second->frame_count || count <= 0) return "";
  const Played& played = *found->second;
  const auto each = static_cast<std::size_t>(played.frame_bytes());
  return played.frames.substr(static_cast<std::size_t>(from) * each, static_cast<std::size_t>(count) * each);
}

std::optional<Spec> Session::spec_of(int take, Mode mode) const {
  const std::lock_guard lock(mutex_);
  const PlayedTake* meant = take == take_.number ? &take_ : before_ && before_->number == take ? &*before_ : nullptr;
  if (meant == nullptr || !meant->played.contains(mode)) return std::nullopt;
  Spec spec = meant->spec;
  spec.dynamics.mode = mode;
  return spec;
}

int Session::take() const {
  const std::lock_guard lock(mutex_);
  return take_.number;
}

std::vector<Mode> Session::modes() const {
  const std::lock_guard lock(mutex_);
  return modes_;
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
  std::size_t bytes = model_.size();
  for (const auto* take : {&take_, before_ ? &*before_ : nullptr, next_ ? &*next_ : nullptr})
    if (take != nullptr)
      for (const auto& [mode, played] : take->played) bytes += played->frames.size();
  return bytes;
}

double Session::cpu_s() const {
  const std::lock_guard lock(mutex_);
  return cpu_s_;
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
