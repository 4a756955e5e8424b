// A client's session: a spec that grows, its motions, and a clock (docs/reference/server.md). It can be used from any
// thread: one mutex guards the shown state, and workers run while nobody holds it.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "model/spec/dynamics_desc.h"
#include "server/engine.h"
#include "server/session_state.h"
#include "server/stream.h"
#include "server/take.h"
#include "server/take_maker.h"

namespace contort::server {

struct SessionDesc {
  std::string id;
  std::string client;
  Spec spec;
  std::vector<Mode> modes;  // not empty; the next take continues the figure of the first mode
  std::string library;      // folder of a registered library; "": none
  bool operator==(const SessionDesc&) const = default;
};

class Session : public std::enable_shared_from_this<Session> {
 public:
  // Opens a session. Codes of Worker::run.
  static Result<std::shared_ptr<Session>> open(const SessionDesc& desc, Engine& engine);

  // Applies an edit of the spec that takes effect in the frame after the present one. The motion is generated when
  // this returns; if it is refused, nothing has changed.
  using Edit = std::function<Result<Spec>(const Spec&, const Moment&)>;
  Result<Done> command(const Edit& edit);

  // Changes character, surroundings, loads or modes: begins a new take where the figure stands.
  using Change = std::function<Result<Done>(Spec&, std::vector<Mode>&)>;
  Result<Done> change(const Change& change);

  void play(bool playing);
  void step(int frames);  // stops the clock, and goes to a frame of the take
  void restart();         // from frame 0 of the same take

  std::string state() const;  // JSON
  std::string model() const;  // JSON
  // Returns at most `count` compact frames; "" beyond the end or for a mode that is not played.
  std::string frames(Mode mode, int from, int count) const;
  // Returns the spec of this take or the previous one in a mode; nothing for other takes or modes.
  std::optional<Spec> spec_of(int take, Mode mode) const;
  int take() const;
  std::vector<Mode> modes() const;
  const SessionDesc& desc() const { return desc_; }

  // Returns the events that a stream must send now, in order; waits for some until `until`. Ends takes whose time is
  // up.
  std::vector<Event> events(StreamState& stream, Time until);

  void touch();
  double idle_s(Time now) const;
  std::size_t bytes() const;
  double cpu_s() const { return maker_.cpu_s(); }
  void close();  // ends the streams
  bool closed() const;

 private:
  Session(const SessionDesc& desc, Engine& engine)
      : desc_(desc), engine_(engine), maker_(engine, desc.client, desc.library) {}

  // Call after the shown spec has changed: wakes the streams, and has the spec judged soon. With mutex_ held.
  void tell();
  void judge_soon();
  void judge();
  void move_clock(const std::function<void(SessionState&)>& move);
  bool has_ended() const;
  bool ends_soon() const;
  void prepare_next();
  void roll();

  const SessionDesc desc_;
  Engine& engine_;
  TakeMaker maker_;
  std::mutex commands_;  // one change of the take at a time; taken before mutex_
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  SessionState shown_;
  Time used_{};
  bool closed_ = false;
};

}  // namespace contort::server
