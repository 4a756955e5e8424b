// Character: parts assembled into slots, with attached objects. Immutable once built; all indices are valid.
//
// Joint i's parent is smaller than i, so one forward loop visits parents first. Joint 0 is the root: it has no axis, it
// is placed by the motion's root transform. A pose is a flat row of coordinates, `coord_count()` doubles: a hinge has
// one (rad), a prismatic joint one (m), a ball joint four (unit quaternion w, x, y, z, rotation relative to the rest
// frame). In the rest pose all are 0, and balls (1, 0, 0, 0).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/character/action_desc.h"
#include "model/character/desc.h"
#include "model/character/library.h"
#include "model/character/polyhedron.h"
#include "model/core/result.h"

namespace contort {

enum class JointKind : std::uint8_t { root, hinge, ball, prismatic };

struct Joint {
  std::string name;        // "arm_left/elbow"; "root".
  std::string local_name;  // "elbow"
  std::string body_name;   // "forearm": the body that moves with it
  int part = 0;
  int parent = -1;  // < own index; -1 for the root.
  JointKind kind = JointKind::root;
  int coord = 0;            // First coordinate in a pose row (root: none).
  Rigid parent_from_joint;  // At rest.
  Vec3 axis{0, 1, 0};       // Unit, in the joint's frame: hinge and travel axis, or the ball's twist axis.

  double low = 0.0;  // rad (hinge, ball twist) or m (prismatic)
  double high = 0.0;
  Vec3 swing_axis{1, 0, 0};  // ball: unit, at a right angle to axis
  double swing_a_rad = 0.0;  // ball: half angle about swing_axis
  double swing_b_rad = 0.0;  // ball: half angle about axis x swing_axis
  Quat swing_center = kNoRotation;

  double max_speed = 0.0;  // rad/s or m/s
  double strength_low = 0.0;
  double strength_high = 0.0;

  // The mass of the body that moves with the joint, including everything that is fixed to it (parts without joints,
  // attached objects).
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};  // in the joint's frame
  Mat3 inertia_kg_m2{0.0};     // about the centre of mass, axes of the joint's frame
};

// Returns the number of coordinates of a joint: 1 for hinges and prismatic joints, 4 for balls, 0 for the root.
int coord_size(JointKind kind);

// Returns the number of components of a joint's rate: 6 for the root, 3 for balls, else 1.
int freedom_count(JointKind kind);

struct Collider {
  std::string name;                                // "arm_left/forearm", or "object:rifle/barrel"
  int joint = 0;                                   // The joint that moves it.
  ColliderShape shape;                             // In that joint's frame.
  std::shared_ptr<const Polyhedron> polyhedron{};  // The hull of a ConvexHull, in that joint's frame; null for others.
};

// Colliders that move and are judged as one: those of a part or an object on one joint.
struct Body {
  std::string name;  // "arm_left/forearm"; "waist" for a part's fixed body; "object:rifle"
  int joint = 0;
  int first_collider = 0;  // its colliders are [first_collider, first_collider + collider_count)
  int collider_count = 0;
};

struct MeshPiece {
  int joint = 0;
  MeshShape shape;
  Vec3 color;
};

struct Socket {
  std::string name;  // "arm_left/grip", or "object:rifle/muzzle"
  int joint = 0;
  Rigid joint_from_socket;
};

// Joints that dynamic control uses together (see ControlGroupDesc).
struct JointGroup {
  std::string name;
  std::vector<int> joints;
  double greatest = 0.0;  // rad/s^2, m/s^2
};

// A region that a point must stay in, or out of (see RegionDesc).
struct Region {
  std::string name;
  int joint = 0;
  Vec3 point_m{0.0};    // in the joint's frame
  ColliderShape shape;  // in the root's frame
  bool keep_out = false;
};

struct ReachChain {
  int upper = 0;       // The ball joint, or the first of three hinges (upper, upper+1, upper+2).
  int upper_last = 0;  // == upper for a ball.
  int middle = 0;
  int tip = 0;  // Index of a socket.
};

struct FacingChain {
  std::vector<int> joints;
  int socket = 0;
};

struct Part {
  std::string slot;  // "arm_left"
  std::string name;  // "mech_arm_slim"
  std::string kind;
  Side side = Side::center;
  int first_joint = 0;  // The part's joints are [first_joint, first_joint + joint_count).
  int joint_count = 0;
  int first_coord = 0;
  int coord_count = 0;
  std::vector<ReachChain> reach;
  std::vector<FacingChain> facing;
};

