#include "import/metres.h"

#include <algorithm>
#include <cmath>

#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr double kMostMetres = 90.0;  // greatest size of a figure, and greatest distance of a joint from the root

double largest_side(const Vec3& size) { return std::max({size.x, size.y, size.z}); }

// The horizontal direction from the figure's right to its left; 0 if the names do not show it.
Vec3 to_left(const RiggedFigure& figure) {
  Vec3 sum(0.0);
  int left = 0, right = 0;
  for (const Bone& bone : figure.bones) {
    left += bone.side == Side::left, right += bone.side == Side::right;
    if (bone.side != Side::center) sum += (bone.side == Side::left ? 1.0 : -1.0) * bone.position_m;
  }
  return left == right && left > 0 ? Vec3(sum.x, 0.0, sum.z) : Vec3(0.0);
}

// The direction from the feet to the upper legs; 0 if the names do not show it.
Vec3 up_along_legs(const RiggedFigure& figure) {
  Vec3 upper(0.0), lower(0.0);
  int uppers = 0, lowers = 0;
  for (const Bone& bone : figure.bones) {
    if (bone.side == Side::center) continue;
    if (bone.family == BoneFamily::thigh) upper += bone.position_m, ++uppers;
    if (bone.family == BoneFamily::foot || bone.family == BoneFamily::toe) lower += bone.position_m, ++lowers;
  }
  return uppers == 0 || lowers == 0 ? Vec3(0.0) : upper / (1.0 * uppers) - lower / (1.0 * lowers);
}

// The rotation, in quarter turns, that stands up a figure whose legs are level or point up.
Quat standing(RiggedFigure& figure) {
  const Vec3 up = up_along_legs(figure);
  if (!(length(up) > 0.0) || up.y > 0.5 * length(up)) return kNoRotation;
  const double half = std::sqrt(0.5);
  const bool is_level = std::max(std::fabs(up.x), std::fabs(up.z)) > 0.8 * length(up);
  if (!is_level && up.y > -0.8 * length(up)) return kNoRotation;
  figure.notes.push_back(is_level ? "The model lies: its legs are level, so it was stood up by a quarter turn."
                                  : "The model stands on its head: turned upside down.");
  if (!is_level) return {0.0, 1.0, 0.0, 0.0};
  if (std::fabs(up.z) >= std::fabs(up.x)) return {half, up.z > 0.0 ? -half : half, 0.0, 0.0};
  return {half, 0.0, 0.0, up.x > 0.0 ? half : -half};
}

// Rotates all data, which are still in the file's units.
ModelBox turn_figure(RiggedFigure& figure, const ModelBox& box, const Quat& turn) {
  if (turn == kNoRotation) return box;
  for (Bone& bone : figure.bones) {
    bone.position_m = turn * bone.position_m;
    for (Vec3& p : bone.points_m) p = turn * p;
  }
  ModelBox out;
  out.add(turn * box.low), out.add(turn * box.high);
  return out;
}

// Notes a height that is unusual for people. The mass of other figures follows from their volume, and models are often
// hollow.
void note_size(RiggedFigure& figure) {
  constexpr double kLeastPerson_m = 0.5, kGreatestPerson_m = 2.5, kGreatestModel_m = 4.0;
  int arms = 0;
  for (const Bone& bone : figure.bones)
    arms += bone.family == BoneFamily::hand || bone.family == BoneFamily::upper_arm || bone.family == BoneFamily::arm;
  const bool is_odd = figure.height_m > kGreatestModel_m ||
                      (arms >= 2 && (figure.height_m < kLeastPerson_m || figure.height_m > kGreatestPerson_m));
  if (is_odd)
    figure.notes.push_back("It is " + number_text(figure.height_m) +
                           " m high, which is unusual, and its weight grows with the cube of its height. --height-m "
                           "says how high it really is.");
}

// The rotation about the vertical, in quarter turns because models stand along the axes, that makes the figure face +Z.
Quat facing(RiggedFigure& figure, double size) {
  const Vec3 left = to_left(figure);
  if (length(left) < 1e-3 * size) {
    figure.notes.push_back("No names tell left from right: taken to face +Z, as glTF has it.");
    return kNoRotation;
  }
  if (std::fabs(left.x) >= std::fabs(left.z)) {
    if (left.x > 0.0) return kNoRotation;
    figure.notes.push_back("The model faces -Z: turned by half a turn.");
    return {0.0, 0.0, 1.0, 0.0};
  }
  figure.notes.push_back("The model stands sideways: turned by a quarter.");
  const double half = std::sqrt(0.5);
  return {half, 0.0, left.z > 0.0 ? half : -half, 0.0};
}

// Returns 1 for sizes that figures may have in metres; otherwise the power of ten that brings them into that range.
double guessed_scale(RiggedFigure& figure, double largest) {
  double scale = 1.0;
  if (largest >= 0.2 && largest <= 30.0) return scale;
  while (largest * scale > 5.0) scale /= 10.0;
  while (largest * scale < 0.5) scale *= 10.0;
  figure.notes.push_back("The model's largest side is " + number_text(largest) +
                         " units, which are hardly metres: scaled by " + number_text(scale) +
                         ". Use --scale or --height-m if that is wrong.");
  return scale;
}

double scale_of(RiggedFigure& figure, const Vec3& size, const ImportOptions& options) {
  const double largest = largest_side(size);
  if (options.metres_per_unit > 0.0) return options.metres_per_unit;
  if (options.height_m > 0.0) return options.height_m / std::max(size.y, 1e-6 * largest);
  return guessed_scale(figure, largest);
}

Result<Done> round_to_lattice(Bone& bone) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::fabs(bone.position_m[i]) <= kMostMetres))
      return Issue{"import.too_large", "/nodes/" + std::to_string(bone.node), "the joint lies 90 m from the root"};
    bone.position_m[i] = on_lattice(bone.position_m[i], 1e5);
  }
  return Done{};
}

}  // namespace

Result<Done> to_metres(RiggedFigure& figure, const ModelBox& model_box, const ImportOptions& options) {
  const double largest = largest_side(model_box.size());
  if (!(largest > 1e-9)) return Issue{"import.flat", "/meshes", "all vertices lie in one point"};
  const Quat stood_up = standing(figure);
  const ModelBox box = turn_figure(figure, model_box, stood_up);
  const double scale = scale_of(figure, box.size(), options);
  if (!(scale * largest <= kMostMetres))
    return Issue{"import.too_large", "", "the figure would be larger than 90 m; --scale and --height-m change that"};
  const Vec3 origin = figure.bones.front().position_m;
  figure.metres_per_unit = scale;
  const Quat faces = facing(figure, largest);
  figure.world_from_model = faces * stood_up;
  figure.height_m = scale * box.size().y;
  figure.ground_m = scale * (box.low.y - origin.y);
  for (Bone& bone : figure.bones) {
    for (Vec3& p : bone.points_m) p = faces * (scale * (p - bone.position_m));
    bone.position_m = faces * (scale * (bone.position_m - origin));
    if (const Result<Done> fits = round_to_lattice(bone); !fits) return fits.issue();
  }
  if (options.height_m == 0.0 && options.metres_per_unit == 0.0) note_size(figure);
  return Done{};
}

}  // namespace contort
