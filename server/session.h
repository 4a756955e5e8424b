// A terminal's session: a spec that grows, the motions that it makes, and a clock (docs/server.md). Safe from any
// thread.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "model/spec/dynamics_desc.h"
#include "server/engine.h"
#include "server/played.h"
#include "server/take.h"

namespace contort::server {

struct PlayedTake {
  int number = 1;
  Spec spec;
  std::map<Mode, std::shared_ptr<const Played>> played;
};

// What a stream has sent so far.
struct StreamState {
  struct Frames {
    int first = 0;
    int next = 0;
  };
  int take = 0;
  std::int64_t revision = -1;
  std::int64_t clock = -1;
  std::int64_t problem = 0;
  std::map<Mode, Frames> sent;
  std::map<Mode, std::int64_t> judged;  // revision
  Time clock_sent{};
};

// "event: <name>\ndata: <data>\n\n"
struct Event {
  std::string name;
  std::string data;
};
std::string print_event(const Event& event);

struct SessionDesc {
  std::string id;
  std::string client;
  Spec spec;
  std::vector<Mode> modes;  // the first one is whose figure goes on in the next take; not empty
  std::string library;      // folder of a registered one; ""
  bool operator==(const SessionDesc&) const = default;
};

class Session : public std::enable_shared_from_this<Session> {
 public:
  // Codes of Worker::run.
  static Result<std::shared_ptr<Session>> open(const SessionDesc& desc, Engine& engine);

  // An edit of the spec that takes effect in the frame after the present one. The motion is there when this returns;
  // where it is refused nothing has changed.
  using Edit = std::function<Result<Spec>(const Spec&, const Moment&)>;
  Result<Done> command(const Edit& edit);

  // Another character, surroundings, loads or modes: a new take, where the figure stands.
  using Change = std::function<Result<Done>(Spec&, std::vector<Mode>&)>;
  Result<Done> change(const Change& change);

  void play(bool playing);
  void step(int frames);  // stops the clock; to a frame of the take
  void restart();         // from frame 0 of the same take

  std::string state() const;  // JSON
  std::string model() const;  // JSON
  // `count` compact frames at the most; "" beyond the end or for a mode that is not played.
  std::string frames(Mode mode, int from, int count) const;
  // The spec of this take or the one before in a mode; nothing for others.
  std::optional<Spec> spec_of(int take, Mode mode) const;
  int take() const;
  std::vector<Mode> modes() const;
  const SessionDesc& desc() const { return desc_; }

  // What a stream must send now, in order; waits for it until `until`. Ends takes whose time is up.
  std::vector<Event> events(StreamState& stream, Time until);

  void touch();
  double idle_s(Time now) const;
  std::size_t bytes() const;
  double cpu_s() const;
  void close();  // streams end
  bool closed() const;

 private:
  Session(const SessionDesc& desc, Engine& engine) : desc_(desc), engine_(engine) {}

  Result<PlayedTake> made(int number, const Spec& spec, const std::vector<Mode>& modes);
  Result<std::string> made_model(const Spec& spec);
  void install(PlayedTake take, std::vector<Mode> modes);
  void begin_take(PlayedTake take, std::vector<Mode> modes);
  void amend_take(PlayedTake take);  // another spec of the same take
  void judge_soon();
  void judge();
  int frame_now() const;
  int last_frame() const;
  Spec standing_spec(const Spec& base, int frame) const;
  void prepare_next();
  void roll();
  bool ends_soon() const;
  bool has_ended() const;
  void add_events(StreamState& stream, std::vector<Event>& events, Time now) const;
  void add_take(StreamState& stream, std::vector<Event>& events) const;
  void add_frames(StreamState& stream, std::vector<Event>& events) const;
  void add_frames(Mode mode, StreamState::Frames& sent, std::vector<Event>& events) const;
  Event frames_event(Mode mode, int from, int count) const;
  void add_margins(StreamState& stream, std::vector<Event>& events) const;
  std::string mark(Mode mode) const;

  SessionDesc desc_;
  Engine& engine_;
  std::mutex commands_;  // one change of the take at a time; taken before mutex_
  mutable std::mutex mutex_;
  std::condition_variable changed_;

  PlayedTake take_;
  std::vector<Mode> modes_;
  std::int64_t revision_ = 0;  // of the take's spec; never falls
  std::vector<std::pair<std::int64_t, std::map<Mode, int>>>
      changes_;  // of this take: revision, first frames that differ
  std::optional<PlayedTake> before_;
  std::optional<PlayedTake> next_;
  std::int64_t next_for_ = -1;  // the revision that it follows
  std::string model_;
  Quat rest_ = kNoRotation;
  int model_number_ = 0;
  PlayClock clock_;
  std::int64_t clock_version_ = 0;
  std::map<Mode, std::pair<std::int64_t, std::string>> judged_;  // revision, fields of the event
  std::string problem_;
  std::int64_t problem_number_ = 0;
  Time used_{};
  double cpu_s_ = 0.0;
  bool closed_ = false;
};

}  // namespace contort::server
