#include "generator/dynamics/multibody.h"

namespace contort {

namespace {

Mat3 cross_matrix(const Vec3& a) { return {Vec3(0.0, a.z, -a.y), Vec3(-a.z, 0.0, a.x), Vec3(a.y, -a.x, 0.0)}; }

int dofs_of(JointKind kind) {
  if (kind == JointKind::root) return kRootDofs;
  return kind == JointKind::ball ? 3 : 1;
}

Link link_of(const Joint& joint) {
  Link link;
  link.kind = joint.kind, link.parent = joint.parent, link.coord = joint.coord;
  link.dof_count = dofs_of(joint.kind);
  link.rest = glm::mat3_cast(joint.parent_from_joint.q);
  link.axis = link.rest * joint.axis;
  link.origin_m = joint.parent_from_joint.p_m;
  link.along = link.rest * glm::outerProduct(joint.axis, joint.axis);
  link.across = link.rest - link.along;
  link.turned = link.rest * cross_matrix(joint.axis);
  link.mass_kg = joint.mass_kg, link.center_of_mass_m = joint.center_of_mass_m;
  link.inertia_kg_m2 = joint.inertia_kg_m2;
  link.massless = joint.mass_kg == 0.0 && joint.inertia_kg_m2 == Mat3(0.0);
  return link;
}

}  // namespace

Multibody Multibody::of(const Character& character) {
  Multibody body;
  body.coord_count_ = character.coord_count();
  for (const Joint& joint : character.joints()) {
    Link link = link_of(joint);
    link.dof = body.dof_count();
    // The root's six hang on one another, a joint's first one on the last of its parent's.
    int before = -1;
    if (link.parent >= 0) {
      const Link& parent = body.links_[static_cast<std::size_t>(link.parent)];
      before = parent.dof + parent.dof_count - 1;
    }
    for (int i = 0; i < link.dof_count; ++i) {
      body.parent_dof_.push_back(before);
      before = link.dof + i;
    }
    body.mass_kg_ += joint.mass_kg;
    body.links_.push_back(link);
  }
  return body;
}

}  // namespace contort
