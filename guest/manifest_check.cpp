#include "guest/manifest_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "guest/basis.h"
#include "guest/relations.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kLengthTolerance = 1e-3;
constexpr double kAsymmetry = 0.01;  // greatest asymmetry of a rest pose, as a fraction of the figure's size

// Collects the first fault. After a fault the checks below do nothing.
class ManifestFaults {
 public:
  void expect(bool holds, const char* code, const std::string& pointer, const std::string& text) {
    if (!holds && fault_.code.empty()) fault_ = {std::string("generator.") + code, pointer, text};
  }
  Result<Done> outcome() const { return fault_.code.empty() ? Result<Done>(Done{}) : fault_; }

 private:
  Issue fault_;
};

std::string in_quotes(const std::string& name) { return "\"" + name + "\""; }

template <class List>
void expect_unique(const List& list, const std::string& pointer, ManifestFaults& faults) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < list.size(); ++i)
    faults.expect(seen.insert(list[i].name).second, "duplicate_name", pointer + "/" + std::to_string(i) + "/name",
                  in_quotes(list[i].name) + " is there twice; names must be unique");
}

bool is_unit(const Vec3& v) { return std::fabs(length(v) - 1.0) <= kLengthTolerance; }

bool is_unit(const std::array<double, 4>& q) {
  return std::fabs(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1.0) <= kLengthTolerance;
}

void check_joint(const GuestCharacter& character, std::size_t index, const std::string& at, ManifestFaults& faults) {
  const GuestJoint& joint = character.joints[index];
  faults.expect(joint.parent.empty() == (index == 0), "bad_root", at + "/parent",
                index == 0 ? "found a parent, but the first joint is the root and has none"
                           : in_quotes(joint.name) + " has no parent; only the first joint, the root, has none");
  const int parent = find_joint(character, joint.parent);
  faults.expect(index == 0 || (parent >= 0 && parent < static_cast<int>(index)), "unknown_joint", at + "/parent",
                "found " + in_quotes(joint.parent) + ", expected the name of an earlier joint");
  faults.expect(is_unit(joint.rotation), "bad_rotation", at + "/rotation",
                "found a quaternion x y z w whose length is not 1");
  faults.expect(is_unit(joint.axis), "bad_axis", at + "/axis", "found an axis whose length is not 1");
  faults.expect(!joint.swing_axis || (is_unit(*joint.swing_axis) &&
                                      std::fabs(glm::dot(*joint.swing_axis, joint.axis)) <= kLengthTolerance),
                "bad_axis", at + "/swing_axis", "expected an axis of length 1 at a right angle to \"axis\"");
  faults.expect(joint.low_deg <= joint.high_deg, "bad_range", at + "/low_deg", "found a value above high_deg");
  faults.expect(joint.low_deg <= 0.0 && joint.high_deg >= 0.0, "bad_range", at + "/low_deg",
                "the range must hold 0, which is the rest pose: choose a rest pose within the range");
}

// Returns true if the joint follows itself through others. Chains of followers are allowed.
bool is_in_ring(const GuestCharacter& character, std::size_t index) {
  std::size_t at = index;
  for (std::size_t steps = 0; steps <= character.joints.size(); ++steps) {
    const std::optional<GuestFollow>& follows = character.joints[at].follows;
    const int leader = follows ? find_joint(character, follows->joint) : -1;
    if (leader < 0) return false;
    at = contort::at(leader);
    if (at == index) return true;
  }
  return false;  // the joint leads into a ring without being part of it; the fault is reported at the ring's joints
}

void check_follower(const GuestCharacter& character, std::size_t index, const std::string& at,
                    ManifestFaults& faults) {
  const GuestJoint& joint = character.joints[index];
  if (!joint.follows) return;
  const int leader = find_joint(character, joint.follows->joint);
  faults.expect(index > 0 && joint.type == GuestJointType::hinge, "bad_follower", at,
                in_quotes(joint.name) + " is the root, or no hinge: it cannot follow another joint");
  faults.expect(leader >= 0, "unknown_joint", at + "/joint",
                "found " + in_quotes(joint.follows->joint) + ", which is no joint of " + character.name);
  if (leader < 0) return;
  faults.expect(leader > 0 && character.joints[contort::at(leader)].type == GuestJointType::hinge, "bad_follower",
                at + "/joint", in_quotes(joint.follows->joint) + " is the root, or no hinge: it cannot lead");
  faults.expect(!is_in_ring(character, index), "bad_follower", at + "/joint",
                in_quotes(joint.name) + " follows itself, or a joint that follows it");
}

