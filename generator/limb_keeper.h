// Corrects a limb once all of its parts are placed: standing feet stay in place, and moving limbs keep their distance
// from bodies.
#pragma once

#include <array>
#include <optional>

#include "generator/actions/course_ahead.h"
#include "generator/generate.h"

namespace contort {

class LimbKeeper {
 public:
  LimbKeeper(const Stage& stage, GenerateScratch& scratch) : stage_(stage), s_(scratch) {}

  // Finds the posture in which a leg of this part has its foot at rest, if a trunk carries it and its base has not
  // changed since. The part's carriers are placed.
  void rest(std::size_t p);

  // Returns true if only the trunk that carries it moves this part of a leg, over a foot that stands.
  bool stays_planted(std::size_t p) const;

  // Returns true if this part of a leg on the hips stays as it is and its foot stands, though it may have moved until
  // now: a course of legs has ended, and the hips have stopped in the same frame.
  bool stops_with_hips(std::size_t p) const;

  // Returns true for a leg, or its foot, that reacts to a blow. Such a leg follows its action without the limits of
  // acceleration at ease, because its foot is lifted at once: a slower leg would pass its place.
  bool is_struck(std::size_t p) const;

  void finish(const Playback& playback, const Limb& limb);

  // Call it at the end of a frame, to record the places of standing feet.
  void note_feet(const Playback& playback);

 private:
  bool makes_way(const Playback& playback, std::size_t p) const;
  bool swings_at_obstacles(const Playback& playback, std::size_t p) const;
  bool comes_back(std::size_t p) const;
  HeldObject held_by(const Playback& playback, std::size_t p) const;
  bool is_as_rested(const Leg& leg) const;
  void note_grasp(const Playback& playback, const Limb& limb, const HeldObject& held);
  bool acts(const Playback& playback, const Limb& limb) const;
  bool is_posed_anew(const Playback& playback, const Limb& limb) const;
  LegUse use_of(const Playback& playback, const Limb& limb) const;
  const Limb& limb_at(std::size_t p) const { return s_.rules.room().limb_of(p); }
  void shift(const Limb& limb, Shift shift);
  void plant(const Limb& limb);
  bool stays_after_course(int leg) const;
  bool stay_after_course(int leg);
  void place(const Leg& leg, const Posture& posture);
  bool land(const Playback& playback, const Limb& limb);
  bool land(const Playback& playback, const Limb& limb, double gap_m);
  bool is_coming_in(const Playback& playback, const Limb& limb) const;
  bool returns(const Limb& limb) const;
  void stop_returning(const Limb& limb);
  const Posture& home_of(const Limb& limb, int part) const;
  Rigid home_sole(const Limb& limb, const Leg& leg);
  void follow_in_joints(const Limb& limb);
  bool step_home(const Limb& limb, LandingStep step);
  void go_on_landing(const Limb& limb);
  bool rise(const Limb& limb);
  void hold_over_feet(const Playback& playback, const Limb& limb);
  bool is_carried_and_stands(const Playback& playback, const Limb& limb, int leg) const;
  bool is_carried_on_course(const Playback& playback, const Limb& limb, int leg) const;
  std::optional<FramesAhead> course_of_legs(const Playback& playback) const;
  bool has_moved(const Limb& limb) const;
  bool feet_reach(const Playback& playback, const Limb& limb, double steps, const std::optional<FramesAhead>& course);
  enum class SoleUse { stays, bends, goes };  // it stays where it was, or follows a bend or a gait
  template <class Visit>
  bool visit_soles(const Playback& playback, const Limb& limb, double steps, const std::optional<FramesAhead>& course,
                   Visit visit);
  double feet_missed_m(const Playback& playback, const Limb& limb, double steps,
                       const std::optional<FramesAhead>& course);
  bool takes_feet_away(const Playback& playback, const Limb& limb, const std::optional<FramesAhead>& course);
  bool is_smooth(const Limb& limb) const;
  bool has_room_on_the_way(const Limb& limb, double gap_m, bool is_rising = false);
  void arrive(const Limb& limb);
  void keep_clear(const Limb& limb, bool was_lifted, double gap_m);
  bool loses_room(const Playback& playback, const Limb& limb);
  bool loses_room_of_pose(const Limb& limb);
  bool squeezes_past(const Limb& limb) const;
  void note_stuck(const Limb& limb);
  void try_again(const Playback& playback, const Limb& limb);

  const Stage& stage_;
  GenerateScratch& s_;
  std::array<Rigid, kMaxLegs> home_;  // places of the soles of a limb that lands
  std::array<bool, kMaxLegs> is_raised_{};  // true if the home was in the ground
};

}  // namespace contort
