// Descriptions: plain values that files, the fuzzer and part swaps edit freely. build_character (character.h) checks
// them once and makes the immutable Character that everything else trusts. Their JSON form, its limits and its schema
// come from the field lists in desc_json.cpp. Authored angles are degrees, with `_deg` in the name.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "model/character/shape.h"

namespace contort {

enum class JointType { hinge, ball, prismatic };

// One joint of a part and the body that it moves. Parts are authored for the left side (+X) or the middle; a slot on
// the right mirrors them.
struct JointDesc {
  std::string name;    // Unique in the part. The same role has the same name in every part: "shoulder", "elbow".
  std::string parent;  // An earlier joint of the part, or "" for the place where the part is attached.
  std::string body;    // Name of the body that moves with it, "forearm"; "" is the joint's own name.
  JointType type = JointType::hinge;
  Vec3 position_m{0.0};    // In the parent joint's frame, at rest.
  Vec3 rotation_deg{0.0};  // Rest rotation relative to the parent joint's frame, as a rotation vector.

  // hinge, prismatic: unit axis in the joint's own frame. ball: the twist axis, along the bone.
  Vec3 axis{0.0, 1.0, 0.0};

  // hinge: degrees about `axis`, rest pose = 0. ball: twist about `axis`. In [-360, 360], low <= high.
  double low_deg = -90.0;
  double high_deg = 90.0;
  // prismatic: travel along `axis`, rest pose = 0.
  double low_m = 0.0;
  double high_m = 0.0;
  // ball: the swing cone. The limit frame is the rest frame turned by swing_center_deg (a rotation vector); seen from
  // it, `axis` may swing by at most swing_deg[0] about swing_axis and swing_deg[1] about axis x swing_axis (an ellipse
  // of rotation angles between them), each in (0, 180]. Twist is measured in the limit frame too.
  Vec3 swing_axis{1.0, 0.0, 0.0};  // Unit, at a right angle to `axis`.
  std::array<double, 2> swing_deg{90.0, 90.0};
  Vec3 swing_center_deg{0.0};

  double max_speed_deg_s = 720.0;  // hinge, ball: > 0.
  double max_speed_m_s = 1.0;      // prismatic: > 0.
  double strength_low = -100.0;    // Greatest effort against the axis, N m (prismatic: N), <= 0.
  double strength_high = 100.0;    // Greatest effort along the axis, N m (prismatic: N), >= 0.

  // The body that moves with the joint. 0 kg is a massless link between two axes of one anatomical joint.
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};
  Vec3 inertia_kg_m2{0.0};  // Principal moments about the centre of mass, axes parallel to the joint frame.

  bool operator==(const JointDesc&) const = default;
};

struct ColliderDesc {
  std::string name;   // Unique in the part.
  std::string joint;  // The joint whose body carries it; "" for the part's fixed body (see PartDesc).
  ColliderShape shape;
  bool operator==(const ColliderDesc&) const = default;
};

struct MeshDesc {
  std::string joint;
  MeshShape shape;
  Vec3 color{0.7};  // Linear RGB, each in [0, 1].
  bool operator==(const MeshDesc&) const = default;
};

// A named frame on a part. Other parts and attached objects are attached to it, and actions use it as a point with a
// direction (+Z).
struct SocketDesc {
  std::string name;
  std::string joint;
  Vec3 position_m{0.0};
  Vec3 rotation_deg{0.0};  // Rotation vector.
  bool operator==(const SocketDesc&) const = default;
};

// Two bones that can reach for a point: `upper` starts at a ball joint, or at three hinges with axes at right angles
// (named by the first), `middle` is a hinge, `tip` a socket that moves with the middle joint or below it.
struct ReachDesc {
  std::string upper;
  std::string middle;
  std::string tip;
  bool operator==(const ReachDesc&) const = default;
};

// Joints that turn a socket's +Z to face a direction, listed from the body outward.
struct FacingDesc {
  std::vector<std::string> joints;
  std::string socket;
  bool operator==(const FacingDesc&) const = default;
};

