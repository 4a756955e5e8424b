// The JSON form of the descriptions: field lists (limits, help), and the readers, writers and schemas made from them.
#include "model/character/library.h"
#include "model/character/param_fields.h"
#include "model/character/shape_fields.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Rule;
using json_fields::Text;

constexpr std::string_view kJointTypes[] = {"hinge", "ball", "prismatic"};
constexpr std::string_view kSides[] = {"center", "left", "right"};

constexpr std::string_view kEases[] = {"smooth", "linear", "step", "sine"};

const Rule kUnit{.low = -1, .high = 1};
const Rule kMass{.low = 0, .high = 1e5};
const Rule kInertia{.low = 0, .high = 1e6};
const Rule kColor{.low = 0, .high = 1};
const Rule kName{.required = true};
const Rule kHelp{.text = Text::prose};

}  // namespace

template <class V>
void fields(V& v, const JointDesc*) {
  v.field("name", &JointDesc::name, kName,
          "Name, unique in the part; joints of the same role have the same name in every part.");
  v.field("parent", &JointDesc::parent, {.may_be_empty = true},
          "An earlier joint of the part; empty: the docking frame.");
  v.field("body", &JointDesc::body, {.may_be_empty = true},
          "Name of the body that moves with the joint; empty: the name of the joint.");
  v.field("type", &JointDesc::type, {.names = kJointTypes}, "Kind of joint.");
  v.field("position_m", &JointDesc::position_m, kPoint, "Position at rest, in the parent's frame.");
  v.field("rotation_deg", &JointDesc::rotation_deg, kRotation,
          "Rotation at rest relative to the parent, as rotation vector.");
  v.field("axis", &JointDesc::axis, kUnit, "Unit axis: of the hinge, of the travel, or of a ball's twist.");
  v.field("low_deg", &JointDesc::low_deg, kRotation, "Lower end of the hinge's or the twist's range.");
  v.field("high_deg", &JointDesc::high_deg, kRotation, "Upper end.");
  v.field("low_m", &JointDesc::low_m, {.low = -10, .high = 10}, "Prismatic: lower end of the travel.");
  v.field("high_m", &JointDesc::high_m, {.low = -10, .high = 10}, "Prismatic: upper end.");
  v.field("swing_axis", &JointDesc::swing_axis, kUnit, "Ball: unit axis at a right angle to `axis`.");
  v.field("swing_deg", &JointDesc::swing_deg, {.low = 0.1, .high = 180},
          "Ball: half angles of the swing cone about swing_axis and about axis x swing_axis.");
  v.field("swing_center_deg", &JointDesc::swing_center_deg, kRotation,
          "Ball: rotation vector from the rest frame to the limit frame.");
  v.field("max_speed_deg_s", &JointDesc::max_speed_deg_s, {.low = 1, .high = 1e5},
          "Greatest angular speed; checked, never enforced.");
  v.field("max_speed_m_s", &JointDesc::max_speed_m_s, {.low = 1e-3, .high = 1e3}, "Prismatic: greatest speed.");
  v.field("strength_low", &JointDesc::strength_low, {.low = -1e7, .high = 0},
          "Greatest effort against the axis, N m or N.");
  v.field("strength_high", &JointDesc::strength_high, {.low = 0, .high = 1e7},
          "Greatest effort along the axis, N m or N.");
  v.field("mass_kg", &JointDesc::mass_kg, kMass, "Mass of the body that moves with the joint; 0 for a massless link.");
  v.field("center_of_mass_m", &JointDesc::center_of_mass_m, kPoint, "Centre of mass in the joint's frame.");
  v.field("inertia_kg_m2", &JointDesc::inertia_kg_m2, kInertia,
          "Principal moments about the centre of mass, along the frame's axes.");
}

template <class V>
void fields(V& v, const ColliderDesc*) {
  v.field("name", &ColliderDesc::name, kName, "Name, unique in the part.");
  v.field("joint", &ColliderDesc::joint, {.may_be_empty = true},
          "The joint that moves it; empty: the part's fixed body.");
  v.field("shape", &ColliderDesc::shape, {.required = true}, "Sphere, capsule or box.");
}

