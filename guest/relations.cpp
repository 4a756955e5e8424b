#include "guest/relations.h"

#include <algorithm>

#include "guest/guest_figure.h"
#include "guest/guest_offers.h"
#include "guest/manifest_check.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

ActionUse& use_in(Spec& spec, const PlacedUse& placed) {
  return spec.sequences[at(placed.sequence)].clips[at(placed.clip)].actions[at(placed.index)];
}

double moved(double value, double low, double high) {
  const double step = kNudge * (high - low);
  return high - value >= value - low ? value + step : value - step;
}

ParamValue moved(const ParamDef& def, const ParamValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return moved(*number, def.low, def.high);
  Vec3 point = std::get<Vec3>(value);
  for (int i = 0; i < 3; ++i) point[i] = moved(point[i], def.box[0][i], def.box[1][i]);
  return point;
}

ParamValue value_of(const ActionUse& use, const ParamDef& def) {
  const auto given = use.params.find(def.name);
  return given == use.params.end() ? def.preset : given->second;
}

bool is_continuous(GuestParamType type) { return type == GuestParamType::number || type == GuestParamType::vec3; }

// A vec3 is reflected across the plane between left and right; a number changes its sign.
ParamValue opposite(const ParamValue& value, const Vec3& left) {
  if (const auto* number = std::get_if<double>(&value)) return -*number;
  const Vec3& v = std::get<Vec3>(value);
  return v - 2.0 * glm::dot(v, left) * left;
}

bool is_opposite(const GuestParam& param) {
  const bool can_be = is_continuous(param.type) || param.type == GuestParamType::integer;
  if (!can_be || param.mirror == OtherSide::same) return false;
  return param.mirror == OtherSide::opposite || param.type == GuestParamType::vec3;
}

// Returns false if a value is out of its range on the other side.
bool mirror_params(const PlacedUse& placed, const Vec3& left, ActionUse& use) {
  for (const ParamDef& def : placed.offer->params) {
    if (!is_opposite(placed.action->params.at(def.name))) continue;
    const ParamValue value = opposite(value_of(use, def), left);
    if (!allows(def, value)) return false;
    use.params[def.name] = value;
  }
  return true;
}

// Returns false if the other side has no such part.
bool mirror_parts(const GuestCharacter& from, const Spec& spec, Spec& out) {
  out.character.parts.clear();
  for (const auto& [slot, part] : spec.character.parts) {
    const auto names = from.parts.find(slot);
    const std::string other = other_slot(from, slot);
    const auto others = from.parts.find(other);
    if (names == from.parts.end() && others == from.parts.end()) continue;
    if (names == from.parts.end() || others == from.parts.end()) return false;
    std::size_t index = 0;
    while (index < names->second.size() && part_name(from, slot, index) != part) ++index;
    if (index >= std::min(names->second.size(), others->second.size())) return false;
    out.character.parts[other] = part_name(from, other, index);
  }
  return true;
}

Quat reflected(const Quat& q) { return {q.w, q.x, -q.y, -q.z}; }

// The rotations of all joints in the world.
std::vector<Quat> world_rotations(const Character& character, const Rigid& root, std::span<const double> row) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, root, row, world);
  std::vector<Quat> rotations;
  for (const Rigid& joint : world) rotations.push_back(joint.q);
  return rotations;
}

}  // namespace

Spec nudged(const Spec& spec, std::span<const PlacedUse> uses) {
  Spec out = spec;
  for (const PlacedUse& placed : uses)
    for (const ParamDef& def : placed.offer->params)
      if (is_continuous(placed.action->params.at(def.name).type)) {
        ActionUse& use = use_in(out, placed);
        use.params[def.name] = moved(def, value_of(use, def));
      }
  return out;
}

std::vector<std::size_t> partners_of(const GuestCharacter& character) {
  std::vector<std::size_t> partners(character.joints.size());
  for (std::size_t j = 0; j < partners.size(); ++j) partners[j] = j;
  for (const auto& [one, other] : character.mirror) {
    const std::size_t a = at(find_joint(character, one)), b = at(find_joint(character, other));
    partners[a] = b, partners[b] = a;
  }
  return partners;
}

std::string other_slot(const GuestCharacter& character, const std::string& slot) {
  const std::vector<std::string> slots = slots_of(character);
  const std::vector<std::size_t> partners = partners_of(character);
  for (std::size_t j = 0; j < slots.size(); ++j)
    if (slots[j] == slot) return slots[partners[j]];
  return slot;
}

std::optional<Spec> mirrored(const GuestManifest& manifest, const Spec& spec, std::span<const PlacedUse> uses,
                             const Character& character, const Offers& offers) {
  const GuestCharacter& from = *find_character(manifest, spec.character.name);
  const Vec3 left = Basis(manifest.convention).left();
  Spec out = spec;
  if (!mirror_parts(from, spec, out)) return std::nullopt;
  for (const PlacedUse& placed : uses) {
    ActionUse& use = use_in(out, placed);
    if (!placed.action->mirror.empty()) use.action = placed.action->mirror;
    use.slot = other_slot(from, use.slot);
    const bool is_offered = find_offer(offers, character.find_part(use.slot), use.action) != nullptr;
    if (!is_offered || !mirror_params(placed, left, use)) return std::nullopt;
  }
  return out;
}

Motion mirror_image(const GuestCharacter& from, const Rigid& root_at_rest, const FrameLayout& layout,
                    const Motion& motion) {
  const Character& character = layout.character;
  const std::vector<std::size_t> partners = partners_of(from);
  const std::vector<Quat> rest = world_rotations(character, root_at_rest, character.rest_coords());
  Motion image = motion;
  std::vector<Quat> turned(rest.size());
  for (int frame = 0; frame < motion.frame_count; ++frame) {
    const std::vector<Quat> now = world_rotations(character, motion.root[at(frame)], motion.row(frame));
    for (std::size_t j = 0; j < partners.size(); ++j) {
      const std::size_t one = at(layout.joints[j]), other = at(layout.joints[partners[j]]);
      turned[one] = reflected(now[other] * glm::conjugate(rest[other])) * rest[one];
    }
    image.root[at(frame)].q = turned[0];
    image.root[at(frame)].p_m.x = -motion.root[at(frame)].p_m.x;
    for (std::size_t j = 1; j < turned.size(); ++j) {
      const Joint& joint = character.joints()[j];
      double unused = 0.0;
      set_rotation(joint, glm::conjugate(turned[at(joint.parent)]) * turned[j], frame, image, unused);
    }
  }
  return image;
}

}  // namespace contort
