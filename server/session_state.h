// The state that a session shows: its take, the take's clock, the previous and the next take, and the checks'
// results. It consists of plain values without threads, locks or workers; times are arguments. A Session guards it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/played.h"

namespace contort::server {

// The character with its surroundings, as TaskKind::model prints it.
struct PlayedModel {
  std::string json;
  Quat rest = kNoRotation;  // the root's rotation in the rest pose
};

// Findings and curves of one mode.
struct Judged {
  std::int64_t revision = 0;  // revision of the judged spec
  std::string fields;         // fields of the event except take, revision and mode
  bool operator==(const Judged&) const = default;
};

class SessionState {
 public:
  // Begins the first take, or the one after the present one, in its frame 0. `modes` is not empty, and the take was
  // played in each of them. The figure of the first mode continues in the next take.
  void begin_take(PlayedTake take, std::vector<Mode> modes, Time now);
  // Replaces the take by another spec of the same take in the same modes; the clock continues.
  void amend_take(PlayedTake take);
  void set_model(PlayedModel model);

  const PlayedTake& take() const { return take_; }
  const std::vector<Mode>& modes() const { return modes_; }
  const Played& main() const { return *take_.played.at(modes_.front()); }
  const std::string& model() const { return model_.json; }
  int model_number() const { return model_number_; }
  std::int64_t revision() const { return revision_; }  // of the take's spec; never falls
  // Returns the first frame of a mode that differs from this revision of the take; `unchanged` if there is none.
  int first_change(Mode mode, std::int64_t since, int unchanged) const;
  // Returns the spec of this take or the previous one in a mode in which it was played; nothing for others.
  std::optional<Spec> spec_of(int take, Mode mode) const;
  std::size_t bytes() const;  // size of all frames and the model

  void play(bool playing, Time now);     // starts or stops the clock at the present frame
  void stop_at(int frame, Time now);     // stops the clock at the nearest frame of the take
  void restart(Time now);                // goes to frame 0; the clock keeps playing or stays stopped
  const PlayClock& clock() const { return clock_; }
  int frame(Time now) const;  // the present frame
  int last_frame() const { return main().frame_count - 1; }
  bool has_ended(Time now) const;

  // Returns the take's spec without actions, for a figure that stands where this one does in `frame`; if that
  // position is not finite, where the take started.
  Spec standing_spec(int frame) const;

  // The next take is made before the clock needs it. It continues one revision; an edit makes it useless.
  bool needs_next(Time now) const;  // the end is near, and there was no attempt to make the next take
  bool has_tried_next() const { return next_for_ == revision_; }
  void set_next(std::optional<PlayedTake> take, std::int64_t revision);  // empty: the take cannot be made
  // Begins the next take. If there is none, the clock stops in the last frame; playing again tries again to make the
  // next take.
  void roll(Time now);

  void set_judged(Mode mode, Judged judged) { judged_[mode] = std::move(judged); }
  const std::map<Mode, Judged>& judged() const { return judged_; }  // results for the present revision

  void set_problem(std::string text) { problem_ = std::move(text), ++problem_number_; }
  const std::string& problem() const { return problem_; }  // the last problem
  std::int64_t problem_number() const { return problem_number_; }

 private:
  void install(PlayedTake take, std::vector<Mode> modes);

  // An edit of the take, and by mode the first frame that it changed.
  struct Change {
    std::int64_t revision = 0;
    std::map<Mode, int> first_frames;
  };

  PlayedTake take_;
  std::vector<Mode> modes_;
  std::int64_t revision_ = 0;
  std::vector<Change> changes_;  // edits of this take
  std::optional<PlayedTake> before_;
  std::optional<PlayedTake> next_;
  std::int64_t next_for_ = -1;  // the revision that the next take continues
  PlayedModel model_;
  int model_number_ = 0;
  PlayClock clock_;
  std::map<Mode, Judged> judged_;
  std::string problem_;
  std::int64_t problem_number_ = 0;
};

// Prints the state of a session of this name as JSON (docs/reference/server.md).
std::string print_state(const SessionState& shown, const std::string& session, double cpu_s, Time now);

}  // namespace contort::server
