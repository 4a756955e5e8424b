// The joints that point something: from a part's first joint out to the socket whose +Z is aimed, which may be the
// part's own ("hand_right/grip") or an attached object's ("object:rifle/muzzle").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/character/character.h"

namespace contort {

inline constexpr int kMaxAimJoints = 16;
inline constexpr int kMaxAimCoords = 4 * kMaxAimJoints;

struct AimChain {
  std::vector<int> joints;  // From the body outward, each below the one before it; at most kMaxAimJoints.
  int socket = 0;           // A socket of the character. Its +Z is the aim direction, its origin the aim point.
  bool operator==(const AimChain&) const = default;
};

// Returns the joints that carry the socket, of the part and of the parts that it carries. Returns no joints if the part
// does not carry the socket. Of more than kMaxAimJoints joints the outermost ones are kept.
AimChain aim_chain_for(const Character& character, int part, int socket);

// Returns the chain with which a torso or head faces a direction, cut to the same length.
AimChain aim_chain_for(const FacingChain& chain);

// A chain without its character: everything on which an aim table depends. Two arms with equal geometry share a table.
struct AimGeometry {
  // Without names and character-wide indices. parent_from_joint is given in the joint before it in the chain (the
  // first: in the chain's base, the parent of its first joint), joints in between at rest; coord counts from the
  // chain's first coordinate.
  std::vector<Joint> joints;
  Rigid last_from_socket;
  int coord_count = 0;
};

// Asserts that the chain has 1 to kMaxAimJoints joints.
AimGeometry aim_geometry(const Character& character, const AimChain& chain);

// Returns a hash of all members, bit by bit.
std::uint64_t geometry_hash(const AimGeometry& geometry);

// Returns base_from_socket at the chain's coordinates.
Rigid base_from_socket(const AimGeometry& geometry, std::span<const double> coords);

}  // namespace contort
