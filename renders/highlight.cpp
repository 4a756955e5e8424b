#include "renders/highlight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "model/core/index.h"

namespace contort {
namespace {

constexpr std::string_view kBetween = " ~ ";

// The colliders of the body or collider of this name; empty if there is none.
std::vector<int> find_solid(const Character& character, std::string_view name) {
  std::vector<int> colliders;
  for (const Body& body : character.bodies())
    if (body.name == name)
      for (int i = 0; i < body.collider_count; ++i) colliders.push_back(body.first_collider + i);
  if (!colliders.empty()) return colliders;
  const int collider = character.find_collider(name);
  return collider < 0 ? colliders : std::vector<int>{collider};
}

bool find_pair(const Character& character, std::string_view subject, Highlight& into) {
  for (std::size_t cut = subject.find(kBetween); cut != subject.npos; cut = subject.find(kBetween, cut + 1)) {
    std::vector<int> a = find_solid(character, subject.substr(0, cut));
    std::vector<int> b = find_solid(character, subject.substr(cut + kBetween.size()));
    if (a.empty() || b.empty()) continue;
    into.solids = {std::move(a), std::move(b)};
    return true;
  }
  return false;
}

bool find_one(const Character& character, std::string_view name, Highlight& into) {
  if (const int joint = character.find_joint(name); joint >= 0) {
    into.joints = {joint};
  } else if (std::vector<int> solid = find_solid(character, name); !solid.empty()) {
    into.solids = {std::move(solid)};
  } else if (const int socket = character.find_socket(name); socket >= 0) {
    into.joints = {character.sockets()[at(socket)].joint};
  } else if (const int part = character.find_part(name); part >= 0) {
    const Part& p = character.parts()[at(part)];
    for (int j = 0; j < p.joint_count; ++j) into.joints.push_back(p.first_joint + j);
  }
  return !into.empty();
}

double distance_to(const Sphere& s, const Vec3& p) { return glm::length(p - s.center_m) - s.radius_m; }

double distance_to(const Capsule& c, const Vec3& p) {
  const Vec3 ab = c.b_m - c.a_m;
  const double length2 = glm::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - c.a_m, ab) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - (c.a_m + t * ab)) - c.radius_m;
}

double distance_to(const Box& b, const Vec3& p) {
  const Quat q = from_rotation_vector(b.rotation_deg * kRadPerDeg);
  const Vec3 outside = glm::abs(glm::conjugate(q) * (p - b.center_m)) - b.half_m;
  const double inside = std::min(0.0, std::max({outside.x, outside.y, outside.z}));
  return glm::length(glm::max(outside, Vec3(0.0))) + inside;
}

double distance_to(const ConvexHull& hull, const Vec3& p) {
  return nearest_on(convex_polyhedron(hull.points_m), p).distance_m;
}

Vec3 center_of(const Sphere& s) { return s.center_m; }
Vec3 center_of(const Capsule& c) { return 0.5 * (c.a_m + c.b_m); }
Vec3 center_of(const Box& b) { return b.center_m; }
Vec3 center_of(const ConvexHull& hull) { return convex_polyhedron(hull.points_m).center_m; }
Vec3 center_of(const TriangleMesh& m) {
  Vec3 sum(0.0);
  for (const Vec3& p : m.positions_m) sum += p;
  return m.positions_m.empty() ? sum : sum / static_cast<double>(m.positions_m.size());
}

// Index of the collider that moves with the piece's joint and has its shape, or is nearest to its centre; -1 if none.
int collider_of(const Character& character, const MeshPiece& piece) {
  const Vec3 center = std::visit([](const auto& shape) { return center_of(shape); }, piece.shape);
  int nearest = -1;
  double smallest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < character.colliders().size(); ++i) {
    const Collider& collider = character.colliders()[i];
    if (collider.joint != piece.joint) continue;
    if (looks_like(piece, collider)) return static_cast<int>(i);
    const double d_m = std::visit([&](const auto& shape) { return distance_to(shape, center); }, collider.shape);
    if (d_m >= smallest_m) continue;
    smallest_m = d_m;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

bool is_of_object(const Collider& collider) { return collider.name.starts_with("object:"); }

// Returns the joint itself if it has a mesh, otherwise the nearest joints below it that have one.
std::vector<bool> nearest_with(const std::vector<bool>& has_mesh, const Character& character, int joint) {
  std::vector<bool> searched(has_mesh.size(), false), found(has_mesh.size(), false);
  searched[at(joint)] = true;
  for (std::size_t j = at(joint); j < has_mesh.size(); ++j) {
    const int parent = character.joints()[j].parent;
    if (parent >= 0 && searched[at(parent)] && !found[at(parent)]) searched[j] = true;
    found[j] = searched[j] && has_mesh[j];
  }
  return found;
}

}  // namespace

bool is_of_object(const Character& character, const MeshPiece& piece) {
  const int collider = collider_of(character, piece);
  return collider >= 0 && is_of_object(character.colliders()[at(collider)]);
}

bool looks_like(const MeshPiece& piece, const Collider& collider) {
  if (piece.joint != collider.joint) return false;
  return std::visit([&](const auto& shape) { return piece.shape == MeshShape(shape); }, collider.shape);
}

Highlight highlighted(const Character& character, const Finding& finding) {
  Highlight result;
  const std::string_view subject = finding.subject;
  if (find_pair(character, subject, result)) return result;
  std::string_view name = subject;
  while (!name.empty() && !find_one(character, name, result)) {
    const std::size_t space = name.rfind(' ');
    name = space == name.npos ? std::string_view() : name.substr(0, space);
  }
  return result;
}

std::vector<int> highlight_groups(const Character& character, const Highlight& highlight) {
  const auto mesh = character.mesh();
  std::vector<int> groups(mesh.size(), 0);
  int group = 0;
  for (const std::vector<int>& solid : highlight.solids) {
    ++group;
    for (std::size_t i = 0; i < mesh.size(); ++i)
      if (std::find(solid.begin(), solid.end(), collider_of(character, mesh[i])) != solid.end()) groups[i] = group;
  }
  ++group;
  std::vector<bool> has_mesh(character.joints().size(), false);
  for (const MeshPiece& piece : mesh) has_mesh[at(piece.joint)] = true;
  for (const int joint : highlight.joints) {
    const std::vector<bool> moved = nearest_with(has_mesh, character, joint);
    for (std::size_t i = 0; i < mesh.size(); ++i)
      if (moved[at(mesh[i].joint)]) groups[i] = group;
  }
  return groups;
}

std::vector<int> highlight_groups_of_joints(const Character& character, const Highlight& highlight,
                                            const std::vector<bool>& moved) {
  std::vector<int> groups(character.joints().size(), 0);
  int group = 0;
  for (const std::vector<int>& solid : highlight.solids) {
    ++group;
    for (const int index : solid)
      if (const Collider& collider = character.colliders()[at(index)]; !is_of_object(collider))
        groups[at(collider.joint)] = group;
  }
  ++group;
  for (const int joint : highlight.joints) {
    const std::vector<bool> nearest = nearest_with(moved, character, joint);
    for (std::size_t j = 0; j < groups.size(); ++j)
      if (nearest[j]) groups[j] = group;
  }
  return groups;
}

}  // namespace contort
