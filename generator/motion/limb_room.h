// The room that the bodies of a limb have: how near they are to other bodies and to each other. Actions choose between
// postures by it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/geometry/distance.h"

namespace contort {

// Parts that move as one: a chain of parts, each carried by the one before it, up to where the figure branches.
struct Limb {
  std::vector<int> parts;   // carriers first
  std::vector<int> joints;  // of these parts
};

// Every part but the root part is in one limb. Limbs are in the order of their first parts.
std::vector<Limb> limbs_of(const Character& character);

class LimbRoom {
 public:
  // Measures the figure at rest: bodies may be as near as they are there. The character must outlive this object. Does
  // nothing if the character is the same as before.
  void begin(const Character& character);

  const Limb& limb_of(std::size_t part) const { return limbs_[static_cast<std::size_t>(limb_of_[part])]; }

  // In a frame, parts are placed one after another. Those that are not yet are no obstacle: they will make way. Nor are
  // limbs of the same kind, or the left arm would choose otherwise than the right one, which is placed after it.
  void begin_frame() { placed_.assign(limb_of_.size(), 0); }
  void set_placed(std::size_t part) { placed_[part] = 1; }

  // The least distance of the bodies of this part's limb from placed parts and from each other, beyond what they may
  // have, m; negative where they are too near, and at most 0.08. `world` holds the transforms of the limb's joints and
  // of those of placed parts. Not for the root part.
  double room_m(std::size_t part, std::span<const Rigid> world);

 private:
  bool is_judged(int pair, int limb) const;
  std::size_t part_of(int body) const;
  const std::string& kind_of(int limb) const;
  void begin_bodies();
  void begin_pairs();
  void place_body(int body, std::span<const Rigid> world);
  double distance_m(int pair, std::span<const Rigid> world, double band_m);
  double collider_distance_m(const JudgedPair& pair, double band_m) const;

  const Character* character_ = nullptr;
  std::uint64_t character_hash_ = 0;
  std::vector<Limb> limbs_;
  std::vector<int> limb_of_;              // by part; -1 of the root part
  std::vector<char> placed_;              // by part
  std::vector<std::vector<int>> pairs_;   // by limb: judged pairs with a body in it
  std::vector<double> safe_m_;            // by judged pair: the gap that it must have
  std::vector<Solid> own_;                // colliders in their joints' frames
  std::vector<Solid> world_;              // placed
  std::vector<Vec3> ball_center_m_;       // by body: of a ball that holds it, in its joint's frame
  std::vector<double> ball_radius_m_;
};

}  // namespace contort
