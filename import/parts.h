// Cuts a figure into parts, and writes their descriptions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "import/bodies.h"
#include "import/limits.h"
#include "model/core/result.h"

namespace contort {

// The plan of one part: bones of one limb. The first of them is attached to the carrier.
struct PartPlan {
  std::string slot;  // "arm_left"
  std::string kind;  // "arm"
  Side side = Side::center;
  int carrier = -1;  // index of an earlier plan; -1 for the root part
  std::vector<int> bones;
};

// Cuts the figure into parts. Code import.too_many_parts.
Result<std::vector<PartPlan>> cut(const RiggedFigure& figure);

// The decisions about a bone, for the report.
struct BoneReport {
  std::string joint;    // "arm_left/elbow"; "root" for the first bone
  std::string carries;  // the joint that moves the body; if several joints are at the same point, the last of them
  BoneJoint limits;
};

struct CutFigure {
  std::vector<PartDesc> parts;
  CharacterDesc character;
  std::map<std::string, std::string> joint_of_node;  // by node label; without the root
  // The joint, by node label, that moves the node's skin; includes the root.
  std::map<std::string, std::string> carrier_of_node;
  std::vector<BoneReport> bones;
};

CutFigure describe(const RiggedFigure& figure, const ClipPoses& poses, const std::vector<PartPlan>& plans,
                   const std::string& name, const std::vector<TriangleMesh>& meshes);

}  // namespace contort
