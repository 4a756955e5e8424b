// Field lists (json_fields.h) of shapes. Included from .cpp files only.
#pragma once

#include "model/character/shape.h"
#include "model/core/json_fields.h"

namespace contort {

inline constexpr double kMaxLength_m = 100.0;
inline const json_fields::Rule kPoint{.low = -kMaxLength_m, .high = kMaxLength_m};
inline const json_fields::Rule kRadius{.low = 1e-4, .high = kMaxLength_m, .required = true};
inline const json_fields::Rule kRotation{.low = -360, .high = 360};

constexpr std::string_view type_name(const Sphere*) { return "sphere"; }
constexpr std::string_view type_name(const Capsule*) { return "capsule"; }
constexpr std::string_view type_name(const Box*) { return "box"; }
constexpr std::string_view type_name(const ConvexHull*) { return "hull"; }
constexpr std::string_view type_name(const TriangleMesh*) { return "triangles"; }

template <class V>
void fields(V& v, const Sphere*) {
  v.constant("type", "sphere");
  v.field("center_m", &Sphere::center_m, kPoint, "Centre, in the joint's frame.");
  v.field("radius_m", &Sphere::radius_m, kRadius, "Radius.");
}

template <class V>
void fields(V& v, const Capsule*) {
  v.constant("type", "capsule");
  v.field("a_m", &Capsule::a_m, kPoint, "One end of the axis, in the joint's frame.");
  v.field("b_m", &Capsule::b_m, kPoint, "The other end.");
  v.field("radius_m", &Capsule::radius_m, kRadius, "Radius.");
}

template <class V>
void fields(V& v, const Box*) {
  v.constant("type", "box");
  v.field("center_m", &Box::center_m, kPoint, "Centre, in the joint's frame.");
  v.field("half_m", &Box::half_m, kRadius, "Half of each side.");
  v.field("rotation_deg", &Box::rotation_deg, kRotation, "Rotation vector (axis times angle).");
}

template <class V>
void fields(V& v, const ConvexHull*) {
  v.constant("type", "hull");
  v.field("points_m", &ConvexHull::points_m,
          {.low = -kMaxLength_m, .high = kMaxLength_m, .max_count = kMaxHullPoints, .required = true},
          "Points, in the joint's frame: at least four that are not in one plane. The solid is their convex hull.");
}

template <class V>
void fields(V& v, const TriangleMesh*) {
  v.constant("type", "triangles");
  v.field("positions_m", &TriangleMesh::positions_m, {.low = -kMaxLength_m, .high = kMaxLength_m, .max_count = 100000},
          "Vertices, in the joint's frame.");
  v.field("indices", &TriangleMesh::indices, {.low = 0, .high = 99999, .max_count = 300000},
          "Three vertex indices to a triangle, counter-clockwise seen from outside.");
}

}  // namespace contort
