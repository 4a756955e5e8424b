// The steps of build_character. Each is a plain function that extends the character under construction.
#pragma once

#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/character/inertia.h"

namespace contort {

// The limits of a whole character. All pairs of colliders are examined: at most 523,776.
inline constexpr std::size_t kMaxCharacterJoints = 1024;
inline constexpr std::size_t kMaxCharacterColliders = 1024;

// The place at which a part is attached: a frame on a joint of the assembly.
struct Dock {
  int joint = 0;
  Rigid joint_from_dock;
};

// A character under construction.
struct Assembly {
  std::vector<Joint> joints;
  std::vector<Part> parts;
  std::vector<Collider> colliders;
  std::vector<MeshPiece> mesh;
  std::vector<Socket> sockets;
  int coord_count = 0;
};

// Adds the part's joints, colliders, mesh and sockets; mirrored when the slot is on the right.
void add_part(Assembly& assembly, const SlotDesc& slot, const PartDesc& part, const Dock& dock);

// Adds an attached object, fixed to a dock.
void add_object(Assembly& assembly, const ObjectDesc& object, const Dock& dock);

// The bodies that the colliders of an assembly form, and the judged pairs of them.
struct CollisionPlan {
  std::vector<Body> bodies;
  std::vector<AllowedPair> allowed;
  std::vector<ColliderPair> colliders;
  std::vector<JudgedPair> judged;
};

// Groups the colliders of a finished assembly by body (this reorders them).
std::vector<Body> group_colliders(Assembly& assembly);

// Splits all pairs of colliders into allowed (same body, neighbouring bodies, the user's list) and judged.
CollisionPlan plan_collisions(const Assembly& assembly, std::vector<Body> bodies,
                              const std::vector<AllowedPair>& by_user);

// Returns a hash over all data that can change a motion or a finding.
std::uint64_t hash_of(const Character& character);

// Returns the index of a socket; -1 if there is none.
int find_socket(const Assembly& assembly, const std::string& name);

}  // namespace contort
