#include "import/bodies.h"

#include <algorithm>
#include <limits>
#include <map>

#include "import/fit.h"
#include "import/limits.h"
#include "import/roles.h"

namespace contort {

namespace {

constexpr double kLeastRadius = 0.006;  // as a fraction of the figure's greatest extent
constexpr double kDensity_kg_m3 = 1000.0;
constexpr double kHumanHeight_m = 3.0;  // the mass of a taller humanoid follows from its volume
constexpr double kMassByHeight = 24.1;  // kg/m^2: 73 kg at 1.741 m
constexpr double kLeastMass_kg = 1e-3;  // smallest mass of a body; with less it would count as a massless link

// The smallest radius of a body. It is never 0, even for a flat figure, because bodies have volume and mass.
double least_radius_m(const RiggedFigure& figure) {
  double size = figure.height_m;
  for (const Bone& bone : figure.bones) {
    size = std::max(size, length(bone.position_m));
    if (!bone.points_m.empty()) size = std::max(size, length(bone.points_m.front()));
  }
  return std::max(kLeastRadius * size, 1e-3);
}

// The box around a foot. Its lower face is the sole that stands on the ground (motion/legs.h).
Box sole_box(const RiggedFigure& figure, const Bone& bone) {
  Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& p : bone.points_m) low = glm::min(low, p), high = glm::max(high, p);
  const Vec3 half = glm::max(0.5 * (high - low), Vec3(least_radius_m(figure)));
  return {0.5 * (high + low), half, Vec3(0.0)};
}

bool is_flat_foot(const RiggedFigure& figure, int bone) {
  const Bone& own = bone_at(figure, bone);
  if (own.points_m.empty() || !is_sole_bone(figure, bone)) return false;
  const Box box = sole_box(figure, own);
  return box.half_m.y < std::max(box.half_m.x, box.half_m.z);
}

// The segment whose mass fraction applies to a role: P. de Leva, J. Biomechanics 29(9), 1996, for men; both sides of a
// limb together.
BoneRole segment_of(BoneRole role) {
  switch (role) {
    case BoneRole::head:
    case BoneRole::neck: return BoneRole::head;
    case BoneRole::upper_arm:
    case BoneRole::forearm:
    case BoneRole::thigh:
    case BoneRole::shank: return role;
    case BoneRole::hand:
    case BoneRole::finger: return BoneRole::hand;
    case BoneRole::foot:
    case BoneRole::toe: return BoneRole::foot;
    default: return BoneRole::root;
  }
}
double share_of(BoneRole segment) {
  switch (segment) {
    case BoneRole::head: return 0.0694;
    case BoneRole::upper_arm: return 2 * 0.0271;
    case BoneRole::forearm: return 2 * 0.0162;
    case BoneRole::hand: return 2 * 0.0061;
    case BoneRole::thigh: return 2 * 0.1416;
    case BoneRole::shank: return 2 * 0.0433;
    case BoneRole::foot: return 2 * 0.0137;
    default: return 0.4346;
  }
}

BodyInertia weighed(const BoneBody& body, double mass_kg) {
  BodyInertia sum;
  for (const ColliderShape& shape : body.shapes) {
    BodyInertia piece;
    if (const auto* capsule = std::get_if<Capsule>(&shape))
      piece = inertia_of(*capsule, mass_kg * contort::volume_m3(*capsule) / body.volume_m3);
    else if (const auto* box = std::get_if<Box>(&shape))
      piece = inertia_of(*box, mass_kg * contort::volume_m3(*box) / body.volume_m3);
    sum = sum.mass_kg > 0.0 ? merged(sum, piece) : piece;
  }
  return sum;
}

}  // namespace

std::vector<BoneBody> fit_bodies(const RiggedFigure& figure) {
  const double least_m = least_radius_m(figure);
  std::vector<BoneBody> out(figure.bones.size());
  for (std::size_t b = 0; b < figure.bones.size(); ++b) {
    const int index = static_cast<int>(b);
    const Bone& bone = figure.bones[b];
    BoneBody& body = out[b];
    if (is_flat_foot(figure, index)) {
      body.shapes.emplace_back(sole_box(figure, bone));
      body.volume_m3 = contort::volume_m3(sole_box(figure, bone));
      continue;
    }
    for (const Capsule& capsule : fit_capsules(bone.points_m, direction_of(figure, index), least_m)) {
      body.shapes.emplace_back(capsule);
      body.volume_m3 += contort::volume_m3(capsule);
    }
  }
  return out;
}

bool weighs_as_human(const RiggedFigure& figure) { return figure.is_humanoid && figure.height_m <= kHumanHeight_m; }

void weigh(const RiggedFigure& figure, std::vector<BoneBody>& bodies) {
  std::map<BoneRole, double> volume_of;
  for (std::size_t b = 0; b < bodies.size(); ++b) volume_of[segment_of(figure.bones[b].role)] += bodies[b].volume_m3;
  double shares = 0.0;  // mass fractions of the segments that the figure has
  for (const auto& [segment, volume] : volume_of) shares += volume > 0.0 ? share_of(segment) : 0.0;
  const double total_kg = kMassByHeight * figure.height_m * figure.height_m;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].shapes.empty()) continue;
    const BoneRole segment = segment_of(figure.bones[b].role);
    const double mass_kg = weighs_as_human(figure)
                               ? total_kg * share_of(segment) / shares * bodies[b].volume_m3 / volume_of[segment]
                               : kDensity_kg_m3 * bodies[b].volume_m3;
    bodies[b].inertia = weighed(bodies[b], std::clamp(mass_kg, kLeastMass_kg, 1e5));
  }
}

double lowest_of(const std::vector<ColliderShape>& shapes) {
  double low = std::numeric_limits<double>::infinity();
  for (const ColliderShape& shape : shapes) {
    if (const auto* c = std::get_if<Capsule>(&shape))
      low = std::min({low, c->a_m.y - c->radius_m, c->b_m.y - c->radius_m});
    if (const auto* b = std::get_if<Box>(&shape)) low = std::min(low, b->center_m.y - b->half_m.y);
  }
  return low;
}

}  // namespace contort
