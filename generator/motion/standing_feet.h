// Feet that stand: they stay in place while a trunk moves their hips, and are lifted before an action of their own leg
// moves them over the ground.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "model/motion/legs.h"
#include "model/world/environment.h"

namespace contort {

enum class LegUse {
  idle,
  placed,  // by a course, or by an author's key poses
  acts,    // another action moves it, or it returns from one
  lands,   // no action moves it any more, but its foot is still lifted
};

// A step of a foot that lands.
struct LandingStep {
  double share = 0.0;  // fraction of the way
  double lift = 1.0;   // fraction of the missing height over the ground by which it is lifted
};

// Legs are named by their index in find_legs(). World coordinates.
class StandingFeet {
 public:
  // All arguments must outlive this object. No foot stands until it was seen to stand.
  void begin(const Character& character, std::span<const Leg> legs, const Environment& environment);

  // Ends a frame. A foot with an action of its own counts as standing where it stood until it is well above the ground,
  // and so does an idle one on a leg that the root part does not carry. Any other foot stands where it is, if it
  // touches the ground.
  void note(std::size_t leg, LegUse use, std::span<const Rigid> world);

  // Moves a lifted foot from its place in `world` a step towards this sole; the farther it is from there, the higher it
  // is. Returns true if it has arrived.
  bool land(std::size_t leg, const Rigid& world_from_sole, LandingStep step, std::span<Rigid> world,
            std::span<double> row);

  // Lifts a sole that would be in the ground onto it. Returns false if it is not in the ground.
  bool put_on_ground(std::size_t leg, Rigid& sole) const;

  // Returns true if the foot must stay in place although the part that carries its leg may move, as of the frame
  // before.
  bool is_planted(std::size_t leg) const;
  std::span<const Leg> legs() const { return legs_; }

  // Puts the foot where it stood, as nearly as the joints' ranges allow. Writes the coordinates of leg and foot, and
  // their transforms in `world`, which must hold the leg and its carrier. Returns false if the foot is there already.
  bool plant(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // Puts a foot that stands, or is low over the ground, to its place in the frame before, as plant() does.
  void stay(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // Returns true if an action moved the foot in the previous frame, or if it returned from one.
  bool moves(std::size_t leg) const { return use_[leg] == LegUse::acts || use_[leg] == LegUse::lands; }

  // The distance of the foot from its last resting place, m. It must have rested.
  double off_m(std::size_t leg, std::span<const Rigid> world) const;

  // Puts the foot there as near as its leg reaches, and returns its distance from the place, m.
  double missed_m(std::size_t leg, const Rigid& sole, std::span<Rigid> world, std::span<double> row) const;

  // Returns the last place where the foot stood while no action moved its leg; nullopt if it was in the air then.
  const std::optional<Rigid>& rests_at(std::size_t leg) const { return rests_[leg]; }

  // Like plant(), at the place where the foot rested.
  void put_to_rest(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // Lifts the foot by the missing height, so that it does not slide over the ground. Returns false if no height is
  // missing.
  bool lift(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // The spare height of the foot, m: a foot that moves away must be the higher, the farther it is from where it stood.
  // Infinite for a foot that does not stand.
  double room_m(std::size_t leg, std::span<const Rigid> world) const;

 private:
  bool put_back(std::size_t leg, const Rigid& stood, std::span<Rigid> world, std::span<double> row) const;
  void put(std::size_t leg, const Rigid& sole, std::span<Rigid> world, std::span<double> row) const;
  double height_m(std::size_t leg, const Rigid& sole) const;
  double spare_m(std::size_t leg, const Rigid& sole) const;

  const Character* character_ = nullptr;
  std::span<const Leg> legs_;
  const Environment* environment_ = nullptr;
  std::array<std::optional<Rigid>, kMaxLegs> stood_;
  std::array<std::optional<Rigid>, kMaxLegs> rests_;
  std::array<Rigid, kMaxLegs> seen_{};     // places in the frame before
  std::array<bool, kMaxLegs> was_seen_{};  // an action that begins in the first frame has moved nothing in it
  std::array<LegUse, kMaxLegs> use_{};
};

}  // namespace contort