template <class V>
void fields(V& v, const MeshDesc*) {
  v.field("joint", &MeshDesc::joint, {.may_be_empty = true}, "The joint that moves it; empty: the part's fixed body.");
  v.field("shape", &MeshDesc::shape, {.required = true}, "Sphere, capsule, box or triangles.");
  v.field("color", &MeshDesc::color, kColor, "Linear RGB.");
}

template <class V>
void fields(V& v, const SocketDesc*) {
  v.field("name", &SocketDesc::name, kName, "Name, unique in the part.");
  v.field("joint", &SocketDesc::joint, {.may_be_empty = true},
          "The joint that moves it; empty: the part's fixed body.");
  v.field("position_m", &SocketDesc::position_m, kPoint, "Position in the joint's frame.");
  v.field("rotation_deg", &SocketDesc::rotation_deg, kRotation, "Rotation vector; the socket looks along its +Z.");
}

template <class V>
void fields(V& v, const ReachDesc*) {
  v.field("upper", &ReachDesc::upper, kName,
          "Ball joint at the beginning of the chain, or the first of three hinges at right angles.");
  v.field("middle", &ReachDesc::middle, kName, "Hinge in the middle of the chain, such as an elbow.");
  v.field("tip", &ReachDesc::tip, kName, "Socket at the end of the chain, which the middle joint moves.");
}

template <class V>
void fields(V& v, const FacingDesc*) {
  v.field("joints", &FacingDesc::joints, {.max_count = 8, .required = true},
          "Joints of the chain, from the body outward.");
  v.field("socket", &FacingDesc::socket, kName, "The socket whose +Z shall face the direction.");
}

template <class V>
void fields(V& v, const PartDesc*) {
  v.constant("format", "contort.part/1");
  v.field("name", &PartDesc::name, kName, "Unique name.");
  v.field("kind", &PartDesc::kind, kName, "Kind of the part; a slot takes parts of one kind.");
  v.field("help", &PartDesc::help, kHelp, "One sentence for people.");
  v.field("joints", &PartDesc::joints, {.max_count = 64}, "Joints, parents first.");
  v.field("colliders", &PartDesc::colliders, {.max_count = 64}, "Solid shapes for the self-collision check.");
  v.field("mesh", &PartDesc::mesh, {.max_count = 256}, "Shapes that are drawn; empty: the colliders.");
  v.field("sockets", &PartDesc::sockets, {.max_count = 64},
          "Frames where other parts and objects dock, and named points.");
  v.field("reach", &PartDesc::reach, {.max_count = 1}, "The chain that `reach` moves.");
  v.field("facing", &PartDesc::facing, {.max_count = 1}, "The chain that `direction` moves.");
  v.field("fixed_mass_kg", &PartDesc::fixed_mass_kg, kMass, "Mass that is fixed to the docking frame.");
  v.field("fixed_center_of_mass_m", &PartDesc::fixed_center_of_mass_m, kPoint,
          "Centre of that mass in the docking frame.");
  v.field("fixed_inertia_kg_m2", &PartDesc::fixed_inertia_kg_m2, kInertia, "Principal moments about that centre.");
  v.field("color", &PartDesc::color, kColor, "Linear RGB of colliders that are drawn.");
}

template <class V>
void fields(V& v, const ObjectDesc*) {
  v.constant("format", "contort.object/1");
  v.field("name", &ObjectDesc::name, kName, "Unique name.");
  v.field("help", &ObjectDesc::help, kHelp, "One sentence for people.");
  v.field("mass_kg", &ObjectDesc::mass_kg, kMass, "Mass.");
  v.field("center_of_mass_m", &ObjectDesc::center_of_mass_m, kPoint, "Centre of mass in the object's frame.");
  v.field("inertia_kg_m2", &ObjectDesc::inertia_kg_m2, kInertia, "Principal moments about the centre of mass.");
  v.field("colliders", &ObjectDesc::colliders, {.max_count = 64}, "Solid shapes.");
  v.field("mesh", &ObjectDesc::mesh, {.max_count = 256}, "Shapes that are drawn; empty: the colliders.");
  v.field("points", &ObjectDesc::points, {.max_count = 16}, "Named points with a direction (+Z): the muzzle.");
  v.field("docks", &ObjectDesc::docks, {.max_count = 16}, "Sockets for which the object is made.");
  v.field("color", &ObjectDesc::color, kColor, "Linear RGB of colliders that are drawn.");
}

