#include "import/roles.h"

#include <algorithm>
#include <array>
#include <limits>

#include "model/core/index.h"

namespace contort {

namespace {

bool is_leg_family(BoneFamily family) {
  return family == BoneFamily::thigh || family == BoneFamily::shank || family == BoneFamily::leg;
}
bool is_arm_family(BoneFamily family) {
  return family == BoneFamily::upper_arm || family == BoneFamily::forearm || family == BoneFamily::arm;
}

// The families and roles in one of the two kinds of limbs.
struct LimbRoles {
  bool (*in_chain)(BoneFamily);
  BoneFamily first;  // a bone of this family is certainly the upper one
  BoneRole upper;
  BoneRole middle;
  BoneRole end;
  BoneFamily end_family;
};
constexpr LimbRoles kLeg = {is_leg_family,   BoneFamily::thigh, BoneRole::thigh,
                            BoneRole::shank, BoneRole::foot,    BoneFamily::foot};
constexpr LimbRoles kArm = {is_arm_family,     BoneFamily::upper_arm, BoneRole::upper_arm,
                            BoneRole::forearm, BoneRole::hand,        BoneFamily::hand};

class RoleFinder {
 public:
  explicit RoleFinder(RiggedFigure& figure) : figure_(figure) {}

  void find() {
    give_plain_roles();
    for (std::size_t b = 0; b < figure_.bones.size(); ++b) {
      if (begins(static_cast<int>(b), kLeg)) give_limb_roles(chain_from(static_cast<int>(b), kLeg), kLeg);
      if (begins(static_cast<int>(b), kArm)) give_limb_roles(chain_from(static_cast<int>(b), kArm), kArm);
    }
    figure_.is_quadruped = stands_on_arms() || stands_on_four_legs();
    if (figure_.is_quadruped) turn_arms_to_legs();
    pass_on_ends();
    figure_.bones.front().role = BoneRole::root;
    figure_.is_humanoid = !figure_.is_quadruped && has_all_limbs() && is_upright();
  }

 private:
  Bone& bone(int index) { return figure_.bones[at(index)]; }
  const Bone& bone(int index) const { return figure_.bones[at(index)]; }

  void give_plain_roles() {
    for (Bone& b : figure_.bones) {
      switch (b.family) {
        case BoneFamily::hips:
        case BoneFamily::spine: b.role = BoneRole::spine; break;
        case BoneFamily::neck: b.role = BoneRole::neck; break;
        case BoneFamily::head: b.role = BoneRole::head; break;
        case BoneFamily::clavicle: b.role = BoneRole::clavicle; break;
        case BoneFamily::hand: b.role = BoneRole::hand; break;
        case BoneFamily::finger: b.role = BoneRole::finger; break;
        case BoneFamily::foot: b.role = BoneRole::foot; break;
        case BoneFamily::toe: b.role = BoneRole::toe; break;
        case BoneFamily::tail: b.role = BoneRole::tail; break;
        default: b.role = BoneRole::other;
      }
    }
  }

  bool continues(int child, int parent, const LimbRoles& limb) const {
    return limb.in_chain(bone(child).family) && bone(child).side == bone(parent).side;
  }

  bool begins(int b, const LimbRoles& limb) const {
    if (!limb.in_chain(bone(b).family) || bone(b).side == Side::center) return false;
    const int parent = bone(b).parent;
    return parent < 0 || !continues(b, parent, limb) || !limb.in_chain(bone(parent).family);
  }

  std::vector<int> chain_from(int first, const LimbRoles& limb) const {
    std::vector<int> chain = {first};
    for (bool grows = true; grows;) {
      grows = false;
      for (const int child : children_of(figure_, chain.back()))
        if (!grows && continues(child, chain.back(), limb)) chain.push_back(child), grows = true;
    }
    return chain;
  }

  int end_bone(int last, const LimbRoles& limb) const {
    for (const int child : children_of(figure_, last))
      if (bone(child).family == limb.end_family) return child;
    return -1;
  }

