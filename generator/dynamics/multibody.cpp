#include "generator/dynamics/multibody.h"

#include <cmath>

namespace contort {

namespace {

void find_turn(const Vec3& axis, Link& link) {
  for (int k = 0; k < 3; ++k)
    if (std::fabs(axis[k]) == 1.0) link.turns_about = k, link.sense = axis[k];
}

Link link_of(const Joint& joint) {
  Link link;
  link.kind = joint.kind, link.parent = joint.parent, link.coord = joint.coord;
  link.dof_count = freedom_count(joint.kind);
  link.rest = glm::mat3_cast(joint.parent_from_joint.q);
  link.axis = link.rest * joint.axis;
  link.origin_m = joint.parent_from_joint.p_m;
  link.is_straight = link.rest == Mat3(1.0);
  if (joint.kind == JointKind::hinge) find_turn(joint.axis, link);
  link.mass_kg = joint.mass_kg, link.center_of_mass_m = joint.center_of_mass_m;
  link.inertia_kg_m2 = joint.inertia_kg_m2, link.inertia_root = lower_root(joint.inertia_kg_m2);
  link.massless = joint.mass_kg == 0.0 && joint.inertia_kg_m2 == Mat3(0.0);
  return link;
}

// m (d.d 1 - d d^T): what a mass adds to the inertia about a point that is d away (parallel axes).
Mat3 moved_inertia(double mass_kg, const Vec3& d) {
  return mass_kg * (glm::dot(d, d) * Mat3(1.0) - glm::outerProduct(d, d));
}

}  // namespace

Mat3 lower_root(const Mat3& matrix) {
  Mat3 left = matrix, root(0.0);
  for (int k = 0; k < 3; ++k) {
    if (!(left[k][k] > 0.0)) continue;  // of a rod or a point
    for (int i = k; i < 3; ++i) root[k][i] = left[k][i] / std::sqrt(left[k][k]);
    left -= glm::outerProduct(root[k], root[k]);
  }
  return root;
}

void Multibody::add_mass(int link, double mass_kg, const Vec3& center_of_mass_m, const Mat3& inertia_kg_m2) {
  Link& own = links_[static_cast<std::size_t>(link)];
  const double sum_kg = own.mass_kg + mass_kg;
  if (!(sum_kg > 0.0)) return;
  const Vec3 center = (own.mass_kg * own.center_of_mass_m + mass_kg * center_of_mass_m) / sum_kg;
  own.inertia_kg_m2 += moved_inertia(own.mass_kg, own.center_of_mass_m - center) + inertia_kg_m2 +
                       moved_inertia(mass_kg, center_of_mass_m - center);
  own.inertia_root = lower_root(own.inertia_kg_m2);
  own.mass_kg = sum_kg, own.center_of_mass_m = center, own.massless = false;
  mass_kg_ += mass_kg;
}

namespace {

int last_dof(const Link& link) { return link.dof + link.dof_count - 1; }

}  // namespace

Multibody Multibody::of(const Character& character) {
  Multibody body;
  body.coord_count_ = character.coord_count();
  for (const Joint& joint : character.joints()) {
    Link link = link_of(joint);
    link.dof = body.dof_count();
    // The root's six hang on one another, a joint's first one on the last of its parent's.
    int before = link.parent >= 0 ? last_dof(body.links_[static_cast<std::size_t>(link.parent)]) : -1;
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
