#include "guest/manifest_check.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kLengthTolerance = 1e-3;

// Collects the first fault. Each check below does nothing once there is one.
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
  faults.expect(joint.low_deg <= joint.high_deg, "bad_range", at + "/low_deg", "found a value above high_deg");
  faults.expect(joint.low_deg <= 0.0 && joint.high_deg >= 0.0, "bad_range", at + "/low_deg",
                "the range must hold 0, which is the rest pose: choose a rest pose within the range");
}

// A slot begins where its first joint hangs on a joint of another one; a second such place would split it.
void check_slots(const GuestCharacter& character, const std::string& at, ManifestFaults& faults) {
  const std::vector<std::string> slots = slots_of(character);
  std::set<std::string> begun;
  for (std::size_t j = 0; j < slots.size(); ++j) {
    const int parent = find_joint(character, character.joints[j].parent);
    if (parent >= 0 && slots[contort::at(parent)] == slots[j]) continue;
    faults.expect(begun.insert(slots[j]).second, "split_slot", at + "/joints/" + std::to_string(j) + "/slot",
                  "the joints of slot " + in_quotes(slots[j]) + " are not connected; use a slot for each limb");
  }
  for (const auto& [slot, parts] : character.parts) {
    faults.expect(begun.contains(slot), "unknown_slot", at + "/parts/" + slot, "no joint is in this slot");
    faults.expect(!parts.empty(), "bad_choice", at + "/parts/" + slot, "found no names; expected at least one");
  }
}

void check_character(const GuestCharacter& character, const std::string& at, ManifestFaults& faults) {
  faults.expect(!character.joints.empty(), "bad_root", at + "/joints", "found no joints; expected at least the root");
  expect_unique(character.joints, at + "/joints", faults);
  for (std::size_t j = 0; j < character.joints.size(); ++j)
    check_joint(character, j, at + "/joints/" + std::to_string(j), faults);
  if (!faults.outcome()) return;
  check_slots(character, at, faults);
  expect_unique(character.colliders, at + "/colliders", faults);
  for (std::size_t c = 0; c < character.colliders.size(); ++c)
    faults.expect(find_joint(character, character.colliders[c].joint) >= 0, "unknown_joint",
                  at + "/colliders/" + std::to_string(c) + "/joint",
                  "found " + in_quotes(character.colliders[c].joint) + ", which is no joint of " + character.name);
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
  if (!action.goal) return;
  const auto target = action.params.find(action.goal->param);
  faults.expect(target != action.params.end() && target->second.type == GuestParamType::vec3, "unknown_param",
                at + "/goal/param", in_quotes(action.goal->param) + " is no parameter of type vec3");
  faults.expect(std::ranges::any_of(manifest.characters,
                                    [&](const GuestCharacter& c) { return find_joint(c, action.goal->tip) >= 0; }),
                "unknown_joint", at + "/goal/tip", in_quotes(action.goal->tip) + " is no joint");
}

}  // namespace

Vec3 as_three(const NumberOrThree& value) {
  if (const auto* three = std::get_if<Vec3>(&value)) return *three;
  return Vec3(std::get<double>(value));
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
  expect_unique(manifest.actions, "/actions", faults);
  expect_unique(manifest.channels, "/channels", faults);
  for (std::size_t c = 0; c < manifest.characters.size(); ++c)
    check_character(manifest.characters[c], "/characters/" + std::to_string(c), faults);
  if (!faults.outcome()) return faults.outcome();
  for (std::size_t a = 0; a < manifest.actions.size(); ++a)
    check_action(manifest, manifest.actions[a], "/actions/" + std::to_string(a), faults);
  for (std::size_t r = 0; r < manifest.relations.size(); ++r)
    faults.expect(std::ranges::find(kRelations, manifest.relations[r]) != std::end(kRelations), "bad_relation",
                  "/relations/" + std::to_string(r), "expected \"history\" or \"rate\"");
  return faults.outcome();
}

}  // namespace contort
