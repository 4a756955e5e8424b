// The room of a limb: the distances of its bodies to other bodies and to each other. Actions choose between postures by
// it.
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

// A limb: a chain of parts, each carried by the one before it, up to the place at which the figure branches.
struct Limb {
  std::vector<int> parts;    // carriers first
  std::vector<int> joints;   // joints of these parts
  std::vector<int> carried;  // joints of the parts that it carries
  std::vector<int> legs;     // the legs that are in the limb or carried by it: indices of find_legs()

  bool is_its_own(const Leg& leg) const { return std::ranges::find(parts, leg.part) != parts.end(); }
};

// Every part but the root part is in one limb. Limbs are in the order of their first parts.
std::vector<Limb> limbs_of(const Character& character, std::span<const Leg> legs);

// A limb that lacks this much room still counts as clear: at rest many pairs have exactly the gap that they must have.
inline constexpr double kTooNear_m = 1e-4;
inline constexpr double kRoomBand_m = 0.08;  // more room than this is not measured

// The interval in which a caller needs the exact room: more room is reported as `high_m`, and less than `low_m` as any
// smaller value. A narrow interval makes the answer faster.
struct RoomRange {
  double low_m = -std::numeric_limits<double>::infinity();
  double high_m = kRoomBand_m;  // <= kRoomBand_m
  double gap_m = 1.0;  // gap that bodies of the figure must keep, or their gap at rest if that is smaller; never more
                       // than a comfortable gap
  double twins = 0.0;  // how far limbs of the same kind are on their way in this frame: 0 before it, 1 after it
};

// A hand, given by the joint that carries it and everything beyond, and the body of the object; -1: nothing is held.
struct HeldObject {
  int joint = -1;
  int body = -1;
  bool operator==(const HeldObject&) const = default;
};

class LimbRoom {
 public:
  // Measures the figure at rest: bodies may always be as near as they are at rest. All arguments must outlive this
  // object. Measures nothing if the character is the same as before.
  void begin(const Character& character, const Environment& environment, const StandingFeet& feet);

  const StandingFeet& feet() const { return *feet_; }
  std::span<const Limb> limbs() const { return limbs_; }
  const Limb& limb_of(std::size_t part) const { return limbs_[static_cast<std::size_t>(limb_of_[part])]; }

  // The transforms of all joints before a frame moves any joint but the root. Limbs of the same kind are measured
  // against these; otherwise the left arm would choose differently from the right one, which is placed after it.
  void begin_frame(std::span<const Rigid> world) { before_.assign(world.begin(), world.end()); }

  // Sets the object that the limb of this part holds with a hand, whose bodies may touch it. It stays set until the
  // next call.
  void hold(std::size_t part, const HeldObject& held) { held_[static_cast<std::size_t>(limb_of_[part])] = held; }

  // Returns true if a hand is within 2 mm of an object, or in it.
  bool is_at(const HeldObject& held, std::size_t part, std::span<const Rigid> world);

  // The least distance of the bodies of this part's limb, and of the parts that it carries, from others, from each
  // other and from the ground and obstacles, beyond the gaps that they must have, and of the spare height of its feet,
  // m; negative if they are too near. `world` holds the transforms of all joints; for parts that have not moved yet in
  // this frame, those of the previous frame. Not for the root part.
  double room_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range = {});
  // Returns the same as room_m(), but only between bodies of the figure, without the ground, obstacles and feet.
  double apart_m(std::size_t part, std::span<const Rigid> world, const RoomRange& range = {});

  // Returns true if room_m() is at least this, up to 0.08 m, with this gap between bodies of the figure.
  bool has_room(std::size_t part, std::span<const Rigid> world, double least_m = -kTooNear_m, double gap_m = 1.0,
                double twins = 0.0) {
    return room_m(part, world, {least_m, least_m, gap_m, twins}) >= least_m;
  }

  // The longest way, m, that the centre of any body of another limb of the same kind has already gone in this frame.
  double twins_way_m(std::size_t part, std::span<const Rigid> world) const;

  // Returns the same as room_m(), with joints as in `world` and a hand that holds an object; without ground and feet.
  double room_beside_m(std::size_t part, const HeldObject& held, std::span<const Rigid> world);

  // The least distance of the bodies on a joint from a plane, on the side of its normal, m.
  double over_plane_m(int joint, const Vec3& point_m, const Vec3& normal, std::span<const Rigid> world) const;

  // Returns true if bodies of this part's limb are within a millimetre of others, or overlap them, with all joints as
  // in `world`. Arms that swing with a gait do not count, because they get out of the way.
  bool touches(std::size_t part, std::span<const Rigid> world);

 private:
  // Two bodies whose distance a limb changes.
  struct Pair {
    JudgedPair bodies;
    double radii_m = 0.0;  // sum of the radii of their bounding balls
    double safe_m = 0.0;   // the gap that they must have

    double band_below(double room_m) const;
  };

  bool is_moved_by(int limb, int other) const;
  std::size_t part_of(int body) const;
  bool is_object(int body) const;
  bool is_of(const HeldObject& held, int body, int object) const;
  bool is_of(const HeldObject& held, const Pair& pair) const;
  bool holds(int body, int object) const;
  bool is_leg(int limb) const;
  bool has_grip(int limb) const;
  bool swings(int limb) const;
  int first_of_kind(int limb) const;
  void begin_bodies();
  void begin_pairs();
  void begin_ground();
  bool is_twin(int limb, int other) const;
  void begin_look(int limb, std::span<const Rigid> world, double twins = 0.0);
  void place_solids(int body);
  bool are_near(const Pair& pair, double band_m) const;
  bool is_held(const Pair& pair) const;
  double distance_m(const Pair& pair, double band_m);
  double collider_distance_m(const JudgedPair& pair, double band_m);
  double off_obstacles_m(int body, const Rigid& world_from_body, double band_m) const;
  double over_ground_m(int body, const Rigid& world_from_body, const Environment& environment, double band_m) const;

  const Character* character_ = nullptr;
  const Environment* environment_ = nullptr;
  const StandingFeet* feet_ = nullptr;
  std::uint64_t character_hash_ = 0;
  std::vector<Limb> limbs_;
  std::vector<int> limb_of_;              // by part; -1 for the root part
  std::vector<Rigid> before_;             // by joint
  std::vector<std::vector<Pair>> pairs_;  // by limb
  std::vector<char> swings_;              // by limb: true for an arm that swings with a gait
  std::vector<HeldObject> held_;          // by limb
  std::vector<std::vector<int>> bodies_;  // by limb: its own bodies and those that it carries, without those of legs
  std::vector<double> safe_over_ground_m_;  // by body
  std::vector<std::vector<Vec3>> core_m_;  // by collider: the points that span its core, in its joint's frame
  std::vector<Solid> own_;                // colliders in their joints' frames
  std::vector<Solid> world_;              // placed
  std::vector<Vec3> ball_center_m_;       // by body: centre of its bounding ball, in its joint's frame
  std::vector<double> ball_radius_m_;
  std::vector<int> limb_of_body_;  // by body; -1 for the root part's
  std::vector<int> kind_;          // by limb: the first limb whose part is of the same kind
  std::vector<Vec3> ways_;         // by judged collider: a direction along which they were separated, or 0
  // The places of the bodies in the present measurement.
  std::vector<Rigid> placed_at_;
  std::vector<Vec3> ball_world_m_;
  std::vector<char> has_solids_;
};

}  // namespace contort