// All joints through which a slot is attached must have the same parent; a slot may be attached by several joints, such
// as fingers.
void check_slots(const GuestCharacter& character, const std::string& at, ManifestFaults& faults) {
  const std::vector<std::string> slots = slots_of(character);
  std::map<std::string, int> begun;  // slot, and the joint that carries it
  for (std::size_t j = 0; j < slots.size(); ++j) {
    const int parent = find_joint(character, character.joints[j].parent);
    if (parent >= 0 && slots[contort::at(parent)] == slots[j]) continue;
    const bool is_first = begun.try_emplace(slots[j], parent).second;
    faults.expect(is_first || begun.at(slots[j]) == parent, "split_slot", at + "/joints/" + std::to_string(j) + "/slot",
                  "the joints of slot " + in_quotes(slots[j]) + " hang on several joints; use a slot for each limb");
  }
  for (const auto& [slot, parts] : character.parts) {
    faults.expect(begun.contains(slot), "unknown_slot", at + "/parts/" + slot, "no joint is in this slot");
    faults.expect(!parts.empty(), "bad_choice", at + "/parts/" + slot, "found no names; expected at least one");
  }
}

void check_colliders(const GuestCharacter& character, const std::string& at, ManifestFaults& faults) {
  expect_unique(character.colliders, at + "/colliders", faults);
  for (std::size_t c = 0; c < character.colliders.size(); ++c) {
    const GuestCollider& collider = character.colliders[c];
    const std::string place = at + "/colliders/" + std::to_string(c);
    faults.expect(find_joint(character, collider.joint) >= 0, "unknown_joint", place + "/joint",
                  "found " + in_quotes(collider.joint) + ", which is no joint of " + character.name);
    faults.expect(is_unit(collider.rotation), "bad_rotation", place + "/rotation",
                  "found a quaternion x y z w whose length is not 1");
  }
  for (std::size_t p = 0; p < character.may_touch.size(); ++p)
    for (const std::string& name : character.may_touch[p])
      faults.expect(find_collider(character, name) >= 0, "unknown_collider", at + "/may_touch/" + std::to_string(p),
                    in_quotes(name) + " is no collider of " + character.name);
}

void check_character(const GuestCharacter& character, const std::string& at, ManifestFaults& faults) {
  faults.expect(!character.joints.empty(), "bad_root", at + "/joints", "found no joints; expected at least the root");
  expect_unique(character.joints, at + "/joints", faults);
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    check_joint(character, j, at + "/joints/" + std::to_string(j), faults);
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    check_follower(character, j, at + "/joints/" + std::to_string(j) + "/follows", faults);
  if (!faults.outcome()) return;
  check_slots(character, at, faults);
  check_colliders(character, at, faults);
}

// Positions of the joints at rest, in our world.
std::vector<Vec3> rest_points(const GuestCharacter& character, const Basis& basis) {
  std::vector<Rigid> world;
  for (const GuestJoint& joint : character.joints) {
    const auto& [x, y, z, w] = joint.rotation;
    const Rigid local{glm::normalize(basis.rotation(x, y, z, w)), basis.point_m(joint.position)};
    const int parent = find_joint(character, joint.parent);
    world.push_back(parent < 0 ? local : world[contort::at(parent)] * local);
  }
  std::vector<Vec3> points;
  for (const Rigid& joint : world) points.push_back(joint.p_m);
  return points;
}

// Partners must be mirror images of each other at rest; otherwise no motion has a mirror image.
void check_symmetry(const GuestCharacter& character, const Basis& basis, const std::string& at, ManifestFaults& faults) {
  const std::vector<Vec3> points = rest_points(character, basis);
  const std::vector<std::size_t> partners = partners_of(character);
  double size_m = 0.0;
  for (const Vec3& point : points) size_m = std::max(size_m, length(point - points[0]));
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Vec3& other = points[partners[j]];
    const std::string pair = in_quotes(character.joints[j].name) + " and " + in_quotes(character.joints[partners[j]].name);
    faults.expect(length(points[j] - Vec3(-other.x, other.y, other.z)) <= kAsymmetry * size_m + 1e-9, "not_symmetric", at,
                  "at rest " + pair + " are not each other's mirror image about the plane between left and right of " +
                      "the world");
    faults.expect(character.joints[j].type == character.joints[partners[j]].type, "not_symmetric", at,
                  pair + " are joints of different types");
  }
}

