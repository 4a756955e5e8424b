#include "import/asf_skeleton.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "import/names.h"
#include "model/core/index.h"
#include "model/core/number_text.h"

namespace contort {

namespace {

constexpr double kMetresPerInch = 0.0254;
// Sizes by the file's unit; for other sizes the unit is not inches.
constexpr double kLeastFigure_m = 0.5, kGreatestFigure_m = 3.0;
constexpr double kLeastSide_m = 0.2, kGreatestSide_m = 30.0;       // as for models
constexpr double kMassOfHeight_kg_m2 = 24.1, kCapsuleDensity_kg_m3 = 1000.0;
constexpr double kOtherThickness = 0.15;  // thickness of a bone without a known name, as a fraction of its length
constexpr double kShortestBone = 0.002;  // as a fraction of the height: shorter bones have no capsule

// Radii of human bodies as fractions of their height. They are those of slender people, so that a collision is a fault.
double radius_share(BoneFamily family) {
  switch (family) {
    case BoneFamily::hips:
    case BoneFamily::spine: return 0.06;
    case BoneFamily::neck: return 0.03;
    case BoneFamily::head: return 0.05;
    case BoneFamily::thigh:
    case BoneFamily::leg: return 0.033;
    case BoneFamily::shank: return 0.024;
    case BoneFamily::clavicle:
    case BoneFamily::upper_arm:
    case BoneFamily::arm: return 0.025;
    case BoneFamily::foot:
    case BoneFamily::forearm: return 0.02;
    case BoneFamily::hand:
    case BoneFamily::toe: return 0.015;
    case BoneFamily::finger: return 0.006;
    default: return 0.0;
  }
}

// Converts from a character's axes (+Y up, +Z forward), which this file uses, to a robot's (+Z up, +X forward).
Vec3 in_robot_axes(const Vec3& v) { return {v.z, v.x, v.y}; }

// Positions of the ends of all bones at rest, in the file's unit.
std::vector<Vec3> ends_at_rest(const AsfSkeleton& skeleton) {
  std::vector<Vec3> ends(skeleton.bones.size(), Vec3(0.0));
  for (const int bone : skeleton.order) {
    const AsfBone& own = skeleton.bones[at(bone)];
    if (own.parent >= 0) ends[at(bone)] = ends[at(own.parent)] + own.direction * own.length;
  }
  return ends;
}

struct Extent {
  double height = 0.0;
  double largest = 0.0;
};

Extent extent_of(const AsfSkeleton& skeleton) {
  Vec3 low(0.0), high(0.0);
  for (const Vec3& end : ends_at_rest(skeleton)) low = glm::min(low, end), high = glm::max(high, end);
  const Vec3 size = high - low;
  return {size.y, std::max({size.x, size.y, size.z})};
}

double metres_of_unit(const AsfSkeleton& skeleton, const Extent& extent, const ImportOptions& options) {
  if (options.metres_per_unit > 0.0) return options.metres_per_unit;
  if (options.height_m > 0.0 && extent.height > 0.0) return options.height_m / extent.height;
  const double inches = kMetresPerInch / skeleton.length_unit;
  if (extent.largest * inches >= kLeastFigure_m && extent.largest * inches <= kGreatestFigure_m) return inches;
  double metres = 1.0;
  for (int i = 0; i < 400 && extent.largest * metres > kGreatestSide_m; ++i) metres *= 0.1;
  for (int i = 0; i < 400 && extent.largest > 0.0 && extent.largest * metres < kLeastSide_m; ++i) metres *= 10.0;
  return metres;
}

double volume_of_bone(const Capsule& capsule) {
  const double r = capsule.radius_m, area = std::numbers::pi * r * r;
  return area * (length(capsule.b_m - capsule.a_m) + 4.0 / 3.0 * r);
}

// The inertia of a cylinder with the capsule's whole length. This is as exact as the data about human limbs.
BodyInertia inertia_of_bone(const Capsule& capsule, double mass_kg) {
  const double r = capsule.radius_m, whole = length(capsule.b_m - capsule.a_m) + 2.0 * r;
  const Vec3 along = glm::normalize(capsule.b_m - capsule.a_m);
  const double axial = 0.5 * mass_kg * r * r, across = mass_kg * (3.0 * r * r + whole * whole) / 12.0;
  BodyInertia out{mass_kg, 0.5 * (capsule.a_m + capsule.b_m), Mat3(across)};
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) out.inertia_kg_m2[column][row] += (axial - across) * along[column] * along[row];
  return out;
}

class AsfRobot {
 public:
  AsfRobot(const AsfSkeleton& skeleton, const ImportOptions& options)
      : skeleton_(skeleton), extent_(extent_of(skeleton)), metres_(metres_of_unit(skeleton, extent_, options)) {}

