#include "import/bone_tree.h"

#include <limits>
#include <utility>

#include "import/owned_surface.h"
#include "model/core/index.h"

namespace contort {

namespace {

int bone_count(const RiggedFigure& figure) { return static_cast<int>(figure.bones.size()); }

std::size_t points_below(const RiggedFigure& figure, int root) {
  std::size_t sum = 0;
  for (int b = 0; b < bone_count(figure); ++b) {
    int up = b;
    while (up >= 0 && up != root) up = bone_at(figure, up).parent;
    if (up == root) sum += bone_at(figure, b).points_m.size();
  }
  return sum;
}

bool is_of_leg(const Bone& bone) {
  return bone.family == BoneFamily::thigh || bone.family == BoneFamily::shank || bone.family == BoneFamily::leg;
}

bool has_child(const RiggedFigure& figure, int bone, bool (*is_meant)(const Bone&)) {
  for (const int child : children_of(figure, bone))
    if (is_meant(bone_at(figure, child))) return true;
  return false;
}

bool is_foot(const Bone& bone) { return bone.family == BoneFamily::foot; }

// The nearest end of a leg of that side; legs without a foot come first. -1 if there is none.
int leg_for(const RiggedFigure& figure, const Bone& foot) {
  int best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < bone_count(figure); ++b) {
    const Bone& leg = bone_at(figure, b);
    if (!is_of_leg(leg) || leg.side != foot.side || has_child(figure, b, is_of_leg)) continue;
    const double handicap = has_child(figure, b, is_foot) ? kMaxModelCoordinate : 0.0;
    const double distance = length(leg.position_m - foot.position_m) + handicap;
    if (distance < nearest) nearest = distance, best = b;
  }
  return best;
}

bool hangs_on_leg(const RiggedFigure& figure, int bone) {
  for (int b = bone_at(figure, bone).parent; b >= 0; b = bone_at(figure, b).parent)
    if (is_of_leg(bone_at(figure, b))) return true;
  return false;
}

void hang_feet_on_legs(RiggedFigure& figure) {
  for (int b = 0; b < bone_count(figure); ++b) {
    Bone& bone = figure.bones[at(b)];
    if (!is_foot(bone) || bone.side == Side::center || hangs_on_leg(figure, b)) continue;
    const int leg = leg_for(figure, bone);
    if (leg < 0) continue;
    bone.parent = leg;
    figure.notes.push_back("\"" + bone.label + "\" is not attached to a leg in the file; here it is attached to \"" +
                           bone_at(figure, leg).label + "\".");
  }
}

// The root of the tree with the most points; the first of several equal ones.
int root_of_most(const RiggedFigure& figure) {
  int root = -1;
  std::size_t most = 0;
  for (int b = 0; b < bone_count(figure); ++b) {
    if (bone_at(figure, b).parent >= 0) continue;
    if (const std::size_t count = points_below(figure, b); root < 0 || count > most) root = b, most = count;
  }
  return root;
}

void hang_trees_on(RiggedFigure& figure, int root) {
  for (int b = 0; b < bone_count(figure); ++b) {
    Bone& bone = figure.bones[at(b)];
    if (bone.parent >= 0 || b == root) continue;
    bone.parent = root;
    figure.notes.push_back("\"" + bone.label + "\" has no parent in the file; here it is attached to the root.");
  }
}

// The first bone from the root on that is no handle. Handles are removed from the tree.
int without_handles(RiggedFigure& figure, int root) {
  for (;;) {
    const std::vector<int> below = children_of(figure, root);
    if (!bone_at(figure, root).points_m.empty() || below.size() != 1) return root;
    figure.bones[at(root)].parent = -2;
    root = below.front();
    figure.bones[at(root)].parent = -1;
  }
}

// Lists the bones depth first, children in the order of the file.
std::vector<int> order_below(const RiggedFigure& figure, int root) {
  std::vector<int> order, open = {root};
  while (!open.empty()) {
    order.push_back(open.back());
    open.pop_back();
    const std::vector<int> below = children_of(figure, order.back());
    open.insert(open.end(), below.rbegin(), below.rend());
  }
  return order;
}

// Keeps only the bones below the root.
void sort_below(RiggedFigure& figure, int root) {
  const std::vector<int> order = order_below(figure, root);
  std::vector<int> place(figure.bones.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) place[at(order[i])] = static_cast<int>(i);
  std::vector<Bone> sorted;
  for (const int bone : order) sorted.push_back(std::move(figure.bones[at(bone)]));
  for (Bone& bone : sorted)
    if (bone.parent >= 0) bone.parent = place[at(bone.parent)];
  sorted.front().parent = -1;
  figure.bones = std::move(sorted);
}

}  // namespace

std::vector<int> children_of(const RiggedFigure& figure, int bone) {
  std::vector<int> out;
  for (int b = 0; b < bone_count(figure); ++b)
    if (bone_at(figure, b).parent == bone) out.push_back(b);
  return out;
}

void make_one_tree(RiggedFigure& figure) {
  hang_feet_on_legs(figure);
  const int root = root_of_most(figure);
  hang_trees_on(figure, root);
  sort_below(figure, without_handles(figure, root));
}

}  // namespace contort
