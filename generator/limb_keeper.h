// The last word on a limb once all of its parts are placed: feet that carry nothing new stay where they stand, and
// limbs that act keep clear of bodies.
#pragma once

#include "generator/generate.h"

namespace contort {

class LimbKeeper {
 public:
  LimbKeeper(const Stage& stage, GenerateScratch& scratch) : stage_(stage), s_(scratch) {}

  void finish(const Playback& playback, const Limb& limb);

  // At the end of a frame: where feet stand.
  void note_feet(const Playback& playback);

 private:
  bool makes_way(const Playback& playback, std::size_t p) const;
  bool comes_back(std::size_t p) const;
  HeldObject held_by(const Playback& playback, std::size_t p) const;
  void note_grasp(const Playback& playback, const Limb& limb, const HeldObject& held);
  bool acts(const Playback& playback, const Limb& limb) const;
  LegUse use_of(const Playback& playback, const Limb& limb) const;
  const Limb& limb_at(std::size_t p) const { return s_.rules.room().limb_of(p); }
  void shift(const Limb& limb, Shift shift);
  void plant(const Limb& limb);
  void place(const Leg& leg, const Posture& posture);
  bool land(const Limb& limb);
  bool land(const Limb& limb, double gap_m);
  Rigid rest_sole(const Leg& leg);
  bool step_to_base(const Limb& limb, double share);
  void hold_over_feet(const Limb& limb);
  bool is_carried_and_stands(const Limb& limb, int leg) const;
  bool has_moved(const Limb& limb) const;
  bool feet_reach(const Limb& limb, double steps);
  bool is_smooth(const Limb& limb) const;
  bool has_room_on_the_way(const Limb& limb, double gap_m);
  void arrive(const Limb& limb);
  void keep_clear(const Limb& limb, bool was_lifted);
  void try_again(const Playback& playback, const Limb& limb);

  const Stage& stage_;
  GenerateScratch& s_;
};

}  // namespace contort
