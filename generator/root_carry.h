// The place to which legs have carried the character, and the places of its feet.
#pragma once

#include <array>

#include "generator/motion/root_blend.h"
#include "generator/stage.h"

namespace contort {

// Places are in the world, in metres. After a walk the base posture is brought along, so that fading to it does not
// pull the character back.
class RootCarry {
 public:
  // Begins at the stage's start and places `posture`, which is at rest, there: on uneven ground hips and feet adapt to
  // the ground. `world` is scratch, with an entry for each joint.
  void begin(const Stage& stage, std::span<Rigid> world, Posture& posture);

  // Legs have moved the character in this frame.
  void remember(const GaitFrame& frame);

  // The base's root becomes `settled`, where the character stands now.
  void settle(const Rigid& base_root, const Rigid& settled);

  // A course of legs begins, which may bring the feet home: raises a root of the base that was lowered for them.
  void raise(Rigid& base_root);

  // Moves a root of the base from the place where it was made to the character's present place, and lowers it to where
  // legs that a course leaves apart reach the ground.
  void bring_along(const LegsBelow& below, Rigid& base_root);

  // A turn about +Y and a place on the plane y = 0.
  const Rigid& stands_at() const { return stands_at_; }
  const Rigid& base_stands_at() const { return base_stands_at_; }  // its place when the base's root was made
  const std::array<Rigid, kMaxLegs>& soles() const { return soles_; }  // where legs have placed them

  // The soles in a posture: where legs have placed them, or elsewhere if another action has moved a leg.
  std::array<Rigid, kMaxLegs> soles_in(std::span<const Rigid> world) const;
  LegsBelow below(const GaitFrame& frame) const {
    return {*stage_->character, stage_->legs, stage_->environment, frame.short_m};
  }

 private:
  const Stage* stage_ = nullptr;
  Rigid stands_at_;
  Rigid base_stands_at_;
  double lowered_m_ = 0.0;  // by which the base's root is lower than it would be with the feet at home
  std::array<Rigid, kMaxLegs> soles_{};
};

}  // namespace contort
