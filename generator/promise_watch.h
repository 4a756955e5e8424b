// Records after each frame which parts are not at their wanted places, with the reason, and in which frames an aim is
// fully in force.
#pragma once

#include <optional>

#include "generator/generate.h"

namespace contort {

class PromiseWatch {
 public:
  PromiseWatch(const Stage& stage, GenerateScratch& scratch) : stage_(stage), s_(scratch) {}

  // Call it when all parts are placed.
  void note(const Playback& playback, std::size_t part);

 private:
  bool falls_short(std::size_t p) const;
  bool is_coming(const Playback& playback, const LayerHold& ik) const;
  std::optional<Shortfall> shortfall_of(const Playback& playback, std::size_t p) const;
  void note_lag(const Playback& playback, std::size_t p);
  bool is_alone(const Playback& playback, const PlannedAction& aim, std::size_t p) const;
  bool is_full(const Playback& playback, const LayerHold& hold) const;
  void record_aim(const Playback& playback, std::size_t p);

  const Stage& stage_;
  GenerateScratch& s_;
};

}  // namespace contort
