// The solids of MJCF: their shapes for collisions, and the masses that they give to their body.
#pragma once

#include <map>
#include <optional>

#include "formats/robot/mjcf_text.h"
#include "formats/robot/robot.h"

namespace contort {

struct MjcfMesh {
  std::string file;
  Vec3 scale{1.0};
};
using MjcfMeshes = std::map<std::string, MjcfMesh>;

MjcfMeshes read_meshes(MjcfText& text, const XmlElement& root);

struct MjcfGeom {
  std::optional<RobotShape> shape;  // empty for planes, height fields and shapes that are only drawn
  BodyInertia inertia;              // in the body's frame
  bool has_unknown_mass = false;    // true for a mesh of unknown volume
  std::string left_out;             // the type of a shape that cannot be a collider
};

MjcfGeom read_geom(MjcfText& text, const XmlElement& element, const MjcfAttributes& given, const MjcfMeshes& meshes);

// Reads <inertial>.
BodyInertia read_inertial(MjcfText& text, const XmlElement& element);

}  // namespace contort
