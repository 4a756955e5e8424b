#include "generator/dynamics/body_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/core/index.h"
#include "model/geometry/segment_distance.h"

namespace contort {

namespace {

constexpr int kPassesOfContacts = 2;     // over all contacts, since one may close another
constexpr int kProjections = 3;          // between two cores, to find where they are nearest
constexpr double kShortestLever = 0.03;  // m/rad or m/m: freedoms that move a contact less cannot keep it open
constexpr double kKept_m = 0.005;        // gap that is kept, since a tick is not infinitely short
constexpr double kLeastMass = 0.2;       // of the greatest: a light wrist alone cannot keep an arm away
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void place_solid(const Placement& link, const Vec3& root_m, const Solid& own, Solid& placed) {
  placed.center_m = link.origin_m - root_m + link.rotation * own.center_m;
  if (own.core == Solid::Core::segment) placed.axis = link.rotation * own.axis;
  if (own.core == Solid::Core::box || own.core == Solid::Core::hull) placed.axes = Mat3(link.rotation) * own.axes;
}

// The point of a core that is nearest to `to`; of a hull its centre.
Vec3 nearest_of_core(const Solid& solid, const Vec3& to) {
  const Vec3 from_center = to - solid.center_m;
  if (solid.core == Solid::Core::segment) {
    const double along = std::clamp(glm::dot(from_center, solid.axis), -solid.half_length_m, solid.half_length_m);
    return solid.center_m + along * solid.axis;
  }
  if (solid.core != Solid::Core::box) return solid.center_m;
  return solid.center_m +
         solid.axes * glm::clamp(glm::transpose(solid.axes) * from_center, -solid.half_m, solid.half_m);
}

Segment core_segment(const Solid& round) {
  return {round.center_m, round.axis, round.core == Solid::Core::segment ? round.half_length_m : 0.0};
}

// Between the surfaces, where the two are nearest; for hulls about there.
Vec3 touching_point(const Solid& a, const Solid& b) {
  Vec3 on_a = a.center_m, on_b = b.center_m;
  if (a.is_round() && b.is_round()) {
    const Segment of_a = core_segment(a), of_b = core_segment(b);
    const ClosestOnSegments nearest = closest_on_segments(of_a, of_b);
    on_a = of_a.center + nearest.s * of_a.axis, on_b = of_b.center + nearest.t * of_b.axis;
  } else {
    for (int i = 0; i < kProjections; ++i) on_a = nearest_of_core(a, on_b), on_b = nearest_of_core(b, on_a);
  }
  const double distance_m = length(on_b - on_a);
  if (!(distance_m > 0.0)) return on_a;
  const Vec3 way = (on_b - on_a) / distance_m;
  return 0.5 * (on_a + a.radius_m * way + on_b - b.radius_m * way);
}

// Finds the motion of each link at these rates of all freedoms.
void find_motions(const Multibody& body, const DynamicsScratch& dynamics, std::span<const double> rates,
                  std::vector<SpatialMotion>& motions) {
  motions.resize(body.links().size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Link& link = body.links()[i];
    motions[i] = i == 0 ? SpatialMotion{} : motions[at(link.parent)];
    for (int k = link.dof; k < link.dof + link.dof_count; ++k) motions[i] += rates[at(k)] * dynamics.freedoms[at(k)];
  }
}

}  // namespace

void BodyContacts::begin(const Character& character, const DynamicFigure& figure) {
  links_.clear(), solids_.clear(), pairs_.clear(), contacts_.clear();
  for (const Collider& collider : character.colliders()) {
    links_.push_back(collider.joint);
    solids_.push_back(solid_of(collider));
  }
  placed_ = solids_;
  left_alone_.assign(at(figure.body.dof_count()), 0);
  std::fill_n(left_alone_.begin(), kRootDofs, 1);
  for (const Sole& sole : figure.soles)
    for (const int dof : sole.leg_dofs) left_alone_[at(dof)] = 1;
  for (const int dof : figure.watched) left_alone_[at(dof)] = 1;
  for (const ColliderPair& pair : character.judged_colliders()) {
    if (links_[at(pair.a)] == links_[at(pair.b)]) continue;
    bool gives_way = false;
    for_freedoms_between(figure.body, links_[at(pair.a)], links_[at(pair.b)],
                         [&](std::size_t dof, bool) { gives_way = gives_way || left_alone_[dof] == 0; });
    pairs_.push_back({at(pair.a), at(pair.b), gives_way});
  }
}

void BodyContacts::find(const DynamicsScratch& dynamics, double within_m, bool stands) {
  contacts_.clear();
  const Vec3 root_m = dynamics.world[0].origin_m;
  for (std::size_t i = 0; i < solids_.size(); ++i)
    place_solid(dynamics.world[at(links_[i])], root_m, solids_[i], placed_[i]);
  for (const Pair& pair : pairs_) {
    if (stands && !pair.gives_way) continue;
    const Solid &a = placed_[pair.a], &b = placed_[pair.b];
    const Vec3 between = b.center_m - a.center_m;
    const double reach_m = a.bound_m + b.bound_m + within_m;
    if (!(glm::dot(between, between) < reach_m * reach_m)) continue;
    Vec3 way(0.0);
    const double gap_m = signed_distance(a, b, within_m, way);
    if (!(gap_m < within_m)) continue;
    if (way == Vec3(0.0)) way = way_out(a, b);
    contacts_.push_back({links_[pair.a], links_[pair.b], touching_point(a, b), way, gap_m});
  }
}

void BodyContacts::find_shares(const EquationOfMotion& equation, const BodyContact& contact) {
  shares_.clear();
  for_openings(equation.body(), equation.dynamics, contact, [&](std::size_t dof, double opens) {
    const double mass = left_alone_[dof] != 0 ? kInfinity : equation.mass[dof * equation.size() + dof];
    shares_.push_back({dof, opens, mass});
  });
  double greatest = 0.0;
  for (const Share& share : shares_)
    if (share.mass < kInfinity) greatest = std::max(greatest, share.mass);
  for (Share& share : shares_) share.mass = std::max(share.mass, kLeastMass * greatest);
}

double BodyContacts::opening(const BodyContact& contact) const {
  const Vec3 a = point_velocity(motions_[at(contact.link_a)], contact.from_root_m);
  const Vec3 b = point_velocity(motions_[at(contact.link_b)], contact.from_root_m);
  return glm::dot(contact.normal, b - a);
}

// Makes the contact open faster by so much, in about the way that takes the least energy.
void BodyContacts::open(double missing, std::span<double> rates) const {
  double softness = 0.0, lever = 0.0;
  for (const Share& share : shares_) {
    softness += share.opens * share.opens / share.mass;
    if (share.mass < kInfinity) lever = std::max(lever, std::fabs(share.opens));
  }
  if (lever < kShortestLever) return;
  for (const Share& share : shares_) rates[share.dof] += missing * share.opens / (share.mass * softness);
}

// Changes the rates where a contact opens too slowly: `missing` tells by how much, from the contact's index and the
// rate at which it opens.
template <class Missing>
void BodyContacts::open_where(const EquationOfMotion& equation, std::span<double> rates, Missing missing) {
  bool changed = true;
  for (int pass = 0; pass < kPassesOfContacts && changed; ++pass) {
    changed = false;
    find_motions(equation.body(), equation.dynamics, rates, motions_);
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const double more = missing(i, opening(contacts_[i]));
      if (!(more > 0.0)) continue;
      find_shares(equation, contacts_[i]);
      open(more, rates);
      find_motions(equation.body(), equation.dynamics, rates, motions_);
      changed = true;
    }
  }
}

void BodyContacts::slow(const EquationOfMotion& equation, double ahead_s, std::span<double> acceleration) {
  if (contacts_.empty()) return;
  const double per_distance = 2.0 / (ahead_s * ahead_s);
  find_motions(equation.body(), equation.dynamics, equation.state.velocity, motions_);
  openings_.clear();
  for (const BodyContact& contact : contacts_) openings_.push_back(opening(contact));
  open_where(equation, acceleration, [&](std::size_t i, double opens) {
    const double then_m = std::max(contacts_[i].gap_m - kKept_m, 0.0) + ahead_s * openings_[i];
    return -per_distance * then_m - opens;
  });
}

void BodyContacts::stop(const EquationOfMotion& equation, double tick_s, std::span<double> velocity) {
  if (contacts_.empty()) return;
  open_where(equation, velocity, [&](std::size_t i, double opens) {
    return -std::max(contacts_[i].gap_m - kKept_m, 0.0) / tick_s - opens;
  });
  for (BodyContact& contact : contacts_) contact.gap_m += tick_s * opening(contact);
}

}  // namespace contort
