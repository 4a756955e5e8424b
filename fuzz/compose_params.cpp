#include "fuzz/compose_params.h"

#include <algorithm>
#include <cmath>

#include "model/core/detmath.h"
#include "model/core/math.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Rounds to the lattice, within the ends.
double within(double value, double steps_per_unit, double low, double high) {
  const double rounded = on_lattice(value, steps_per_unit);
  if (rounded < low) return std::ceil(low * steps_per_unit) / steps_per_unit + 0.0;
  if (rounded > high) return std::floor(high * steps_per_unit) / steps_per_unit + 0.0;
  return rounded;
}

Vec3 point_on_lattice(const Vec3& v, double steps_per_unit) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = on_lattice(v[i], steps_per_unit);
  return out;
}

// Reads the raw values of one action one after another. It starts again at the first one if a part has more joints than
// values.
class Values {
 public:
  Values(const std::array<int, kRawValues>& raw, double range) : raw_(raw), range_(range) {}
  double next() { return fraction(raw_[used_++ % kRawValues]); }
  // A place in a joint's range, within the fraction that the profile allows.
  double next_in_range() { return range_ == 1.0 ? next() : 0.5 + range_ * (next() - 0.5); }
  double range() const { return range_; }

 private:
  const std::array<int, kRawValues>& raw_;
  double range_;
  std::size_t used_ = 0;
};

// A rotation within the ball joint's cone and twist, as a rotation vector in whole degrees. Rounding may add half a
// degree, so the draw stays 2 % inside.
Vec3 draw_ball_deg(const Joint& joint, Values& values) {
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double radius = 0.98 * values.range() * std::sqrt(values.next());  // uniform over the ellipse
  const Vec3 other = glm::cross(joint.axis, joint.swing_axis);
  const Vec3 swing =
      radius * (joint.swing_a_rad * around.cos * joint.swing_axis + joint.swing_b_rad * around.sin * other);
  const double twist = 0.98 * (joint.low + (joint.high - joint.low) * values.next_in_range());
  const Quat q = joint.swing_center * from_rotation_vector(swing) * axis_angle(joint.axis, twist);
  return point_on_lattice(to_rotation_vector(q) * kDegPerRad, 1.0);
}

ParamValue draw_joint(const Joint& joint, Values& values) {
  if (joint.kind == JointKind::ball) return draw_ball_deg(joint, values);
  const double value = joint.low + (joint.high - joint.low) * values.next_in_range();
  if (joint.kind == JointKind::prismatic) return within(value, 100.0, joint.low, joint.high);
  return within(value * kDegPerRad, 1.0, joint.low * kDegPerRad, joint.high * kDegPerRad);
}

// A point around the chain's upper joint at rest, in centimetres. Its distance is 0.3 to 1.1 of the stretched chain.
Vec3 draw_reach_point(const Character& character, const ReachChain& chain, Values& values) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const Vec3 upper = world[static_cast<std::size_t>(chain.upper)].p_m;
  const Vec3 middle = world[static_cast<std::size_t>(chain.middle)].p_m;
  const Vec3 tip = world_from_socket(character, world, chain.tip).p_m;
  const double distance = (length(middle - upper) + length(tip - middle)) * (0.3 + 0.8 * values.next());
  const double height = 2.0 * values.next() - 1.0;  // uniform over the sphere
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double across = std::sqrt(1.0 - height * height);
  return point_on_lattice(upper + distance * Vec3(across * around.sin, height, across * around.cos), 100.0);
}

// A point 0.3 to 5 m away, between the ground and 2.5 m, in centimetres.
ParamValue draw_around(Values& values) {
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double distance_m = 0.3 + 4.7 * values.next();
  return point_on_lattice(Vec3(distance_m * around.sin, 2.5 * values.next(), distance_m * around.cos), 100.0);
}

ParamValue draw_uniform(const ParamDef& def, Values& values) {
  const auto one = [&](double low, double high) {
    return within(low + (high - low) * values.next(), steps_of(def), low, high);
  };
  if (def.type == ParamType::number) return one(def.low, def.high);
  const Vec3 low = def.box.empty() ? Vec3(def.low) : def.box[0], high = def.box.empty() ? Vec3(def.high) : def.box[1];
  const double x = one(low.x, high.x), y = one(low.y, high.y), z = one(low.z, high.z);
  return Vec3(x, y, z);
}

template <class T>
const T& one_of(const std::vector<T>& list, Values& values) {
  return list[std::min(list.size() - 1, static_cast<std::size_t>(values.next() * static_cast<double>(list.size())))];
}

ParamValue draw_param(const Character& character, const Part& part, std::size_t index, const ParamDef& def,
                      Values& values) {
  if (!def.special.empty() && values.next() < 0.5) return one_of(def.special, values);
  if (def.type == ParamType::choice && !def.special.empty()) return one_of(def.choices, values);
  if (def.type == ParamType::choice) return def.choices[values.next() < 0.5 ? 0 : def.choices.size() - 1];
  if (def.type == ParamType::object_point || def.type == ParamType::own_point) return one_of(def.points, values);
  switch (def.domain) {
    case Domain::joint_range:
      return draw_joint(character.joints()[static_cast<std::size_t>(part.first_joint) + index], values);
    case Domain::within_reach:  // large figures reach farther than specs allow
      return glm::clamp(draw_reach_point(character, part.reach.front(), values), Vec3(def.low), Vec3(def.high));
    case Domain::around: return draw_around(values);
    case Domain::uniform: break;
  }
  return draw_uniform(def, values);
}

// Draws a value that the rule and the parameter both allow. If no lattice point lies in that range, it is the lower
// end.
ParamValue draw_by_rule(const DrawRule& rule, const ParamDef& def, Values& values) {
  const double steps = steps_of(def);
  const auto one = [&](std::size_t i) {
    const double low = std::max(def.low, rule.low[std::min(i, rule.low.size() - 1)]);
    const double high = std::min(def.high, rule.high[std::min(i, rule.high.size() - 1)]);
    const double value = within(low + (high - low) * values.next(), steps, low, high);
    return value < low || value > high ? low : value;
  };
  if (def.type == ParamType::number) return one(0);
  const double x = one(0), y = one(1), z = one(2);
  return Vec3(x, y, z);
}

}  // namespace

void draw_params(const Character& character, const Part& part, const OfferedAction& action, const Profile& profile,
                 const std::array<int, kRawValues>& raw, ActionUse& use) {
  Values values(raw, profile.range);
  const std::vector<ParamDef>& defs = action.params;
  for (std::size_t i = 0; i < defs.size(); ++i) {
    // A parameter that distinguishes an action of a file from others is changed in one case of four.
    if (defs[i].is_characteristic && values.next() < 0.75) continue;
    if (defs[i].optional && values.next() < 0.4) continue;
    const DrawRule* rule = profile.rule_for(part.slot, action.name, defs[i].name);
    use.params[defs[i].name] =
        rule != nullptr ? draw_by_rule(*rule, defs[i], values) : draw_param(character, part, i, defs[i], values);
  }
}

void take_corners(const OfferedAction& action, Dice& dice, ActionUse& use) {
  for (const ParamDef& def : action.params) {
    if (def.type != ParamType::number || def.domain != Domain::uniform || !dice.one_in(4)) continue;
    const std::array<ParamValue, 3> corners{def.low, def.high, def.preset};
    use.params[def.name] = corners[static_cast<std::size_t>(dice.below(3))];
  }
}

}  // namespace contort
