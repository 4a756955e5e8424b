#include "fuzz/compose_dynamics.h"

#include <cmath>

#include "fuzz/raw.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kHeaviestLoad = 0.25;    // fraction of the figure's mass
constexpr double kLightLoad = 0.05;       // the same for the mode tracking, which does not answer a load
constexpr double kBearable = 0.5;         // fraction of a joint's strength that a load may need
constexpr double kGravity_m_s2 = 9.81;
constexpr double kHardestBlow_m_s = 1.0;  // impulse per kilogram; a push from which a person recovers is 0.1
constexpr double kMostInSpecs = 10000.0;  // kg, N s: greatest values in specs (spec_fields.h)
constexpr int kLastBlow = 90;             // frame

double mass_kg(const Character& character) {
  double sum = 0.0;
  for (const Joint& joint : character.joints()) sum += joint.mass_kg;
  return sum;
}

double rounded(double value, double step) { return step * std::round(value / step); }

// Uniform in the square root of the magnitude, so half of the loads and blows are below a quarter of the greatest.
double drawn_up_to(double most, int raw) { return most * fraction(raw) * fraction(raw); }

// The greatest mass at a socket whose weight, in whatever direction it pulls, the joints that carry it hold at rest.
double bearable_kg(const Character& character, const Socket& socket) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const Vec3 place_m = world[at(socket.joint)] * socket.joint_from_socket.p_m;
  double most_kg = kMostInSpecs;
  for (int j = socket.joint; j > 0; j = character.joint(j).parent) {
    const Joint& joint = character.joint(j);
    const Vec3 arm_m = place_m - world[at(j)].p_m;
    const double strength = kBearable * std::min(joint.strength_high, -joint.strength_low);
    double arm = length(arm_m);
    if (joint.kind == JointKind::hinge) arm = length(glm::cross(world[at(j)].q * joint.axis, arm_m));
    if (joint.kind == JointKind::prismatic) arm = 1.0;  // its strength is a force
    if (strength > 0.0 && arm > 0.0) most_kg = std::min(most_kg, strength / (kGravity_m_s2 * arm));
  }
  return most_kg;
}

LoadDesc compose_load(const int* raw, const Profile& profile, Mode mode, const Character& character) {
  const Socket& socket = character.sockets()[pick(raw[0], character.sockets().size())];
  const std::size_t slash = socket.name.find('/');
  LoadDesc load;
  load.slot = socket.name.substr(0, slash);
  load.socket = socket.name.substr(slash + 1);
  const bool is_light = mode == Mode::tracking && !profile.wild_loads;
  double heaviest_kg = std::min((is_light ? kLightLoad : kHeaviestLoad) * mass_kg(character), kMostInSpecs);
  if (!profile.wild_loads) heaviest_kg = std::min(heaviest_kg, bearable_kg(character, socket));
  load.mass_kg = std::max(0.5, rounded(drawn_up_to(heaviest_kg, raw[1]), 0.5));
  return load;
}

ImpactDesc compose_impact(const int* raw, const Character& character) {
  ImpactDesc impact;
  impact.frame = between(raw[0], 0, kLastBlow);
  impact.slot = character.parts()[pick(raw[1], character.parts().size())].slot;
  const double size = std::max(1.0, drawn_up_to(std::min(kHardestBlow_m_s * mass_kg(character), kMostInSpecs), raw[2]));
  const double height = 2.0 * fraction(raw[3]) - 1.0, across = std::sqrt(1.0 - height * height);
  const det::SinCos around = det::sincos(2.0 * kPi * fraction(raw[4]));
  const Vec3 blow = size * Vec3(across * around.sin, height, across * around.cos);
  for (int i = 0; i < 3; ++i) impact.impulse_N_s[i] = rounded(blow[i], 0.5) + 0.0;
  return impact;
}

}  // namespace

DynamicsDesc compose_dynamics(const std::array<int, kRawDynamics>& raw, const Features& features,
                              const Character& character) {
  DynamicsDesc dynamics;
  const Profile& profile = features.profile();
  if (!happens(raw[0], profile.tracking + profile.dynamic)) return dynamics;
  dynamics.mode = happens(raw[0], profile.tracking) ? Mode::tracking : Mode::dynamic;
  for (std::size_t i = 0; i < pick(raw[kLoadCount], 3) && !character.sockets().empty(); ++i) {
    LoadDesc load = compose_load(&raw[3 + 2 * i], profile, dynamics.mode, character);
    if (!load.slot.starts_with("object:")) dynamics.loads.push_back(std::move(load));
  }
  // The mode tracking has no strength or balance to answer a blow.
  const std::size_t blows = pick(raw[kBlowCount], static_cast<std::size_t>(profile.impacts) + 1);
  for (std::size_t i = 0; i < blows && dynamics.mode == Mode::dynamic; ++i)
    dynamics.impacts.push_back(compose_impact(&raw[7 + 5 * i], character));
  return dynamics;
}

}  // namespace contort