  double step(const std::vector<int>& chain, std::size_t i) const {
    if (i + 1 < chain.size()) return length(bone(chain[i + 1]).position_m - bone(chain[i]).position_m);
    return length(end_of(figure_, chain[i]) - bone(chain[i]).position_m);
  }

  // Assigns the roles of a chain. The upper and middle bones are the longest pair of neighbours, unless a name decides.
  // If a chain of three or more bones has no separate end, its third bone is the end.
  void give_limb_roles(std::vector<int> chain, const LimbRoles& limb) {
    int end = end_bone(chain.back(), limb);
    if (end < 0 && chain.size() >= 3) {
      end = chain[2];
      for (std::size_t i = 3; i < chain.size(); ++i)
        bone(chain[i]).role = limb.end == BoneRole::foot ? BoneRole::toe : BoneRole::hand;
      chain.resize(2);
    }
    if (end >= 0) bone(end).role = limb.end;
    if (chain.size() < 2) return;
    std::size_t upper = 0;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      if (step(chain, i) + step(chain, i + 1) > step(chain, upper) + step(chain, upper + 1)) upper = i;
    for (std::size_t i = chain.size() - 1; i-- > 0;)
      if (bone(chain[i]).family == limb.first) upper = i;
    const std::size_t middle = middle_of(chain, upper, limb);
    for (std::size_t i = 0; i < chain.size(); ++i)
      bone(chain[i]).role = i == upper                                           ? limb.upper
                            : i == middle                                        ? limb.middle
                            : i < middle || shares_twist(chain[i], chain[i - 1]) ? BoneRole::other
                                                                                 : BoneRole::hock;
  }

  // Returns true for bones such as "shin.L.001" below "shin.L".
  bool shares_twist(int lower, int upper) const {
    const BoneFamily family = bone(lower).family;
    return family == bone(upper).family && (family == BoneFamily::shank || family == BoneFamily::forearm);
  }

  // The middle bone is the next one. If several bones have the upper one's name, it is the first one with another name:
  // "upper_arm.L.001" only shares the twist.
  std::size_t middle_of(const std::vector<int>& chain, std::size_t upper, const LimbRoles& limb) const {
    std::size_t middle = upper + 1;
    while (middle + 1 < chain.size() && bone(chain[middle]).family == limb.first &&
           bone(chain[middle + 1]).family != BoneFamily::unknown)
      ++middle;
    return bone(chain[middle]).family == limb.first ? upper + 1 : middle;
  }

  // Bones below a hand are fingers, below a foot toes, below a head the head.
  void pass_on_ends() {
    for (Bone& b : figure_.bones) {
      if (b.parent < 0) continue;
      const BoneRole up = bone(b.parent).role;
      if (up == BoneRole::hand || up == BoneRole::finger) b.role = BoneRole::finger;
      if (up == BoneRole::foot || up == BoneRole::toe) b.role = BoneRole::toe;
      if (up == BoneRole::head && b.role == BoneRole::other) b.role = BoneRole::head;
      if (up == BoneRole::tail) b.role = BoneRole::tail;
    }
  }

  // The vector from the root to the head, or to the last bone of the spine; 0 without either.
  Vec3 spine() const {
    Vec3 out(0.0);
    bool has_head = false;
    for (const Bone& b : figure_.bones) {
      const bool is_head = b.role == BoneRole::head || b.role == BoneRole::neck;
      if (is_head && !has_head) has_head = true, out = b.position_m;
      if (!has_head && b.role == BoneRole::spine) out = b.position_m;
    }
    return out;
  }

  bool is_upright() const {
    const Vec3 s = spine();
    return s.y > 0.7 * length(s) && length(s) > 0.0;
  }

  int count(BoneRole role, Side side) const {
    return static_cast<int>(std::count_if(figure_.bones.begin(), figure_.bones.end(),
                                          [&](const Bone& b) { return b.role == role && b.side == side; }));
  }

