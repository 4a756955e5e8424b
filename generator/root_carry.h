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

  // The base's root is where the character stands now.
  void settle() { base_stands_at_ = stands_at_; }

  // Moves a root of the base from the place where it was made to the character's present place.
  void bring_along(Rigid& base_root);

  // A turn about +Y and a place on the plane y = 0.
  const Rigid& stands_at() const { return stands_at_; }
  const std::array<Rigid, kMaxLegs>& soles() const { return soles_; }  // where legs have placed them

  // The soles in a posture: where legs have placed them, or elsewhere if another action has moved a leg.
  std::array<Rigid, kMaxLegs> soles_in(std::span<const Rigid> world) const;
  LegsBelow below() const { return {*stage_->character, stage_->legs, stage_->environment}; }

 private:
  const Stage* stage_ = nullptr;
  Rigid stands_at_;
  Rigid base_stands_at_;  // its place when the base's root was made
  std::array<Rigid, kMaxLegs> soles_{};
};

}  // namespace contort