template <class V>
void fields(V& v, const SlotDesc*) {
  v.field("name", &SlotDesc::name, kName, "Name, unique in the character.");
  v.field("kind", &SlotDesc::kind, kName, "Kind of part that fits.");
  v.field("side", &SlotDesc::side, {.names = kSides}, "right: the part is mirrored.");
  v.field("on_slot", &SlotDesc::on_slot, {.may_be_empty = true},
          "The slot that carries this one; empty for the root slot.");
  v.field("on_socket", &SlotDesc::on_socket, {.may_be_empty = true}, "The socket of the carrying part.");
  v.field("parts", &SlotDesc::parts, {.max_count = 256, .required = true},
          "Parts that may stand here; the first is the default.");
}

template <class V>
void fields(V& v, const AllowedPairDesc*) {
  v.field("a", &AllowedPairDesc::a, {.text = Text::label, .required = true},
          "A collider, slot/name or object:name/name.");
  v.field("b", &AllowedPairDesc::b, {.text = Text::label, .required = true}, "The other collider.");
  v.field("reason", &AllowedPairDesc::reason, {.text = Text::label, .required = true}, "Reason why they may touch.");
}

template <class V>
void fields(V& v, const ControlGroupDesc*) {
  v.field("name", &ControlGroupDesc::name, kName, "Name for reports.");
  v.field("joints", &ControlGroupDesc::joints, {.max_count = 8, .text = json_fields::Text::label, .required = true},
          "\"slot/joint\", or \"root\"; joints of parts that are swapped out are ignored.");
  v.field("greatest", &ControlGroupDesc::greatest, {.low = 1e-3, .high = 1000},
          "Greatest acceleration that control may add, rad/s^2 or m/s^2.");
}

template <class V>
void fields(V& v, const RegionDesc*) {
  v.field("name", &RegionDesc::name, kName, "Name, unique in the character.");
  v.field("point", &RegionDesc::point, {.text = Text::label, .required = true},
          "\"slot/socket\" or \"slot/joint\"; a point of a part that is swapped out is ignored.");
  v.field("shape", &RegionDesc::shape, {.required = true},
          "Shape in the character's frame, on the ground under the root at rest; it moves with the root.");
  v.field("keep_out", &RegionDesc::keep_out, {}, "The point must stay outside instead of inside.");
}

template <class V>
void fields(V& v, const CharacterDesc*) {
  v.constant("format", "contort.character/1");
  v.field("name", &CharacterDesc::name, kName, "Unique name.");
  v.field("help", &CharacterDesc::help, kHelp, "One sentence for people.");
  v.field("slots", &CharacterDesc::slots, {.max_count = 64, .required = true},
          "Slots: the root slot first, and each one after the slot that carries it.");
  v.field("allowed_pairs", &CharacterDesc::allowed_pairs, {.max_count = 10000}, "Pairs of colliders that may touch.");
  v.field("objects", &CharacterDesc::objects, {.max_count = 64}, "Objects that may be attached.");
  v.field("control_groups", &CharacterDesc::control_groups, {.max_count = 16},
          "Groups of joints that dynamic control moves together, in order; if left out, they are found from the "
          "parts.");
  v.field("regions", &CharacterDesc::regions, {.max_count = 64},
          "Regions in which points of the figure must stay, or which they must not enter.");
  v.field("withstands_N_s", &CharacterDesc::withstands_N_s, {.low = 0.0, .high = 1e6},
          "Horizontal push that the character shall withstand; if left out, it is found from mass, height and soles.");
}

