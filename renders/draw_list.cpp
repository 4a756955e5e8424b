#include "renders/draw_list.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"
#include "model/geometry/distance.h"
#include "model/motion/kinematics.h"
#include "renders/wires.h"

namespace contort {
namespace {

constexpr Vec3 kHighlightColor{0.80, 0.035, 0.03};
// Colour of the second solid of a pair: with red on red, the two could not be told apart.
constexpr Vec3 kSecondColor{0.86, 0.20, 0.02};
constexpr Vec3 kSkinColor{0.33, 0.37, 0.42};
constexpr Vec3 kPaleColor{0.80, 0.80, 0.79};
constexpr double kMarkerRadius_m = 0.038;
constexpr double kWire = 0.0016;  // radius, as a fraction of the figure's size: about a pixel of a strip's tile

Vec3 muted(const Vec3& color) {
  const double grey = glm::dot(color, Vec3(0.2126, 0.7152, 0.0722));
  return glm::mix(Vec3(0.26 + 0.6 * grey), color, 0.3);
}

Vec3 color_of(int group) { return group == 2 ? kSecondColor : kHighlightColor; }

int add_mesh(Figure& figure, const MeshShape& shape) {
  figure.meshes.push_back(tessellate(shape));
  return static_cast<int>(figure.meshes.size()) - 1;
}

void add_mesh_pieces(Figure& figure, const Character& character, const Highlight& highlight, bool wears_skin) {
  const std::vector<int> groups = highlight_groups(character, highlight);
  for (std::size_t i = 0; i < character.mesh().size(); ++i) {
    const MeshPiece& piece = character.mesh()[i];
    if (wears_skin && !is_of_object(character, piece)) continue;
    const Vec3 color = groups[i] > 0 ? color_of(groups[i]) : highlight.empty() ? piece.color : muted(piece.color);
    figure.pieces.push_back({add_mesh(figure, piece.shape), piece.joint, color, groups[i]});
  }
}

bool drawn_as_it_is(const Character& character, const Collider& collider, bool wears_skin) {
  return std::any_of(character.mesh().begin(), character.mesh().end(), [&](const MeshPiece& piece) {
    return looks_like(piece, collider) && !(wears_skin && !is_of_object(character, piece));
  });
}

// Checks judge the colliders. If a mesh differs from its collider, two parts that look separate may overlap.
void add_judged_shapes(Figure& figure, const Character& character, const Highlight& highlight, bool wears_skin) {
  int group = 0;
  for (const std::vector<int>& solid : highlight.solids) {
    ++group;
    const bool has_mesh = wears_skin || std::any_of(figure.pieces.begin(), figure.pieces.end(),
                                                    [&](const FigurePiece& piece) { return piece.highlight == group; });
    for (const int index : solid) {
      const Collider& collider = character.colliders()[at(index)];
      if (drawn_as_it_is(character, collider, wears_skin)) continue;
      figure.pieces.push_back(
          {add_mesh(figure, as_mesh(collider.shape)), collider.joint, color_of(group), group, has_mesh});
    }
  }
}

void add_joint_markers(Figure& figure, const Highlight& highlight) {
  if (highlight.joints.empty()) return;
  const int marker = add_mesh(figure, Sphere{Vec3(0.0), kMarkerRadius_m});
  const int group = static_cast<int>(highlight.solids.size()) + 1;
  for (const int joint : highlight.joints) figure.pieces.push_back({marker, joint, kMarkerColor, group});
}

bool within_reach(const Rigid& place) {
  const double values[] = {place.p_m.x, place.p_m.y, place.p_m.z, place.q.w, place.q.x, place.q.y, place.q.z};
  return std::all_of(std::begin(values), std::end(values),
                     [](double value) { return std::fabs(value) <= kWorldReach_m; });  // false for NaN
}

void grow_box(const Triangles& triangles, Vec3& low, Vec3& high) {
  for (const Vec3& p : triangles.positions_m) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
}

}  // namespace

Figure make_figure(const Character& character, const Highlight& highlight, bool wears_skin) {
  Figure figure;
  add_mesh_pieces(figure, character, highlight, wears_skin);
  add_judged_shapes(figure, character, highlight, wears_skin);
  add_joint_markers(figure, highlight);
  return figure;
}

void add_wires(const Character& character, Figure& figure) {
  const double radius_m = kWire * figure_size_m(character);
  for (const Collider& collider : character.colliders()) {
    figure.meshes.push_back(wire_triangles(collider.shape, radius_m));
    figure.pieces.push_back({.mesh = static_cast<int>(figure.meshes.size()) - 1,
                             .joint = collider.joint,
                             .color = kWireColor,
                             .mark = true});
  }
}

double figure_size_m(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  Vec3 low(1e9), high(-1e9);
  for (const Collider& collider : character.colliders()) {
    const Solid solid = moved(world[at(collider.joint)], solid_of(collider));
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 along(axis == 0, axis == 1, axis == 2);
      low[axis] = std::min(low[axis], solid.center_m[axis] - extent_along(solid, -along));
      high[axis] = std::max(high[axis], solid.center_m[axis] + extent_along(solid, along));
    }
  }
  return character.colliders().empty() ? 1.0 : glm::length(high - low);
}

void add_instance(DrawList& list, const DrawInstance& instance) {
  if (within_reach(instance.world_from_mesh))
    list.instances.push_back(instance);
  else
    list.complete = false;
}

Vec3 skin_color(int group, bool any_highlight) {
  return group > 0 ? color_of(group) : any_highlight ? muted(kSkinColor) : kSkinColor;
}

Vec3 color_in(Look look, const Vec3& color, int highlight) {
  if (look == Look::ghost) return kGhostColor;
  return look == Look::pale && highlight == 0 ? kPaleColor : color;
}

void add_figure(DrawList& list, const Figure& figure, std::span<const Rigid> world, Look look) {
  for (const FigurePiece& piece : figure.pieces) {
    const Rigid& at_joint = world[at(piece.joint)];
    if (look != Look::ghost)
      add_instance(list, {.mesh = piece.mesh,
                          .world_from_mesh = at_joint,
                          .color = piece.mark ? piece.color : color_in(look, piece.color, piece.highlight),
                          .highlight = piece.highlight,
                          .ghost = piece.ghost,
                          .mark = piece.mark});
    else if (!piece.ghost && !piece.mark)
      add_instance(list, {piece.mesh, at_joint, color_in(look, piece.color, 0), 0, true});
  }
}

std::vector<Vec3> outline(const DrawList& list, std::span<const Triangles> meshes) {
  std::vector<Vec3> corners;
  for (const DrawInstance& instance : list.instances) {
    const Triangles& mesh = meshes[at(instance.mesh)];
    if (mesh.positions_m.empty()) continue;
    Vec3 low = mesh.positions_m.front(), high = low;
    grow_box(mesh, low, high);
    for (int corner = 0; corner < 8; ++corner)
      corners.push_back(instance.world_from_mesh *
                        Vec3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z));
  }
  return corners;
}

}  // namespace contort
