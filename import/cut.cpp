#include <algorithm>
#include <set>

#include "import/names.h"
#include "import/parts.h"
#include "import/roles.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr std::size_t kMostParts = 64;  // as many as a character has slots
// Greatest number of bones of a part: with two joints for each, it stays below 64 joints.
constexpr std::size_t kMostBones = 30;

int subtree_size(const RiggedFigure& figure, int bone) {
  int size = 1;
  for (const int child : children_of(figure, bone)) size += subtree_size(figure, child);
  return size;
}

// The kind of part for a role; "" for bones that stay in their carrier's part.
std::string kind_of(BoneRole role) {
  switch (role) {
    case BoneRole::spine: return "torso";
    case BoneRole::neck:
    case BoneRole::head: return "head";
    case BoneRole::upper_arm:
    case BoneRole::forearm: return "arm";
    case BoneRole::hand: return "hand";
    case BoneRole::thigh:
    case BoneRole::shank:
    case BoneRole::hock: return "leg";
    case BoneRole::foot: return "foot";
    case BoneRole::tail: return "tail";
    default: return "";
  }
}

bool is_limb(const std::string& kind) { return kind == "arm" || kind == "leg" || kind == "hand" || kind == "foot"; }

// The kind of the new part that begins with this bone; "" if the bone stays in its carrier's part.
std::string begins(const RiggedFigure& figure, int index, const PartPlan& carrier) {
  const Bone& bone = bone_at(figure, index);
  const std::string kind = kind_of(bone.role);
  const bool starts_limb = bone.role == BoneRole::upper_arm || bone.role == BoneRole::thigh;
  if (starts_limb) return kind;
  if (!kind.empty()) return kind == carrier.kind ? "" : kind;
  if (bone.role != BoneRole::other || is_limb(carrier.kind) || carrier.kind == "head") return "";
  const bool branches = children_of(figure, bone.parent).size() >= 2 && subtree_size(figure, index) >= 2;
  return branches ? "limb" : "";
}

std::string slot_name(const std::string& kind, const Bone& bone) {
  if (kind == "limb") return bone.name;
  if (!is_limb(kind) || bone.side == Side::center) return kind;
  return kind + (bone.side == Side::left ? "_left" : "_right");
}

}  // namespace

Result<std::vector<PartPlan>> cut(const RiggedFigure& figure) {
  std::vector<PartPlan> plans = {
      {figure.is_humanoid ? "waist" : "body", figure.is_humanoid ? "waist" : "body", Side::center, -1, {0}}};
  std::set<std::string> taken = {plans[0].slot};
  std::vector<int> plan_of(figure.bones.size(), 0);
  for (int b = 1; b < static_cast<int>(figure.bones.size()); ++b) {
    const Bone& bone = bone_at(figure, b);
    const int carrier = plan_of[at(bone.parent)];
    std::string kind = begins(figure, b, plans[at(carrier)]);
    if (kind.empty() && plans[at(carrier)].bones.size() >= kMostBones) kind = "limb";
    plan_of[at(b)] = kind.empty() ? carrier : static_cast<int>(plans.size());
    if (kind.empty()) {
      plans[at(carrier)].bones.push_back(b);
      continue;
    }
    const bool sided = is_limb(kind) || kind == "limb";
    plans.push_back({claim_name(slot_name(kind, bone), taken), kind, sided ? bone.side : Side::center, carrier, {b}});
  }
  if (plans.size() <= kMostParts) return plans;
  return Issue{
      "import.too_many_parts", "/skins",
      "the skeleton falls into " + std::to_string(plans.size()) + " parts, allowed are " + std::to_string(kMostParts)};
}

}  // namespace contort
