#include "server/session_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/json_fields.h"
#include "model/spec/dynamics_desc.h"
#include "server/take.h"

namespace contort::server {

namespace {

using json_fields::Json;

constexpr double kPrepare_s = 1.5;  // the next take is made this long before the end of a take

bool is_finite_place(const Rigid& place) {
  return std::isfinite(glm::dot(place.p_m, place.p_m)) && std::isfinite(place.q.w + place.q.x + place.q.y + place.q.z);
}

std::string word_of(Mode mode) { return std::string(mode_names()[static_cast<std::size_t>(mode)]); }

std::size_t frame_bytes_of(const std::optional<PlayedTake>& take) {
  std::size_t bytes = 0;
  if (take)
    for (const auto& [mode, played] : take->played) bytes += played->frames.size();
  return bytes;
}

Json queue_json(const Played& played) {
  Json queue = Json::array();
  for (const QueueSpan& span : played.queue)
    queue.push_back({{"first_frame", span.first_frame}, {"last_frame", span.last_frame}, {"sequence", span.sequence}});
  return queue;
}

Json modes_json(const SessionState& shown) {
  Json modes = Json::array();
  for (const Mode mode : shown.modes()) modes.push_back(word_of(mode));
  return modes;
}

Json hashes_json(const SessionState& shown) {
  Json hashes = Json::object();
  for (const Mode mode : shown.modes()) hashes[word_of(mode)] = shown.take().played.at(mode)->motion_hash;
  return hashes;
}

Json findings_json(const SessionState& shown) {
  Json findings = Json::object();
  for (const Mode mode : shown.modes())
    if (const auto judged = shown.judged().find(mode); judged != shown.judged().end())
      findings[word_of(mode)] = json_fields::parse_document("{" + judged->second.fields)->at("findings");
  return findings;
}

}  // namespace

// ---- takes

void SessionState::install(PlayedTake take, std::vector<Mode> modes) {
  ++revision_;
  take_ = std::move(take);
  modes_ = std::move(modes);
  judged_.clear();
}

void SessionState::begin_take(PlayedTake take, std::vector<Mode> modes, Time now) {
  if (revision_ > 0) before_ = std::move(take_);
  changes_.clear();
  clock_.set(0, clock_.playing(), now);
  install(std::move(take), std::move(modes));
}

void SessionState::amend_take(PlayedTake take) {
  Change change{revision_ + 1, {}};
  for (const auto& [mode, played] : take.played)
    change.first_frames[mode] = played->first_difference(*take_.played.at(mode));
  changes_.push_back(std::move(change));
  install(std::move(take), modes_);
}

void SessionState::set_model(PlayedModel model) {
  if (model.json != model_.json) ++model_number_;
  model_ = std::move(model);
}

int SessionState::first_change(Mode mode, std::int64_t since, int unchanged) const {
  int first = unchanged;
  for (const Change& change : changes_)
    if (change.revision > since) first = std::min(first, change.first_frames.at(mode));
  return first;
}

std::optional<Spec> SessionState::spec_of(int take, Mode mode) const {
  const PlayedTake* meant = take == take_.number ? &take_ : before_ && before_->number == take ? &*before_ : nullptr;
  if (meant == nullptr || !meant->played.contains(mode)) return std::nullopt;
  Spec spec = meant->spec;
  spec.dynamics.mode = mode;
  return spec;
}

std::size_t SessionState::bytes() const {
  return model_.json.size() + frame_bytes_of(take_) + frame_bytes_of(before_) + frame_bytes_of(next_);
}

// ---- the clock

void SessionState::play(bool playing, Time now) { clock_.set(frame(now), playing, now); }

void SessionState::stop_at(int frame, Time now) { clock_.set(std::clamp(frame, 0, last_frame()), false, now); }

void SessionState::restart(Time now) { clock_.set(0, clock_.playing(), now); }

int SessionState::frame(Time now) const { return std::clamp(clock_.frame(main().rate_hz, now), 0, last_frame()); }

bool SessionState::has_ended(Time now) const { return clock_.playing() && frame(now) >= last_frame(); }

// ---- the next take

Spec SessionState::standing_spec(int frame) const {
  const Rigid root = main().root(frame);
  if (is_finite_place(root)) return next_take(take_.spec, root, model_.rest);
  Spec again = next_take(take_.spec, {model_.rest, take_.spec.start.position_m}, model_.rest);
  again.start = take_.spec.start;
  return again;
}

bool SessionState::needs_next(Time now) const {
  return clock_.playing() && !has_tried_next() && frame(now) + kPrepare_s * main().rate_hz > last_frame();
}

void SessionState::set_next(std::optional<PlayedTake> take, std::int64_t revision) {
  next_ = std::move(take);
  next_for_ = revision;
}

void SessionState::roll(Time now) {
  if (next_ && has_tried_next()) return begin_take(*std::exchange(next_, std::nullopt), modes_, now);
  next_for_ = -1;
  stop_at(last_frame(), now);
}

// ---- as JSON

std::string print_state(const SessionState& shown, const std::string& session, double cpu_s, Time now) {
  return json_fields::compact_text({{"session", session},
                                    {"spec", *json_fields::parse_document(print_spec(shown.take().spec))},
                                    {"take", shown.take().number},
                                    {"revision", shown.revision()},
                                    {"frame", shown.frame(now)},
                                    {"frame_count", shown.main().frame_count},
                                    {"rate_hz", shown.main().rate_hz},
                                    {"playing", shown.clock().playing()},
                                    {"modes", modes_json(shown)},
                                    {"model", shown.model_number()},
                                    {"motion_hashes", hashes_json(shown)},
                                    {"findings", findings_json(shown)},
                                    {"queue", queue_json(shown.main())},
                                    {"cpu_s", cpu_s}});
}

}  // namespace contort::server
