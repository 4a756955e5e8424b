// The room that the bodies of a limb have: how near they are to other bodies and to each other. Actions choose between
// postures by it.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "generator/motion/standing_feet.h"
#include "model/character/character.h"
#include "model/geometry/distance.h"

namespace contort {

// Parts that move as one: a chain of parts, each carried by the one before it, up to where the figure branches.
struct Limb {
  std::vector<int> parts;    // carriers first
  std::vector<int> joints;   // of these parts
  std::vector<int> carried;  // joints of the parts that it carries
  std::vector<int> legs;     // that it is or carries: indices of find_legs()

  bool is_its_own(const Leg& leg) const { return std::ranges::find(parts, leg.part) != parts.end(); }
};

// Every part but the root part is in one limb. Limbs are in the order of their first parts.
std::vector<Limb> limbs_of(const Character& character, std::span<const Leg> legs);

// A limb that lacks this much room still counts as clear: at rest many pairs have exactly the gap that they must have.
inline constexpr double kTooNear_m = 1e-4;
inline constexpr double kRoomBand_m = 0.08;  // more room than this is not measured

// The room that a caller tells apart: more than `high_m` is told as that, and less than `low_m` as anything less. The
// narrower, the sooner an answer is found.
struct RoomRange {
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = kRoomBand_m;  // <= kRoomBand_m
  double gap_m = 1.0;  // that bodies of the figure must have, or as much as at rest; never more than is comfortable
};

// The hand, by the joint that it and all beyond it hang on, and the body of the object; -1: nothing is held.
struct HeldObject {
  int joint = -1;
  int body = -1;
  bool operator==(const HeldObject&) const = default;
};

class LimbRoom {
 public:
  // Measures the figure at rest: bodies may be as near as they are there. Everything that is given must outlive this
  // object. Measures nothing if the character is the same as before.
  void begin(const Character& character, const Environment& environment, const StandingFeet& feet);

  const StandingFeet& feet() const { return *feet_; }
  std::span<const Limb> limbs() const { return limbs_; }
  const Limb& limb_of(std::size_t part) const { return limbs_[static_cast<std::size_t>(limb_of_[part])]; }

  // The transforms of all joints before a frame moves any but the root. Limbs of the same kind see each other there, or
  // the left arm would choose otherwise than the right one, which is placed after it.
  void begin_frame(std::span<const Rigid> world) { before_.assign(world.begin(), world.end()); }

  // The limb of this part holds an object with a hand, whose bodies may touch it. Until it is said otherwise.
  void hold(std::size_t part, const HeldObject& held) { held_[static_cast<std::size_t>(limb_of_[part])] = held; }

  // Whether a hand is within 2 mm of an object, or in it.
  bool is_at(const HeldObject& held, std::size_t part, std::span<const Rigid> world);

  // The least distance of the bodies of this part's limb, and of what it carries, from others, from each other and from
  // the ground and obstacles, beyond what they must have, and of what its feet have to spare, m; negative where they are
  // too near. `world` holds the transforms of all joints; of parts that have not moved yet in this frame those of the
  // frame before. Not for the root part.
  double room_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range = {});
  // The same between bodies of the figure alone, without the ground, obstacles and feet.
  double apart_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range = {});

  // Whether room_m() is no less than this, at most 0.08 m, with such a gap between bodies of the figure.
  bool has_room(std::size_t part, std::span<const Rigid> world, double least_m = -kTooNear_m, double gap_m = 1.0) {
    return room_m(part, world, {least_m, least_m, gap_m}) >= least_m;
  }

  // The same where all joints are as in `world`, with a hand that holds an object; without the ground and feet.
  double room_beside_m(std::size_t part, const HeldObject& held, std::span<const Rigid> world);

  // The least distance of the bodies on a joint from a plane, on the side of its normal, m.
  double over_plane_m(int joint, const Vec3& point_m, const Vec3& normal, std::span<const Rigid> world) const;

  // Whether bodies of this part's limb are within a millimetre of others, or deeper, where all joints are as in `world`.
  // Arms that swing with a gait get out of the way, and do not count.
  bool touches(std::size_t part, std::span<const Rigid> world);

 private:
  bool is_moved_by(int limb, int other) const;
  std::size_t part_of(int body) const;
  bool is_object(int body) const;
  bool is_of(const HeldObject& held, int body, int object) const;
  bool holds(int body, int object) const;
  bool is_leg(int limb) const;
  bool has_grip(int limb) const;
  bool swings(int limb) const;
  int first_of_kind(int limb) const;
  void begin_bodies();
  void begin_pairs();
  void begin_ground();
  void begin_look(int limb, std::span<const Rigid> world);
  const Rigid& where(int body) const;
  void place_solids(int body);
  double distance_m(int pair, double band_m);
  double band_below(double room_m, int pair) const;
  double collider_distance_m(const JudgedPair& pair, double band_m);
  double off_obstacles_m(int body, const Rigid& world_from_body, double band_m) const;
  double over_ground_m(int body, const Rigid& world_from_body, const Environment& environment, double band_m) const;

  const Character* character_ = nullptr;
  const Environment* environment_ = nullptr;
  const StandingFeet* feet_ = nullptr;
  std::uint64_t character_hash_ = 0;
  std::vector<Limb> limbs_;
  std::vector<int> limb_of_;              // by part; -1 of the root part
  std::vector<Rigid> before_;             // by joint
  std::vector<std::vector<int>> pairs_;   // by limb: judged pairs whose distance it changes
  std::vector<char> swings_;              // by limb: it is an arm that swings with a gait
  std::vector<HeldObject> held_;          // by limb
  std::vector<double> safe_m_;            // by judged pair: the gap that it must have
  std::vector<std::vector<int>> bodies_;  // by limb: its own and those that it carries, but those of legs
  std::vector<double> safe_over_ground_m_;  // by body
  std::vector<std::vector<Vec3>> core_m_;  // by collider: the points that span its core, in its joint's frame
  std::vector<Solid> own_;                // colliders in their joints' frames
  std::vector<Solid> world_;              // placed
  std::vector<Vec3> ball_center_m_;       // by body: of a ball that holds it, in its joint's frame
  std::vector<double> ball_radius_m_;
  std::vector<int> limb_of_body_;  // by body; -1 of the root part's
  std::vector<int> kind_;          // by limb: the first limb whose part is of the same kind
  std::vector<Vec3> ways_;         // by judged collider: a direction along which they were apart, or 0
  // The present look at the figure, from a limb or from none (-1), and where it has placed the bodies.
  int looks_from_ = -1;
  std::span<const Rigid> seen_;
  std::vector<Rigid> placed_at_;
  std::vector<Vec3> ball_world_m_;
  std::vector<char> has_solids_;
};

}  // namespace contort
