// Feet that stand: they stay where they are while a trunk moves their hips, and are lifted before an action of their own
// leg moves them over the ground.
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
  acts,    // it has another action, or is on its way back from one
  lands,   // no action moves it any more, but its foot is still lifted
};

// A step of a foot that lands.
struct LandingStep {
  double share = 0.0;  // of its way
  double lift = 1.0;   // the share of the height that it lacks over the ground, by which it is lifted
};

// Legs are named by their index in find_legs(). World coordinates.
class StandingFeet {
 public:
  // Everything that is given must outlive this object. No foot stands until it was seen.
  void begin(const Character& character, std::span<const Leg> legs, const Environment& environment);

  // Ends a frame. A foot that has an action of its own stands where it stood until it is well above the ground, and so
  // does an idle one on a leg that the root part does not carry. Any other foot stands where it is, if it touches the
  // ground.
  void note(std::size_t leg, LegUse use, std::span<const Rigid> world);

  // A lifted foot, which is where `world` has it, goes a step of its way to this sole, the higher the farther it is from
  // there. True if it has arrived.
  bool land(std::size_t leg, const Rigid& world_from_sole, LandingStep step, std::span<Rigid> world,
            std::span<double> row);

  // Lifts a sole that would be in the ground onto it. False if it is not.
  bool put_on_ground(std::size_t leg, Rigid& sole) const;

  // Returns true if the foot must stay in place although the part that carries its leg may move, as of the frame
  // before.
  bool is_planted(std::size_t leg) const;
  std::span<const Leg> legs() const { return legs_; }

  // Puts the foot where it stood, as nearly as the joints' ranges allow. Writes the coordinates of leg and foot, and
  // their transforms in `world`, which must hold what carries the leg, and the leg. False if it is there already.
  bool plant(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // Whether an action moved the foot in the frame before, or it was on its way back from one.
  bool moves(std::size_t leg) const { return use_[leg] == LegUse::acts || use_[leg] == LegUse::lands; }

  // The distance of the foot from where it rested, m. It must have rested.
  double off_m(std::size_t leg, std::span<const Rigid> world) const;

  // Puts the foot there as near as its leg reaches, and returns by how much it misses the place, m.
  double missed_m(std::size_t leg, const Rigid& sole, std::span<Rigid> world, std::span<double> row) const;

  // Returns the last place where the foot stood while no action moved its leg; nullopt if it was in the air then.
  const std::optional<Rigid>& rests_at(std::size_t leg) const { return rests_[leg]; }

  // As plant(), where the foot rested.
  void put_to_rest(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // Lifts the foot by the height that it lacks to move over the ground without sliding. False if it lacks none.
  bool lift(std::size_t leg, std::span<Rigid> world, std::span<double> row) const;

  // The height that the foot has to spare, m: a foot that goes elsewhere must be the higher the farther it is from where
  // it stood. Infinite for a foot that does not stand.
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
  std::array<bool, kMaxLegs> was_seen_{};  // an action that begins in the first frame has moved nothing in it
  std::array<LegUse, kMaxLegs> use_{};
};

}  // namespace contort