struct PartDesc {
  std::string name;
  std::string kind;  // Slots take parts of one kind: "arm".
  std::string help;
  std::vector<JointDesc> joints;
  std::vector<ColliderDesc> colliders;
  std::vector<MeshDesc> mesh;  // Empty: the colliders are drawn.
  std::vector<SocketDesc> sockets;
  std::vector<ReachDesc> reach;    // At most one.
  std::vector<FacingDesc> facing;  // At most one.
  // The part's fixed body: everything that is rigidly fixed to the place where the part is attached, above its first
  // joint. For the root part it is the root body itself. A part without joints (a backpack) has no other body. Its
  // frame is that of the socket.
  double fixed_mass_kg = 0.0;
  Vec3 fixed_center_of_mass_m{0.0};
  Vec3 fixed_inertia_kg_m2{0.0};
  Vec3 color{0.7};  // The colour of colliders drawn as mesh.
  bool operator==(const PartDesc&) const = default;
};

enum class Side { center, left, right };

struct SlotDesc {
  std::string name;  // "arm_left"
  std::string kind;  // Kind of part that fits.
  Side side = Side::center;
  std::string on_slot;             // The slot whose part carries this one; "" for the first slot, which is the root.
  std::string on_socket;           // A socket of that part.
  std::vector<std::string> parts;  // Names of the parts that the slot may hold; the first is the default.
  bool operator==(const SlotDesc&) const = default;
};

// An object that follows a socket: a rifle, a backpack. Its frame is the socket's frame.
struct ObjectDesc {
  std::string name;
  std::string help;
  double mass_kg = 0.0;
  Vec3 center_of_mass_m{0.0};
  Vec3 inertia_kg_m2{0.0};
  std::vector<ColliderDesc> colliders;  // `joint` stays "".
  std::vector<MeshDesc> mesh;
  std::vector<SocketDesc> points;  // Named points with a direction (+Z): "muzzle".
  std::vector<std::string>
      docks;  // Names of the sockets that it is made for: "grip". It may be fixed to any other too.
  Vec3 color{0.4};
  bool operator==(const ObjectDesc&) const = default;
};

struct AllowedPairDesc {  // Colliders that may touch: "slot/collider", or "object:name/collider".
  std::string a;
  std::string b;
  std::string reason;  // For people; never empty.
  bool operator==(const AllowedPairDesc&) const = default;
};

// Joints that dynamic control uses together (docs/internals/dynamics.md). "root" means the position of the hips and
// their pitch.
struct ControlGroupDesc {
  std::string name;                 // "arms"
  std::vector<std::string> joints;  // "arm_left/shoulder"; a ball counts as two, the root as four, eight at most
  double greatest = 4.0;            // acceleration that control may add, rad/s^2 (root and travels: also m/s^2), > 0
  bool operator==(const ControlGroupDesc&) const = default;
};

// A space that a point of the figure must stay in, or out of: hands in front of the chest, a muzzle out of the head.
// The shape moves with the root: its frame is the character's, on the ground under the root at rest, +Z forward.
struct RegionDesc {
  std::string name;   // Unique in the character.
  std::string point;  // "arm_left/grip": a socket, or else a joint, of a slot
  ColliderShape shape;
  bool keep_out = false;  // The point must stay outside.
  bool operator==(const RegionDesc&) const = default;
};

struct CharacterDesc {
  std::string name;
  std::string help;
  std::vector<SlotDesc> slots;  // The carrying slot comes first.
  std::vector<AllowedPairDesc> allowed_pairs;
  std::vector<std::string> objects;  // Objects that may be attached.
  std::vector<ControlGroupDesc> control_groups;  // In the order of control; if empty, dynamics finds them from the
                                                 // parts.
  std::vector<RegionDesc> regions;
  std::optional<double> withstands_N_s{};  // the horizontal push that it must withstand; if empty, it follows from
                                           // mass, height and soles
  bool operator==(const CharacterDesc&) const = default;
};

// A Spec names its character, and lists what differs from the character's defaults.
struct AttachmentDesc {
  std::string object;
  std::string slot;
  std::string socket;
  bool operator==(const AttachmentDesc&) const = default;
};

struct CharacterChoice {
  std::string name = "human";
  std::map<std::string, std::string> parts;  // slot -> part, for slots that do not hold the default
  std::vector<AttachmentDesc> attachments;
  bool operator==(const CharacterChoice&) const = default;
};

}  // namespace contort
