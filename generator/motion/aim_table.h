// Aim information: postures of a chain by the direction in which they point its socket. Built by stepping the joints
// through their ranges (aim_states.h), once per geometry; immutable, so that threads may share it.
// docs/internals/aim.md.
//
// Directions are binned into the 1,944 cells, about 5 degrees wide, of a cube map. Each cell keeps at most per_cell
// postures that differ from one another, of those with some room to their joint limits: two thirds of them the ones
// nearest to rest, the others those that are sighted, with the line of aim near the chain's first joint (a gun at the
// shoulder). A table therefore holds at most 1,944 * per_cell postures of coord_count + 6 doubles: 1.3 MB for an arm of
// 8 coordinates with 6 postures per cell.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/motion/aim_states.h"

namespace contort {

inline constexpr int kAimCellsPerEdge = 18;  // 90 degrees / 5
inline constexpr int kAimCells = 6 * kAimCellsPerEdge * kAimCellsPerEdge;

// Cell of a unit direction, in [0, kAimCells). Cells of one face are equally wide in angle along both edges.
int aim_cell(const Vec3& direction);

struct AimHit {
  int posture = 0;
  double chord = 0.0;  // Squared distance of the unit vectors, 2 - 2 cos(angle).
};

class AimTable {
 public:
  // Builds the table. The same geometry and options give the same table on every machine.
  static AimTable build(const AimGeometry& geometry, const AimTableOptions& options = {});

  // A table of these postures (geometry.coord_count doubles each), in any order. Used by the file's reader.
  static AimTable of_postures(AimGeometry geometry, const AimTableOptions& options, std::span<const double> coords);

  // Returns a hash of geometry and options, under which files are stored.
  static std::uint64_t key_of(const AimGeometry& geometry, const AimTableOptions& options);
  std::uint64_t key() const { return key_of(geometry_, options_); }

  const AimGeometry& geometry() const { return geometry_; }
  const AimTableOptions& options() const { return options_; }
  int posture_count() const { return static_cast<int>(directions_.size()); }  // >= 1

  // Postures are in the frame of the chain's base. Travels of the posture are those nearest to rest.
  std::span<const double> coords(int posture) const;
  const Vec3& direction(int posture) const { return directions_[static_cast<std::size_t>(posture)]; }
  const Vec3& point_m(int posture) const { return points_m_[static_cast<std::size_t>(posture)]; }

  // The postures whose directions are nearest to a unit direction (base frame), best first; of equals the one with the
  // lower number. Fills `hits` as far as there are postures, and returns their number. Never allocates.
  int nearest(const Vec3& direction, std::span<AimHit> hits) const;

  // The nearest postures for a target point in the base's frame: the chord is between a posture's direction and the way
  // from its own point to the target. Looks at every posture. It is for near targets, for which the direction depends
  // on the place of the aim point.
  int nearest_to_point(const Vec3& target_m, std::span<AimHit> hits) const;

  // Puts those hits first whose postures are nearest to a present one (coords of the chain) in their worst joint.
  void prefer(std::span<const double> present, std::span<AimHit> hits) const;

  // Sorts the hits in the same way, but a posture counts as farther by 4 rad for each metre that its line of aim passes
  // beside the chain's first joint: people aim along their arms, and with a gun at the shoulder.
  void prefer_sighted(std::span<const double> present, std::span<AimHit> hits) const;

  // A posture between several near ones: hinges by weighted mean, balls by normalised quaternion sum, over those that
  // are within 45 degrees of the first one in every joint. Writes coords of the chain, within ranges; where the mean
  // does not point nearer to the direction than the first one, that one. Never allocates.
  void interpolated(const Vec3& direction, std::span<const AimHit> hits, std::span<double> coords) const;

  // Interpolates between the eight nearest postures.
  void interpolated(const Vec3& direction, std::span<double> coords) const;

 private:
  struct Search;
  void arrange();
  double beside_m(int posture) const;
  void search(Search& search, int begin, int end, int axis) const;

  AimGeometry geometry_;
  AimTableOptions options_;
  // Arranged as a k-d tree without pointers: the middle of a range [begin, end) divides it along x, y, z in turn.
  std::vector<Vec3> directions_;
  std::vector<Vec3> points_m_;
  std::vector<double> coords_;
};

// The greatest difference of one joint between two postures: of a hinge's angle, or the angle between a ball's
// rotations. Travels do not count.
double posture_difference_rad(const AimGeometry& geometry, std::span<const double> a, std::span<const double> b);

}  // namespace contort