  bool has_all_limbs() const {
    for (const BoneRole role : {BoneRole::upper_arm, BoneRole::forearm, BoneRole::thigh, BoneRole::shank})
      for (const Side side : {Side::left, Side::right})
        if (count(role, side) != 1) return false;
    return count(BoneRole::hock, Side::left) == 0;
  }

  bool stands_on_arms() const {
    const Vec3 s = spine();
    int standing = 0;
    for (std::size_t b = 0; b < figure_.bones.size(); ++b)
      if (figure_.bones[b].role == BoneRole::upper_arm)
        standing += lowest_below_m(figure_, static_cast<int>(b)) < figure_.ground_m + 0.1 * figure_.height_m;
    return standing >= 2 && s.y < 0.7 * length(s);
  }

  // Some files also call forelegs legs.
  bool stands_on_four_legs() const {
    std::array<int, 2> standing{};
    for (std::size_t b = 0; b < figure_.bones.size(); ++b) {
      const Bone& own = figure_.bones[b];
      if (own.role == BoneRole::thigh && own.side != Side::center &&
          lowest_below_m(figure_, static_cast<int>(b)) < figure_.ground_m + 0.1 * figure_.height_m)
        ++standing[own.side == Side::left ? 0 : 1];
    }
    const Vec3 s = spine();
    return standing[0] == 2 && standing[1] == 2 && s.y < 0.85 * length(s);
  }

  void turn_arms_to_legs() {
    for (Bone& b : figure_.bones) {
      if (b.role == BoneRole::upper_arm) b.role = BoneRole::thigh;
      if (b.role == BoneRole::forearm) b.role = BoneRole::shank;
      if (b.role == BoneRole::hand) b.role = BoneRole::foot;
      if (b.role == BoneRole::finger) b.role = BoneRole::toe;
    }
  }

  RiggedFigure& figure_;
};

}  // namespace

void find_roles(RiggedFigure& figure) { RoleFinder(figure).find(); }

int child_of_role(const RiggedFigure& figure, int bone, BoneRole role) {
  for (const int child : children_of(figure, bone))
    if (bone_at(figure, child).role == role) return child;
  return -1;
}

Vec3 end_of(const RiggedFigure& figure, int bone) {
  const Bone& own = bone_at(figure, bone);
  const std::vector<int> below = children_of(figure, bone);
  const auto chain = std::find_if(below.begin(), below.end(), [&](int child) {
    const BoneRole role = bone_at(figure, child).role;
    return role != BoneRole::other && bone_at(figure, child).side == own.side;
  });
  if (chain != below.end()) return bone_at(figure, *chain).position_m;
  if (!below.empty()) {
    Vec3 sum(0.0);
    for (const int child : below) sum += bone_at(figure, child).position_m;
    return sum / static_cast<double>(below.size());
  }
  Vec3 middle(0.0);
  for (const Vec3& p : own.points_m) middle += p;
  if (own.points_m.empty() || length(middle) < 1e-12) return own.position_m;
  const Vec3 along = glm::normalize(middle);
  double far = 0.0;
  for (const Vec3& p : own.points_m) far = std::max(far, glm::dot(p, along));
  return own.position_m + far * along;
}

Vec3 direction_of(const RiggedFigure& figure, int bone) {
  return unit_or(end_of(figure, bone) - bone_at(figure, bone).position_m, Vec3(0.0, 1.0, 0.0));
}

double lowest_below_m(const RiggedFigure& figure, int bone) {
  double low = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < figure.bones.size(); ++b) {
    int up = static_cast<int>(b);
    while (up >= 0 && up != bone) up = bone_at(figure, up).parent;
    if (up != bone) continue;
    for (const Vec3& p : figure.bones[b].points_m) low = std::min(low, figure.bones[b].position_m.y + p.y);
  }
  return low;
}

}  // namespace contort
