#include "guest/described.h"

#include <algorithm>

#include "model/core/index.h"

namespace contort {

namespace {

// The duration is at least twice the fade, so that a use never fades for its whole duration.
constexpr std::array<double, 2> kLasts_s{0.6, 1.5};
constexpr std::array<double, 2> kFades_s{0.1, 0.25};

std::array<double, 4> numbers_of(const Quat& q) { return {q.x, q.y, q.z, q.w}; }

void set_kind(const Joint& joint, GuestJoint& out) {
  out.axis = joint.axis;
  out.max_speed_deg_s = joint.max_speed * kDegPerRad;
  out.low_deg = joint.low * kDegPerRad, out.high_deg = joint.high * kDegPerRad;
  if (joint.kind == JointKind::hinge) out.type = GuestJointType::hinge;
  if (joint.kind != JointKind::ball) return;
  out.swing_axis = joint.swing_axis;
  out.swing_deg = std::array<double, 2>{joint.swing_a_rad * kDegPerRad, joint.swing_b_rad * kDegPerRad};
  out.swing_center_deg = to_rotation_vector(joint.swing_center) * kDegPerRad;
}

GuestJoint described_joint(const Character& character, std::size_t j) {
  const Joint& joint = character.joints()[j];
  GuestJoint out;
  out.name = j == 0 ? "root" : joint.name;
  out.slot = character.parts()[at(joint.part)].slot;
  const Rigid& place = j == 0 ? character.rest_root() : joint.parent_from_joint;
  out.position = place.p_m, out.rotation = numbers_of(place.q);
  if (j == 0) return out;
  if (joint.body_name != joint.local_name) out.body = joint.body_name;
  out.parent = joint.parent == 0 ? "root" : character.joints()[at(joint.parent)].name;
  if (joint.kind == JointKind::prismatic)
    out.type = GuestJointType::fixed;
  else
    set_kind(joint, out);
  return out;
}

// A convex hull has no shape in the protocol.
bool set_shape(const ColliderShape& shape, GuestCollider& out) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    out.from = out.to = ball->center_m, out.radius = ball->radius_m;
  } else if (const auto* capsule = std::get_if<Capsule>(&shape)) {
    out.from = capsule->a_m, out.to = capsule->b_m, out.radius = capsule->radius_m;
  } else if (const auto* box = std::get_if<Box>(&shape)) {
    out.type = GuestShape::box, out.center = box->center_m, out.half = box->half_m;
    out.rotation = numbers_of(from_rotation_vector(box->rotation_deg * kRadPerDeg));
  } else {
    return false;
  }
  return true;
}

}  // namespace

GuestCharacter describe(const Character& character) {
  GuestCharacter out;
  out.name = character.name();
  for (std::size_t j = 0; j < character.joints().size(); ++j) out.joints.push_back(described_joint(character, j));
  for (const Collider& collider : character.colliders()) {
    GuestCollider shape;
    shape.name = collider.name, shape.joint = out.joints[at(collider.joint)].name;
    if (set_shape(collider.shape, shape)) out.colliders.push_back(shape);
  }
  for (const AllowedPair& pair : character.allowed_pairs())
    out.may_touch.push_back({character.colliders()[at(pair.a)].name, character.colliders()[at(pair.b)].name});
  return out;
}

namespace {

GuestParam described_param(const ParamDef& def) {
  GuestParam out;
  out.help = def.help;
  if (def.type == ParamType::number || def.type == ParamType::vector) {
    out.type = def.type == ParamType::vector ? GuestParamType::vec3 : GuestParamType::number;
    out.low = def.low, out.high = def.high;
  } else {
    out.type = GuestParamType::choice;
    out.choices = def.type == ParamType::choice ? def.choices : def.points;
  }
  if (const auto* number = std::get_if<double>(&def.preset)) out.preset = *number;
  if (const auto* vector = std::get_if<Vec3>(&def.preset)) out.preset = *vector;
  if (const auto* word = std::get_if<std::string>(&def.preset)) out.preset = *word;
  return out;
}

// Returns nothing if the action needs a point of an object and the part carries none.
std::optional<GuestAction> described_action(const OfferedAction& offered, const std::string& slot) {
  GuestAction out;
  out.name = offered.name, out.help = offered.help, out.layer = offered.layer, out.slots = {slot};
  out.duration_s = kLasts_s;
  // A goal is approached during the whole action, and the base layer has nothing to fade to, so these get no blend.
  if (offered.timing == Timing::course) out.blend_in_s = kFades_s;
  if (offered.layer != Layer::overwrite) out.blend_out_s = kFades_s;
  for (const ParamDef& def : offered.params) {
    if (def.optional) continue;
    const GuestParam param = described_param(def);
    if (param.type == GuestParamType::choice && param.choices.empty()) return std::nullopt;
    out.params[def.name] = param;
  }
  return out;
}

void add_action(const GuestAction& action, std::vector<GuestAction>& actions) {
  for (GuestAction& known : actions) {
    GuestAction same = action;
    same.slots = known.slots;
    if (!(same == known)) continue;
    if (std::ranges::find(known.slots, action.slots[0]) == known.slots.end()) known.slots.push_back(action.slots[0]);
    return;
  }
  actions.push_back(action);
}

}  // namespace

Result<GuestManifest> describe(Generator& generator, std::span<const std::string> characters) {
  GuestManifest out;
  out.contort = 1;
  out.name = generator.manifest().name, out.rate_hz = generator.manifest().rate_hz;
  for (const std::string& name : characters) {
    const Result<Character> character = build_character({name, {}, {}}, *generator.manifest().library);
    if (!character) return character.issue();
    out.characters.push_back(describe(*character));
    const Offers& offers = generator.offers(*character);
    for (std::size_t p = 0; p < offers.size(); ++p)
      for (const OfferedAction& offered : offers[p])
        if (const auto action = described_action(offered, character->parts()[p].slot); action)
          add_action(*action, out.actions);
  }
  return out;
}

}  // namespace contort
