#include "cli/clip_feet_names.h"

#include "import/names.h"
#include "model/core/index.h"

namespace contort::cli {

namespace {

bool is_leg(BoneFamily family) {
  return family == BoneFamily::thigh || family == BoneFamily::shank || family == BoneFamily::leg;
}

NameSense sense_of_node(const Asset& asset, int node) { return sense_of(asset.nodes[at(node)].name); }

int parent_of(const Asset& asset, int node) { return asset.nodes[at(node)].parent; }

// The highest node of the leg that carries the foot; -1 if none does.
int hip_of(const Asset& asset, int foot, Side side) {
  int hip = -1, bones = 0;
  for (int node = parent_of(asset, foot); node >= 0; node = parent_of(asset, node)) {
    const NameSense sense = sense_of_node(asset, node);
    if (!is_leg(sense.family) || sense.side != side) break;
    hip = node, ++bones;
  }
  return bones >= 2 ? hip : -1;
}

// The node below the foot that is named like a toe, otherwise its first child; -1 if it has none.
int toe_of(const Asset& asset, int foot) {
  int first = -1;
  for (const int node : asset.order) {
    if (parent_of(asset, node) != foot) continue;
    if (sense_of_node(asset, node).family == BoneFamily::toe) return node;
    if (first < 0) first = node;
  }
  return first;
}

}  // namespace

std::vector<ClipFoot> feet_by_names(const Asset& asset) {
  std::vector<ClipFoot> out;
  for (const int node : asset.order) {
    const NameSense sense = sense_of_node(asset, node);
    if (sense.family != BoneFamily::foot || sense.side == Side::center) continue;
    const int hip = hip_of(asset, node, sense.side), toe = toe_of(asset, node);
    if (hip >= 0 && toe >= 0) out.push_back({asset.nodes[at(node)].label, hip, node, toe});
  }
  return out;
}

}  // namespace contort::cli