  RobotModel make() {
    out_.name = skeleton_.name;
    out_.has_free_root = out_.is_skeleton = true;
    body_of_.assign(skeleton_.bones.size(), -1);
    for (const int bone : skeleton_.order) add_bone(bone);
    set_masses();
    out_.notes.push_back("Lengths are metres at " + number_text(metres_) + " m in a unit of the file: the figure is " +
                         number_text(extent_.height * metres_) + " m high (--scale and --height-m say otherwise).");
    note_all(out_, "The length of bones may change in the file, and is kept in the character", stretching_);
    out_.notes.push_back("Capsules are guessed from the lengths and names of bones, and masses from the capsules.");
    return std::move(out_);
  }

 private:
  void add_bone(int index) {
    const AsfBone& bone = skeleton_.bones[at(index)];
    RobotBody body{.name = bone.name};
    body_of_[at(index)] = static_cast<int>(out_.bodies.size());
    if (bone.parent >= 0) {
      const AsfBone& above = skeleton_.bones[at(bone.parent)];
      body.parent = body_of_[at(bone.parent)];
      body.parent_from_body.p_m = in_robot_axes(above.direction * (above.length * metres_));
      add_joints(bone, body);
      add_capsule(bone, body);
    }
    out_.bodies.push_back(std::move(body));
  }

  // The rotation that is applied last is the outermost joint.
  void add_joints(const AsfBone& bone, RobotBody& body) {
    for (const AsfDof& dof : bone.dofs) {
      if (dof.kind == DofKind::length) stretching_.push_back(bone.name);
      if (!is_rotation(dof.kind) && dof.kind != DofKind::length) body.joints.push_back(joint_of(bone, dof));
    }
    for (std::size_t i = bone.turn_order.size(); i-- > 0;)
      for (const AsfDof& dof : bone.dofs)
        if (is_rotation(dof.kind) && static_cast<int>(dof.kind) == bone.turn_order[i])
          body.joints.push_back(joint_of(bone, dof));
  }

  RobotJoint joint_of(const AsfBone& bone, const AsfDof& dof) const {
    const bool turns = is_rotation(dof.kind);
    Vec3 axis(0.0);
    axis[static_cast<int>(dof.kind) - static_cast<int>(turns ? DofKind::rx : DofKind::tx)] = 1.0;
    RobotJoint joint{.name = bone.name + "_" + std::string(dof_name(dof.kind))};
    joint.kind = turns ? RobotJointKind::hinge : RobotJointKind::travel;
    joint.axis = in_robot_axes(bone.axis * axis);
    joint.low = turns ? dof.low : dof.low * metres_, joint.high = turns ? dof.high : dof.high * metres_;
    return joint;
  }

  void add_capsule(const AsfBone& bone, RobotBody& body) const {
    const Vec3 end_m = bone.direction * (bone.length * metres_);
    const double long_m = length(end_m), height_m = extent_.largest * metres_;
    if (!(long_m > kShortestBone * height_m)) return;
    const double share = radius_share(sense_of(bone.name).family);
    const double radius_m = share > 0.0 ? share * height_m : kOtherThickness * long_m;
    const double inset = std::min(radius_m / long_m, 0.45);  // capsules have round ends, which reach as far as the bone
    const Vec3 first_m = in_robot_axes(inset * end_m), last_m = in_robot_axes((1.0 - inset) * end_m);
    body.shapes.push_back({.shape = Capsule{first_m, last_m, radius_m}});
  }

  void set_masses() {
    double volume_m3 = 0.0;
    for (const RobotBody& body : out_.bodies)
      for (const RobotShape& shape : body.shapes) volume_m3 += volume_of_bone(std::get<Capsule>(shape.shape));
    const double height_m = extent_.height * metres_;
    const bool is_person = height_m >= kLeastFigure_m && height_m <= kGreatestFigure_m;
    const double density = is_person && volume_m3 > 0.0 ? kMassOfHeight_kg_m2 * height_m * height_m / volume_m3
                                                        : kCapsuleDensity_kg_m3;
    for (RobotBody& body : out_.bodies)
      for (const RobotShape& shape : body.shapes) {
        const Capsule& capsule = std::get<Capsule>(shape.shape);
        body.inertia = inertia_of_bone(capsule, density * volume_of_bone(capsule));
      }
  }

  const AsfSkeleton& skeleton_;
  Extent extent_;
  double metres_ = 1.0;
  RobotModel out_;
  std::vector<int> body_of_;
  std::vector<std::string> stretching_;
};

}  // namespace

RobotModel robot_of_asf(const AsfSkeleton& skeleton, const ImportOptions& options) {
  return AsfRobot(skeleton, options).make();
}

}  // namespace contort
