// Field lists (json_fields.h) of the environment. Included from .cpp files only.
#pragma once

#include "model/character/shape_fields.h"
#include "model/world/environment_desc.h"

namespace contort {

constexpr std::string_view type_name(const PlaneGround*) { return "plane"; }
constexpr std::string_view type_name(const SlopeGround*) { return "slope"; }
constexpr std::string_view type_name(const StepsGround*) { return "steps"; }
constexpr std::string_view type_name(const HeightGround*) { return "heights"; }

template <class V>
void fields(V& v, const PlaneGround*) {
  v.constant("type", "plane");
  v.field("height_m", &PlaneGround::height_m, kPoint, "Height of the plane.");
}

template <class V>
void fields(V& v, const SlopeGround*) {
  v.constant("type", "slope");
  v.field("slope_deg", &SlopeGround::slope_deg, {.low = 0, .high = 60}, "Angle of the slope.");
  v.field("heading_deg", &SlopeGround::heading_deg, kRotation,
          "Direction in which the ground rises: 0 is +Z, 90 is +X.");
}

template <class V>
void fields(V& v, const StepsGround*) {
  v.constant("type", "steps");
  v.field("heading_deg", &StepsGround::heading_deg, kRotation, "Direction in which the steps rise: 0 is +Z, 90 is +X.");
  v.field("start_m", &StepsGround::start_m, kPoint, "Distance of the first riser from the origin.");
  v.field("depth_m", &StepsGround::depth_m, {.low = 0.05, .high = 100}, "Depth of a tread.");
  v.field("height_m", &StepsGround::height_m, {.low = 0, .high = 10}, "Height of a riser.");
  v.field("count", &StepsGround::count, {.low = 1, .high = 1000}, "Number of steps.");
}

template <class V>
void fields(V& v, const HeightGround*) {
  v.constant("type", "heights");
  v.field("columns", &HeightGround::columns, {.low = 1, .high = 256}, "Number of points along +X.");
  v.field("rows", &HeightGround::rows, {.low = 1, .high = 256}, "Number of points along +Z.");
  v.field("spacing_m", &HeightGround::spacing_m, {.low = 0.01, .high = 100}, "Distance between neighbouring points.");
  v.field("heights_m", &HeightGround::heights_m, {.low = -100, .high = 100, .max_count = 65536},
          "Heights of the points, row by row.");
}

template <class V>
void fields(V& v, const ObstacleDesc*) {
  v.field("name", &ObstacleDesc::name, {.required = true}, "Name, unique in the environment.");
  v.field("shape", &ObstacleDesc::shape, {.required = true}, "Shape of the solid.");
}

template <class V>
void fields(V& v, const EnvironmentDesc*) {
  v.field("position_m", &EnvironmentDesc::position_m, {.low = -1000, .high = 1000},
          "Position of the environment's origin.");
  v.field("heading_deg", &EnvironmentDesc::heading_deg, kRotation, "Rotation of the whole environment about +Y.");
  v.field("ground", &EnvironmentDesc::ground, {}, "A plane, slope, flight of steps, or grid of heights.");
  v.field("obstacles", &EnvironmentDesc::obstacles, {.max_count = 256}, "Solids beside the ground.");
}

}  // namespace contort