template <class V>
void fields(V& v, const KeyPoseDesc*) {
  v.field("at", &KeyPoseDesc::at, {.low = 0, .high = 1, .required = true},
          "Time of the key as a share of the period, above 0.");
  v.field("ease", &KeyPoseDesc::ease, {.names = kEases}, "Easing of the movement from the previous key to this one.");
  v.field("pose", &KeyPoseDesc::pose, {.max_count = 64, .required = true},
          "Angles and travels of joints, named as the parameters of `pose`.");
}

template <class V>
void fields(V& v, const ScriptParamDesc*) {
  v.field("name", &ScriptParamDesc::name, kName,
          "Name in specs and in the script; it ends in its unit, as in \"depth_deg\".");
  v.field("help", &ScriptParamDesc::help, kHelp, "One sentence for people.");
  v.field("low", &ScriptParamDesc::low, {.low = -1e6, .high = 1e6, .required = true}, "Least value.");
  v.field("high", &ScriptParamDesc::high, {.low = -1e6, .high = 1e6, .required = true}, "Greatest value.");
  v.field("preset", &ScriptParamDesc::preset, {.low = -1e6, .high = 1e6, .required = true},
          "Value that is used if a spec gives none.");
}

template <class V>
void fields(V& v, const ActionDesc*) {
  v.constant("format", "contort.action/1");
  v.field("name", &ActionDesc::name, kName, "Name by which specs use the action.");
  v.field("help", &ActionDesc::help, kHelp, "One sentence for people.");
  v.field("parts", &ActionDesc::parts, {.max_count = 256}, "Names of the parts that can perform the action.");
  v.field("kinds", &ActionDesc::kinds, {.max_count = 64}, "Kinds of parts that can perform the action.");
  v.field("keys", &ActionDesc::keys, {.max_count = 64}, "Poses, one after another.");
  v.field("of", &ActionDesc::of, {.may_be_empty = true}, "Built-in action that this one varies, instead of `keys`.");
  v.field("params", &ActionDesc::params, {.max_count = 64}, "With `of`: values that are used if a spec gives none.");
  v.field("script", &ActionDesc::script, {.max_count = 1000, .text = Text::prose, .may_be_empty = true},
          "Lines of Lua that compute `sets` in each frame.");
  v.field("sets", &ActionDesc::sets, {.max_count = 64},
          "For scripts: the joints that they set, named as the parameters of `pose`; with `of`, parameters of that "
          "action.");
  v.field("parameters", &ActionDesc::parameters, {.max_count = 32}, "For scripts: numbers that a spec may give.");
  v.field("adds", &ActionDesc::adds, {},
          "For scripts: the computed angles are added to the present ones instead of replacing them.");
}

using json_fields::read_document;
using json_fields::write_pretty;
using json_fields::write_schema;

Result<PartDesc> parse_part(std::string_view json) { return read_document<PartDesc>(json, "part"); }
Result<ObjectDesc> parse_object(std::string_view json) { return read_document<ObjectDesc>(json, "object"); }
Result<CharacterDesc> parse_character(std::string_view json) { return read_document<CharacterDesc>(json, "character"); }

Result<ActionDesc> parse_action(std::string_view json) { return read_document<ActionDesc>(json, "action"); }

std::string print_part(const PartDesc& part) { return write_pretty(part); }
std::string print_object(const ObjectDesc& object) { return write_pretty(object); }
std::string print_character(const CharacterDesc& character) { return write_pretty(character); }

std::string print_action(const ActionDesc& action) { return write_pretty(action); }

std::string part_schema() { return write_schema<PartDesc>("Contort part"); }
std::string object_schema() { return write_schema<ObjectDesc>("Contort object"); }
std::string action_schema() { return write_schema<ActionDesc>("Contort action"); }
std::string character_schema() { return write_schema<CharacterDesc>("Contort character"); }

}  // namespace contort
