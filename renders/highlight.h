// From the name of a finding's subject to the places on the body.
#pragma once

#include <vector>

#include "checks/fold.h"
#include "model/character/character.h"

namespace contort {

// The subject of a finding: solids, such as the two of a collision, each a set of colliders; or joints. Both are empty
// where the subject is the character as a whole.
struct Highlight {
  std::vector<std::vector<int>> solids;
  std::vector<int> joints;
  bool empty() const { return solids.empty() && joints.empty(); }
  bool operator==(const Highlight&) const = default;
};

// Understands "<solid> ~ <solid>" with names of bodies or colliders, and "<name>" or "<name> <words>" with that of a
// joint, body, collider, socket or slot ("arm_left/elbow max"). Where only the first of a pair is known, that one is
// highlighted; unknown names, such as those of parts that are no longer there, highlight nothing.
Highlight highlighted(const Character& character, const Finding& finding);

// Whether the piece is the collider's very shape, as in parts that have no mesh of their own.
bool looks_like(const MeshPiece& piece, const Collider& collider);

// Whether the piece belongs to an attached object (a rifle) and not to a part.
bool is_of_object(const Character& character, const MeshPiece& piece);

// Group of each mesh piece: 0 where it is not highlighted, n for the n-th solid, and for the joints, all together, one
// more than there are solids. A mesh piece belongs to the nearest collider that moves with the same joint; of a
// joint without mesh (one axis of several in one place) the pieces of the joints below it stand in.
std::vector<int> highlight_groups(const Character& character, const Highlight& highlight);

// The same by joint, for a skin: `moved` says which joints have a piece of it. Objects are not of it.
std::vector<int> highlight_groups_of_joints(const Character& character, const Highlight& highlight,
                                            const std::vector<bool>& moved);

}  // namespace contort
