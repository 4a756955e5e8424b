// The surroundings that a spec describes. Plain values; build_environment (environment.h) checks them.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "model/character/shape.h"

namespace contort {

// Headings are about +Y: 0 is +Z, 90 is +X.
struct PlaneGround {
  double height_m = 0.0;
  bool operator==(const PlaneGround&) const = default;
};

struct SlopeGround {  // Height 0 at the origin.
  double slope_deg = 10.0;
  double heading_deg = 0.0;  // The direction in which it rises.
  bool operator==(const SlopeGround&) const = default;
};

struct StepsGround {  // A flight of steps up; level before and behind it.
  double heading_deg = 0.0;
  double start_m = 1.0;  // Position of the first riser along the heading.
  double depth_m = 0.3;  // The depth of a tread.
  double height_m = 0.15;
  int count = 5;
  bool operator==(const StepsGround&) const = default;
};

// Heights on a square grid centred on the origin, bilinear in between. Beyond the edges, heights stay the same.
struct HeightGround {
  int columns = 2;     // along +X
  int rows = 2;        // along +Z
  double spacing_m = 1.0;
  std::vector<double> heights_m = {0.0, 0.0, 0.0, 0.0};  // row by row
  bool operator==(const HeightGround&) const = default;
};

using Ground = std::variant<PlaneGround, SlopeGround, StepsGround, HeightGround>;

struct ObstacleDesc {
  std::string name;
  ColliderShape shape;
  bool operator==(const ObstacleDesc&) const = default;
};

struct EnvironmentDesc {
  Vec3 position_m{0.0};      // Position of the environment's origin: ground and obstacles move together.
  double heading_deg = 0.0;  // Its rotation about +Y.
  Ground ground;
  std::vector<ObstacleDesc> obstacles;
  bool operator==(const EnvironmentDesc&) const = default;
};

}  // namespace contort