void check_mirror(const GuestManifest& manifest, const GuestCharacter& character, const std::string& at,
                  ManifestFaults& faults) {
  std::set<std::string> paired;
  for (const auto& [one, other] : character.mirror)
    for (const std::string& name : {one, other}) {
      faults.expect(find_joint(character, name) >= 0, "unknown_joint", at + "/" + one, in_quotes(name) + " is no joint");
      const auto back = character.mirror.find(other);
      const bool is_said_twice = back != character.mirror.end() && back->second == one;
      faults.expect(paired.insert(name).second || is_said_twice, "duplicate_name", at + "/" + one,
                    in_quotes(name) + " is in two pairs");
    }
  if (faults.outcome() && manifest.declares("mirror"))
    check_symmetry(character, Basis(manifest.convention), at, faults);
}

bool is_value_of(GuestParamType type, const GuestValue& value) {
  switch (type) {
    case GuestParamType::flag: return std::holds_alternative<bool>(value);
    case GuestParamType::choice: return std::holds_alternative<std::string>(value);
    case GuestParamType::vec3: return std::holds_alternative<Vec3>(value);
    default: return std::holds_alternative<double>(value);
  }
}

bool is_in_range(const GuestParam& param, const GuestValue& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return std::ranges::find(param.choices, *word) != param.choices.end();
  const Vec3 low = as_three(param.low), high = as_three(param.high);
  if (const auto* v = std::get_if<Vec3>(&value))
    return glm::all(glm::lessThanEqual(low, *v)) && glm::all(glm::lessThanEqual(*v, high));
  const auto* number = std::get_if<double>(&value);
  return number == nullptr || (low.x <= *number && *number <= high.x);
}

void check_param(const GuestParam& param, const std::string& at, ManifestFaults& faults) {
  const bool is_choice = param.type == GuestParamType::choice;
  faults.expect(is_choice != param.choices.empty(), "bad_choice", at + "/choices",
                is_choice ? "a choice needs at least one word" : "only a choice has choices");
  faults.expect(glm::all(glm::lessThanEqual(as_three(param.low), as_three(param.high))), "bad_range", at + "/low",
                "found a value above high");
  const auto expect_value = [&](const GuestValue& value, const std::string& pointer) {
    faults.expect(is_value_of(param.type, value), "bad_value", pointer, "the value is of another type than the parameter");
    faults.expect(!is_value_of(param.type, value) || is_in_range(param, value), "bad_value", pointer,
                  "the value is not within low and high, or no word of the choices");
  };
  if (param.preset) expect_value(*param.preset, at + "/default");
  for (std::size_t i = 0; i < param.special.size(); ++i)
    expect_value(param.special[i], at + "/special/" + std::to_string(i));
}

// An action may be listed once, or once for each slot, because its parameters may differ between slots.
void expect_distinct(const std::vector<GuestAction>& actions, ManifestFaults& faults) {
  std::set<std::pair<std::string, std::string>> seen;
  for (std::size_t a = 0; a < actions.size(); ++a)
    for (const std::string& slot : actions[a].slots.empty() ? std::vector<std::string>{""} : actions[a].slots)
      faults.expect(seen.insert({actions[a].name, slot}).second, "duplicate_name",
                    "/actions/" + std::to_string(a) + "/name",
                    in_quotes(actions[a].name) + " is there twice" + (slot.empty() ? "" : " for slot " + in_quotes(slot)));
}

bool is_joint(const GuestManifest& manifest, const std::string& name) {
  return std::ranges::any_of(manifest.characters, [&](const GuestCharacter& c) { return find_joint(c, name) >= 0; });
}

void check_channel(const GuestManifest& manifest, const GuestChannel& channel, const std::string& at,
                   ManifestFaults& faults) {
  if (channel.contact.empty()) return;
  faults.expect(channel.type == ChannelType::flag, "bad_channel", at, "only a flag says that a joint stands still");
  faults.expect(is_joint(manifest, channel.contact), "unknown_joint", at, in_quotes(channel.contact) + " is no joint");
}

bool is_slot(const GuestManifest& manifest, const std::string& slot) {
  return std::ranges::any_of(manifest.characters, [&](const GuestCharacter& character) {
    const std::vector<std::string> slots = slots_of(character);
    return std::ranges::find(slots, slot) != slots.end();
  });
}

