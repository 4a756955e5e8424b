#include "fuzz/sensible_pose.h"

#include <algorithm>
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

void put_between(const Joint& joint, std::span<const double> from, std::span<const double> end, double share,
                 std::span<double> row) {
  const double *a = from.data() + joint.coord, *b = end.data() + joint.coord;
  double* q = row.data() + joint.coord;
  if (joint.kind != JointKind::ball) {
    q[0] = a[0] + share * (b[0] - a[0]);
    return;
  }
  const Quat between = slerp_short(Quat(a[0], a[1], a[2], a[3]), Quat(b[0], b[1], b[2], b[3]), share);
  q[0] = between.w, q[1] = between.x, q[2] = between.y, q[3] = between.z;
}

}  // namespace

bool carries_sole(const Character& character, int part) {
  return std::ranges::any_of(find_legs(character), [&](const Leg& leg) {
    return std::ranges::any_of(leg.joints, [&](int j) { return character.joint(j).part == part; });
  });
}

bool is_pose(const OfferedAction& action) {
  return std::ranges::any_of(action.params, [](const ParamDef& def) { return def.domain == Domain::joint_range; });
}

bool is_sensible_in(const Profile& profile, const Part& part, const OfferedAction& action) {
  const auto has_rule = [&](const ParamDef& def) {
    return profile.rule_for(part.slot, action.name, def.name) != nullptr;
  };
  return is_pose(action) && !profile.wild_poses && profile.range >= 1.0 &&
         std::ranges::none_of(action.params, has_rule);
}

Environment beside_rest(const EnvironmentDesc& environment) {
  EnvironmentDesc beside;
  beside.obstacles = environment.obstacles;
  if (std::holds_alternative<StepsGround>(environment.ground)) beside.ground = environment.ground;
  Result<Environment> built = build_environment(beside);
  return built ? std::move(*built) : Environment();  // a spec with a wrong environment fails anyway
}

// One part on its way to a pose.
class WayToPose {
 public:
  WayToPose(const Character& character, const Part& part, const std::vector<ParamDef>& params, ActionUse& use)
      : character_(character), part_(part) {
    for (std::size_t i = 0; i < params.size(); ++i)
      if (const auto value = use.params.find(params[i].name);
          params[i].domain == Domain::joint_range && value != use.params.end())
        joints_.push_back({&character.joint(part.first_joint + static_cast<int>(i)), &value->second, value->second});
  }

  bool is_clear(std::span<const double> from, const Environment& environment) const {
    Judge judge;
    const Motion motion = frames(from);
    const auto judged = [&](std::string_view check) { return judge.judge(character_, motion, check, environment); };
    const auto is_of_part = [&](const Finding& finding) { return finding.subject.starts_with(part_.slot + "/"); };
    const auto is_of_leg = [&](const Finding& finding) { return is_on_leg(finding.subject); };
    return std::ranges::none_of(judged("joint_range"), is_of_part) && judged("self_collision").empty() &&
           judged("obstacle_penetration").empty() && std::ranges::all_of(judged("ground_penetration"), is_of_leg);
  }

  void shorten_to(double share) {
    for (const Posed& posed : joints_) *posed.value = part_of_way(character_, *posed.joint, posed.drawn, share);
  }

  void put_into(std::span<double> row) const {
    for (const Posed& posed : joints_) put(*posed.joint, *posed.value, row);
  }

 private:
  struct Posed {
    const Joint* joint;
    ParamValue* value;
    ParamValue drawn;
  };

  // Legs step onto the ground by themselves, so that a foot inside a step says nothing about the pose.
  bool is_on_leg(std::string_view body) const {
    const std::string_view slot = body.substr(0, body.find('/'));
    return carries_sole(character_, character_.find_part(slot));
  }

  Motion frames(std::span<const double> from) const {
    constexpr int kPlaces = 9;
    Motion motion;
    motion.frame_count = kPlaces;
    motion.coord_count = character_.coord_count();
    motion.root.assign(kPlaces, character_.rest_root());
    std::vector<double> end(from.begin(), from.end());
    put_into(end);
    for (int frame = 0; frame < kPlaces; ++frame) {
      motion.coords.insert(motion.coords.end(), from.begin(), from.end());
      for (const Posed& posed : joints_)
        put_between(*posed.joint, from, end, frame / (kPlaces - 1.0), motion.row(frame));
    }
    return motion;
  }

  const Character& character_;
  const Part& part_;
  std::vector<Posed> joints_;
};

void PosedFigure::add_sensible(const Part& part, const std::vector<ParamDef>& params, ActionUse& use) {
  WayToPose way(character_, part, params, use);
  double share = 1.0;
  for (int halves = 0; share > 0.0 && !is_clear(way); ++halves) {
    share = halves < kMostHalves ? 0.5 * share : 0.0;
    way.shorten_to(share);
  }
  way.put_into(row_);
}

bool PosedFigure::add(const Part& part, const std::vector<ParamDef>& params, const ActionUse& use) {
  ActionUse as_it_is = use;
  const WayToPose way(character_, part, params, as_it_is);
  const bool clear = is_clear(way);
  way.put_into(row_);
  return clear;
}

bool PosedFigure::is_clear(const WayToPose& way) const {
  return way.is_clear(character_.rest_coords(), environment_) && way.is_clear(row_, environment_);
}

}  // namespace contort
