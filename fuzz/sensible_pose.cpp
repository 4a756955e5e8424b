#include "fuzz/sensible_pose.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "checks/judge.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/core/math.h"
#include "model/motion/legs.h"

namespace contort {

namespace {

constexpr int kMostHalves = 4;

Vec3 rest_rotation_deg(const Character& character, const Joint& joint) {
  const double* q = character.rest_coords().data() + joint.coord;
  return to_rotation_vector(Quat(q[0], q[1], q[2], q[3])) * kDegPerRad;
}

double rest_value(const Character& character, const Joint& joint) {
  const double q = character.rest_coords()[at(joint.coord)];
  return joint.kind == JointKind::prismatic ? q : q * kDegPerRad;
}

// A point between rest and a value, rounded to the lattice of specs.
ParamValue part_of_way(const Character& character, const Joint& joint, const ParamValue& value, double share) {
  const double steps = joint.kind == JointKind::prismatic ? 100.0 : 1.0;
  const auto between = [&](double rest, double end) { return on_lattice(rest + share * (end - rest), steps); };
  if (const auto* end = std::get_if<double>(&value)) return between(rest_value(character, joint), *end);
  const Vec3 rest = rest_rotation_deg(character, joint), end = std::get<Vec3>(value);
  return Vec3(between(rest.x, end.x), between(rest.y, end.y), between(rest.z, end.z));
}

void put(const Joint& joint, const ParamValue& value, std::span<double> row) {
  double* q = row.data() + joint.coord;
  if (const auto* number = std::get_if<double>(&value)) {
    q[0] = joint.kind == JointKind::prismatic ? *number : *number * kRadPerDeg;
  } else {
    const Quat turned = from_rotation_vector(std::get<Vec3>(value) * kRadPerDeg);
    q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
  }
}

// The figure at rest, with one part on its way from rest to a pose.
class WayToPose {
 public:
  WayToPose(const Character& character, const Part& part, const std::vector<ParamDef>& params, ActionUse& use)
      : character_(character) {
    for (std::size_t i = 0; i < params.size(); ++i)
      if (const auto value = use.params.find(params[i].name);
          params[i].domain == Domain::joint_range && value != use.params.end())
        joints_.push_back({&character.joint(part.first_joint + static_cast<int>(i)), &value->second, value->second});
  }

  bool is_clear(const Environment& environment) const {
    constexpr std::array kOfPoses = {std::string_view("self_collision"), std::string_view("ground_penetration"),
                                     std::string_view("obstacle_penetration")};
    Judge judge;
    const Motion motion = frames();
    return std::ranges::none_of(
        kOfPoses, [&](std::string_view check) { return !judge.judge(character_, motion, check, environment).empty(); });
  }

  void shorten_to(double share) {
    for (const Posed& posed : joints_) *posed.value = part_of_way(character_, *posed.joint, posed.drawn, share);
  }

 private:
  struct Posed {
    const Joint* joint;
    ParamValue* value;
    ParamValue drawn;
  };

  Motion frames() const {
    constexpr int kFrames = 5;
    Motion motion;
    motion.frame_count = kFrames;
    motion.coord_count = character_.coord_count();
    motion.root.assign(kFrames, character_.rest_root());
    for (int frame = 0; frame < kFrames; ++frame) {
      const std::span<const double> rest = character_.rest_coords();
      motion.coords.insert(motion.coords.end(), rest.begin(), rest.end());
      for (const Posed& posed : joints_)
        put(*posed.joint, part_of_way(character_, *posed.joint, *posed.value, frame / (kFrames - 1.0)),
            motion.row(frame));
    }
    return motion;
  }

  const Character& character_;
  std::vector<Posed> joints_;
};

}  // namespace

bool carries_sole(const Character& character, int part) {
  return std::ranges::any_of(find_legs(character), [&](const Leg& leg) {
    return std::ranges::any_of(leg.joints, [&](int j) { return character.joint(j).part == part; });
  });
}

void make_sensible(const Character& character, const Part& part, const std::vector<ParamDef>& params,
                   const Environment& environment, ActionUse& use) {
  WayToPose way(character, part, params, use);
  double share = 1.0;
  for (int halves = 0; !way.is_clear(environment); ++halves) {
    share = halves < kMostHalves ? 0.5 * share : 0.0;
    way.shorten_to(share);
    if (share == 0.0) return;
  }
}

}  // namespace contort
