// Finds the parts of the body to which the name of a finding's subject refers.
#pragma once

#include <vector>

#include "checks/fold.h"
#include "model/character/character.h"

namespace contort {

// The subject of a finding: solids, such as the two of a collision, each a set of colliders; or joints. Both are
// empty if the subject is the whole character.
struct Highlight {
  std::vector<std::vector<int>> solids;
  std::vector<int> joints;
  bool empty() const { return solids.empty() && joints.empty(); }
  bool operator==(const Highlight&) const = default;
};

// Understands "<solid> ~ <solid>" with names of bodies or colliders, and "<name>" or "<name> <words>" with the name
// of a joint, body, collider, socket or slot ("arm_left/elbow max"). If only the first of a pair is known, only that
// one is highlighted. Unknown names, such as those of removed parts, highlight nothing.
Highlight highlighted(const Character& character, const Finding& finding);

// Returns true if the piece has exactly the collider's shape, as in parts without a mesh of their own.
bool looks_like(const MeshPiece& piece, const Collider& collider);

// Returns true if the piece belongs to an attached object (a rifle) and not to a part.
bool is_of_object(const Character& character, const MeshPiece& piece);

// Returns the group of each mesh piece: 0 if it is not highlighted, n for the n-th solid, and for all joints together
// one more than there are solids. A mesh piece belongs to the nearest collider that moves with the same joint. A
// joint without a mesh (one axis of several at one place) is represented by the pieces of the joints below it.
std::vector<int> highlight_groups(const Character& character, const Highlight& highlight);

// Returns the groups by joint, for a skin. `moved` is true for the joints that have a piece of it. Objects are not part
// of the skin.
std::vector<int> highlight_groups_of_joints(const Character& character, const Highlight& highlight,
                                            const std::vector<bool>& moved);

}  // namespace contort