// Two colliders that may touch, and the reason.
struct AllowedPair {
  int a = 0;  // collider indices, a < b
  int b = 0;
  std::string reason;  // "same_body", "adjacent", or "user: …" from the character's file
};

struct ColliderPair {
  int a = 0;  // collider indices, a < b
  int b = 0;
  bool operator==(const ColliderPair&) const = default;
};

// Two bodies that must not touch: the pairs of their colliders that are not allowed.
struct JudgedPair {
  int body_a = 0;  // body indices, body_a < body_b
  int body_b = 0;
  int first_pair = 0;  // entries [first_pair, first_pair + pair_count) of judged_colliders()
  int pair_count = 0;
};

class Character {
 public:
  const std::string& name() const { return name_; }
  std::span<const Joint> joints() const { return joints_; }
  const Joint& joint(int index) const { return joints_[static_cast<std::size_t>(index)]; }
  std::span<const Part> parts() const { return parts_; }
  std::span<const Collider> colliders() const { return colliders_; }
  std::span<const MeshPiece> mesh() const { return mesh_; }
  std::span<const Socket> sockets() const { return sockets_; }
  std::span<const Body> bodies() const { return bodies_; }

  // Every pair of colliders is either allowed or judged.
  std::span<const AllowedPair> allowed_pairs() const { return allowed_pairs_; }
  std::span<const ColliderPair> judged_colliders() const { return judged_colliders_; }
  std::span<const JudgedPair> judged_pairs() const { return judged_pairs_; }
  int coord_count() const { return coord_count_; }
  std::span<const double> rest_coords() const { return rest_coords_; }

  // World transform of the root at rest: upright at the origin, with the lowest collider point at height 0.
  const Rigid& rest_root() const { return rest_root_; }

  // The actions from files that apply to one of the parts, in the library's order.
  std::span<const ActionDesc> actions() const { return actions_; }

  // The control groups that its description declares. If empty, dynamics finds groups from the parts.
  std::span<const JointGroup> control_groups() const { return control_groups_; }

  std::span<const Region> regions() const { return regions_; }
  // The horizontal push that the figure must withstand according to its file.
  const std::optional<double>& declared_withstands_N_s() const { return withstands_N_s_; }

  // A hash over all data that can change a motion or a finding. Cases store it.
  std::uint64_t hash() const { return hash_; }

  int find_part(std::string_view slot) const;  // -1 if there is none, here and in the next functions
  int find_joint(std::string_view name) const;
  int find_joint(int part, std::string_view local_name) const;
  int find_socket(std::string_view name) const;
  int find_collider(std::string_view name) const;

 private:
  friend class CharacterBuilder;
  std::string name_;
  std::vector<Joint> joints_;
  std::vector<Part> parts_;
  std::vector<Collider> colliders_;
  std::vector<MeshPiece> mesh_;
  std::vector<Socket> sockets_;
  std::vector<AllowedPair> allowed_pairs_;
  std::vector<Body> bodies_;
  std::vector<ColliderPair> judged_colliders_;
  std::vector<JudgedPair> judged_pairs_;
  std::vector<double> rest_coords_;
  std::vector<ActionDesc> actions_;
  std::vector<JointGroup> control_groups_;
  std::vector<Region> regions_;
  std::optional<double> withstands_N_s_;
  int coord_count_ = 0;
  Rigid rest_root_;
  std::uint64_t hash_ = 0;
};

// Returns the part that carries this one; the root part for itself.
int carrier_of(const Character& character, int part);

// Returns true if an action's file names the part or its kind.
bool is_for(const ActionDesc& action, const Part& part);

// Assembles a character. Codes character.unknown_character, .unknown_slot, .unknown_part, .wrong_kind, .unknown_socket,
// .unknown_object, .unknown_point, .too_many_handles, .too_large, .duplicate_object, .duplicate_name, .no_slot,
// .no_part, .bad_root and those of check_part; pointers go into the CharacterChoice
// ("/parts/arm_left"), or, with the file's name in the text, into the description at fault.
Result<Character> build_character(const CharacterChoice& choice, const Library& library);

}  // namespace contort
