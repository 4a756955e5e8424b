#include "fuzz/compose_dynamics.h"

#include <cmath>

#include "fuzz/raw.h"
#include "model/core/detmath.h"

namespace contort {

namespace {

constexpr double kHeaviestLoad = 0.25;    // fraction of the figure's mass
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

LoadDesc compose_load(const int* raw, const Character& character) {
  const Socket& socket = character.sockets()[pick(raw[0], character.sockets().size())];
  const std::size_t slash = socket.name.find('/');
  LoadDesc load;
  load.slot = socket.name.substr(0, slash);
  load.socket = socket.name.substr(slash + 1);
  const double heaviest_kg = std::min(kHeaviestLoad * mass_kg(character), kMostInSpecs);
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
    LoadDesc load = compose_load(&raw[3 + 2 * i], character);
    if (!load.slot.starts_with("object:")) dynamics.loads.push_back(std::move(load));
  }
  // The mode tracking has no strength or balance to answer a blow.
  const std::size_t blows = pick(raw[kBlowCount], static_cast<std::size_t>(profile.impacts) + 1);
  for (std::size_t i = 0; i < blows && dynamics.mode == Mode::dynamic; ++i)
    dynamics.impacts.push_back(compose_impact(&raw[7 + 5 * i], character));
  return dynamics;
}

}  // namespace contort