void check_action(const GuestManifest& manifest, const GuestAction& action, const std::string& at,
                  ManifestFaults& faults) {
  for (std::size_t s = 0; s < action.slots.size(); ++s)
    faults.expect(is_slot(manifest, action.slots[s]), "unknown_slot", at + "/slots/" + std::to_string(s),
                  "no joint of a character is in slot " + in_quotes(action.slots[s]));
  for (const auto& [field, range] : {std::pair("duration_s", action.duration_s), {"blend_in_s", action.blend_in_s},
                                     {"blend_out_s", action.blend_out_s}})
    faults.expect(range[0] <= range[1], "bad_range", at + "/" + field, "found a shortest time above the longest");
  for (const auto& [name, param] : action.params) check_param(param, at + "/params/" + name, faults);
  faults.expect(action.mirror.empty() || std::ranges::find(manifest.actions, action.mirror, &GuestAction::name) != manifest.actions.end(),
                "unknown_action", at + "/mirror", in_quotes(action.mirror) + " is no action");
  if (!action.goal) return;
  const auto target = action.params.find(action.goal->param);
  faults.expect(target != action.params.end() && target->second.type == GuestParamType::vec3, "unknown_param",
                at + "/goal/param", in_quotes(action.goal->param) + " is no parameter of type vec3");
  faults.expect(is_joint(manifest, action.goal->tip), "unknown_joint", at + "/goal/tip",
                in_quotes(action.goal->tip) + " is no joint");
}

}  // namespace

Vec3 as_three(const NumberOrThree& value) {
  if (const auto* three = std::get_if<Vec3>(&value)) return *three;
  return Vec3(std::get<double>(value));
}

std::array<double, 2> as_two(const NumberOrTwo& value) {
  if (const auto* two = std::get_if<std::array<double, 2>>(&value)) return *two;
  return {std::get<double>(value), std::get<double>(value)};
}

int find_collider(const GuestCharacter& character, std::string_view name) {
  const auto found = std::ranges::find(character.colliders, name, &GuestCollider::name);
  return found == character.colliders.end() ? -1 : static_cast<int>(found - character.colliders.begin());
}

int find_joint(const GuestCharacter& character, std::string_view name) {
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    if (character.joints[j].name == name) return static_cast<int>(j);
  return -1;
}

std::vector<std::string> slots_of(const GuestCharacter& character) {
  std::vector<std::string> slots;
  for (const GuestJoint& joint : character.joints) {
    const int parent = find_joint(character, joint.parent);
    const bool has_parent = parent >= 0 && parent < static_cast<int>(slots.size());
    slots.push_back(!joint.slot.empty() ? joint.slot : has_parent ? slots[contort::at(parent)] : "body");
  }
  return slots;
}

Result<Done> check_manifest(const GuestManifest& manifest) {
  ManifestFaults faults;
  const GuestConvention& convention = manifest.convention;
  faults.expect(static_cast<int>(convention.up) / 2 != static_cast<int>(convention.forward) / 2, "bad_convention",
                "/convention/forward", "up and forward are along the same axis");
  faults.expect(!manifest.characters.empty(), "no_character", "/characters", "found none; expected at least one");
  faults.expect(!manifest.actions.empty(), "no_action", "/actions", "found none; expected at least one");
  expect_unique(manifest.characters, "/characters", faults);
  expect_distinct(manifest.actions, faults);
  expect_unique(manifest.channels, "/channels", faults);
  for (std::size_t c = 0; c < manifest.characters.size(); ++c)
    check_character(manifest.characters[c], "/characters/" + std::to_string(c), faults);
  for (std::size_t c = 0; faults.outcome() && c < manifest.characters.size(); ++c)
    check_mirror(manifest, manifest.characters[c], "/characters/" + std::to_string(c) + "/mirror", faults);
  if (!faults.outcome()) return faults.outcome();
  for (std::size_t a = 0; a < manifest.actions.size(); ++a)
    check_action(manifest, manifest.actions[a], "/actions/" + std::to_string(a), faults);
  for (std::size_t c = 0; c < manifest.channels.size(); ++c)
    check_channel(manifest, manifest.channels[c], "/channels/" + std::to_string(c) + "/contact", faults);
  for (std::size_t r = 0; r < manifest.relations.size(); ++r)
    faults.expect(std::ranges::find(kRelations, manifest.relations[r]) != std::end(kRelations), "bad_relation",
                  "/relations/" + std::to_string(r), "expected \"history\", \"rate\", \"gain\" or \"mirror\"");
  return faults.outcome();
}

}  // namespace contort
