#include "generator/motion/aim_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "generator/motion/joint_clamp.h"
#include "model/core/assert.h"
#include "model/core/detmath.h"
#include "model/core/hash.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Postures of one cell that are nearer than this in every joint are one posture.
constexpr double kDifferent_rad = 20.0 * kRadPerDeg;
// Postures within this in every joint can be averaged: the way between them stays where they point.
constexpr double kNear_rad = 45.0 * kRadPerDeg;

// A joint this far inside its range, as a share of the way from limit to middle, has room enough.
constexpr double kRoom = 0.25;

struct State {
  int cell = 0;
  double room = 0.0;       // of the joint that is nearest to its limit, up to kRoom
  double from_rest = 0.0;  // squared angles of all joints
  int beside = 0;          // of the line of aim and the first joint, in steps of 5 cm
  int number = 0;
};

// Coordinates of the n-th state: the outermost joint's places change fastest.
void state_coords(const AimGeometry& geometry, const AimSteps& steps, int number, std::span<double> coords) {
  for (std::size_t i = geometry.joints.size(); i-- > 0;) {
    const auto size = static_cast<std::size_t>(coord_size(geometry.joints[i].kind));
    const auto places = static_cast<int>(steps.places[i].size() / size);
    const double* place = steps.places[i].data() + static_cast<std::size_t>(number % places) * size;
    std::copy(place, place + size, coords.begin() + geometry.joints[i].coord);
    number /= places;
  }
}

double from_rest_rad(const Joint& joint, const double* q) {
  return joint.kind == JointKind::ball ? rotation_angle(Quat(q[0], q[1], q[2], q[3])) : q[0];
}

// The distance of the line of aim from the origin of the chain's first joint; base frame.
double beside_first_joint_m(const AimGeometry& geometry, const Vec3& point_m, const Vec3& direction) {
  const Vec3 from_joint_m = point_m - geometry.joints.front().parent_from_joint.p_m;
  return length(from_joint_m - glm::dot(from_joint_m, direction) * direction);
}

// A chain as far as one of its joints; its room and angles are as those of a State.
struct Reach {
  Rigid base_from_joint;
  double room = kRoom;
  double from_rest = 0.0;
};

Reach beyond(const Reach& before, const Joint& joint, std::span<const double> coords) {
  Reach reach = before;
  reach.base_from_joint = before.base_from_joint * joint.parent_from_joint * joint_motion(joint, coords);
  if (joint.kind == JointKind::prismatic) return reach;
  const double* q = coords.data() + joint.coord;
  const double turned_rad = from_rest_rad(joint, q);
  reach.room = std::min(reach.room, normalised_margin(joint, q));
  reach.from_rest += turned_rad * turned_rad;
  return reach;
}

State judged(const AimGeometry& geometry, int number, const Reach& reach) {
  constexpr double kBesideStep_m = 0.05;
  const Rigid socket = reach.base_from_joint * geometry.last_from_socket;
  const Vec3 direction = socket.q * Vec3(0, 0, 1);
  State state{aim_cell(direction), reach.room, reach.from_rest, 0, number};
  state.beside = static_cast<int>(beside_first_joint_m(geometry, socket.p_m, direction) / kBesideStep_m);
  return state;
}

// Best of a cell first. Numbers differ, so the order is total. Not simply the farthest from the limits: the middle of a
// shoulder's range is an arm held up sideways, and a rifle would be aimed from above the head.
bool before(const State& a, const State& b) {
  if (a.cell != b.cell) return a.cell < b.cell;
  if (a.room != b.room) return a.room > b.room;
  if (a.from_rest != b.from_rest) return a.from_rest < b.from_rest;
  return a.number < b.number;
}

// Among states of one cell.
bool is_sighted_before(const State& a, const State& b) {
  if (a.room != b.room) return a.room > b.room;
  if (a.beside != b.beside) return a.beside < b.beside;
  return before(a, b);
}

// Appends the states with this reach before a joint, in the order of their numbers.
void add_states(const AimGeometry& geometry, const AimSteps& steps, std::size_t joint, const Reach& before,
                std::span<double> coords, std::vector<State>& states) {
  if (joint == geometry.joints.size()) {
    states.push_back(judged(geometry, static_cast<int>(states.size()), before));
    return;
  }
  const Joint& next = geometry.joints[joint];
  const auto size = static_cast<std::size_t>(coord_size(next.kind));
  const std::span<const double> places = steps.places[joint];
  for (std::size_t place = 0; place < places.size(); place += size) {
    std::ranges::copy(places.subspan(place, size), coords.begin() + next.coord);
    add_states(geometry, steps, joint + 1, beyond(before, next, coords), coords, states);
  }
}

std::vector<State> all_states(const AimGeometry& geometry, const AimSteps& steps) {
  std::vector<State> states;
  states.reserve(static_cast<std::size_t>(steps.state_count));
  std::vector<double> coords(static_cast<std::size_t>(geometry.coord_count));
  add_states(geometry, steps, 0, {}, coords, states);
  std::ranges::sort(states, before);
  return states;
}

// Returns true if the posture differs from all of the cell's, which are the last ones of `kept`.
bool differs(const AimGeometry& geometry, std::span<const double> coords, std::span<const double> kept) {
  const std::size_t size = coords.size();
  for (std::size_t at = 0; at < kept.size(); at += size)
    if (posture_difference_rad(geometry, coords, kept.subspan(at, size)) < kDifferent_rad) return false;
  return true;
}

// Appends states of a cell, the first ones first, until the cell has `most` postures that differ.
void keep_best(const AimGeometry& geometry, const AimSteps& steps, std::span<const State> cell, int most,
               std::size_t cell_begin, std::vector<double>& kept) {
  const auto size = static_cast<std::size_t>(geometry.coord_count);
  std::vector<double> coords(size);
  for (const State& state : cell) {
    if (kept.size() - cell_begin >= size * static_cast<std::size_t>(most)) return;
    state_coords(geometry, steps, state.number, coords);
    if (differs(geometry, coords, std::span(kept).subspan(cell_begin)))
      kept.insert(kept.end(), coords.begin(), coords.end());
  }
}

double rotation_difference_rad(const double* a, const double* b) {
  return rotation_angle(glm::conjugate(Quat(a[0], a[1], a[2], a[3])) * Quat(b[0], b[1], b[2], b[3]));
}

// Adds weight * posture to the sum, balls with the sign of `anchor`'s.
void add_weighted(const AimGeometry& geometry, std::span<const double> posture, double weight,
                  std::span<const double> anchor, std::span<double> sum) {
  for (const Joint& joint : geometry.joints) {
    const auto first = static_cast<std::size_t>(joint.coord);
    const auto size = static_cast<std::size_t>(coord_size(joint.kind));
    double dot = 0.0;
    for (std::size_t i = first; i < first + size; ++i) dot += posture[i] * anchor[i];
    const double sign = size == 4 && dot < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = first; i < first + size; ++i) sum[i] += sign * weight * posture[i];
  }
}

// Makes the sum a posture: balls to unit length, and all into range, which the set of a ball's rotations needs because
// it is not convex.
void finish_mean(const AimGeometry& geometry, double weight, std::span<double> sum) {
  for (const Joint& joint : geometry.joints) {
    double* q = sum.data() + joint.coord;
    if (joint.kind == JointKind::ball) {
      const Quat mean = glm::normalize(Quat(q[0], q[1], q[2], q[3]));
      q[0] = mean.w, q[1] = mean.x, q[2] = mean.y, q[3] = mean.z;
    } else {
      q[0] /= weight;
    }
    clamp_to_range(joint, q);
  }
}

double squared(const Vec3& v) { return glm::dot(v, v); }

}  // namespace

int aim_cell(const Vec3& direction) {
  const Vec3 size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int face = 2 * axis + (direction[axis] < 0.0 ? 1 : 0);
  const auto slot = [&](int other) {
    const double across_rad = det::atan2(direction[other], size[axis]);  // in [-pi/4, pi/4]
    const double share = (across_rad + kPi / 4.0) / (kPi / 2.0);
    return std::clamp(static_cast<int>(share * kAimCellsPerEdge), 0, kAimCellsPerEdge - 1);
  };
  return (face * kAimCellsPerEdge + slot((axis + 1) % 3)) * kAimCellsPerEdge + slot((axis + 2) % 3);
}

double posture_difference_rad(const AimGeometry& geometry, std::span<const double> a, std::span<const double> b) {
  double greatest = 0.0;
  for (const Joint& joint : geometry.joints) {
    const double* qa = a.data() + joint.coord;
    const double* qb = b.data() + joint.coord;
    if (joint.kind == JointKind::ball) greatest = std::max(greatest, rotation_difference_rad(qa, qb));
    if (joint.kind == JointKind::hinge) greatest = std::max(greatest, std::fabs(qa[0] - qb[0]));
  }
  return greatest;
}

std::uint64_t AimTable::key_of(const AimGeometry& geometry, const AimTableOptions& options) {
  Hash64 hash;
  hash.add(geometry_hash(geometry));
  hash.add(options.joint_step_deg);
  hash.add(static_cast<std::uint64_t>(options.max_states));
  hash.add(static_cast<std::uint64_t>(options.per_cell));
  return hash.value();
}

AimTable AimTable::build(const AimGeometry& geometry, const AimTableOptions& options) {
  CONTORT_ASSERT(options.joint_step_deg >= 0.5 && options.max_states >= 1 && options.per_cell >= 1);
  const AimSteps steps = aim_steps(geometry, options);
  std::vector<State> states = all_states(geometry, steps);
  std::vector<double> kept;
  for (auto begin = states.begin(); begin != states.end();) {
    const auto end = std::find_if(begin, states.end(), [&](const State& state) { return state.cell != begin->cell; });
    const std::span cell(&*begin, static_cast<std::size_t>(end - begin));
    const std::size_t cell_begin = kept.size();
    keep_best(geometry, steps, cell, options.per_cell - options.per_cell / 3, cell_begin, kept);
    std::ranges::sort(cell, is_sighted_before);
    keep_best(geometry, steps, cell, options.per_cell, cell_begin, kept);
    begin = end;
  }
  return of_postures(geometry, options, kept);
}

AimTable AimTable::of_postures(AimGeometry geometry, const AimTableOptions& options, std::span<const double> coords) {
  AimTable table;
  table.geometry_ = std::move(geometry);
  table.options_ = options;
  table.coords_.assign(coords.begin(), coords.end());
  table.arrange();
  return table;
}

std::span<const double> AimTable::coords(int posture) const {
  const auto size = static_cast<std::size_t>(geometry_.coord_count);
  return std::span(coords_).subspan(static_cast<std::size_t>(posture) * size, size);
}

// Puts the postures into the tree's order. Postures are compared by all that they are, so that the order in which they
// came does not show.
void AimTable::arrange() {
  const auto size = static_cast<std::size_t>(geometry_.coord_count);
  const std::size_t count = coords_.size() / size;
  const std::vector<double> given = std::move(coords_);
  std::vector<Rigid> placed(count);
  std::vector<Vec3> facing(count);
  const auto posture = [&](int i) { return std::span(given).subspan(static_cast<std::size_t>(i) * size, size); };
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (const int i : order) {
    placed[static_cast<std::size_t>(i)] = base_from_socket(geometry_, posture(i));
    facing[static_cast<std::size_t>(i)] = placed[static_cast<std::size_t>(i)].q * Vec3(0, 0, 1);
  }
  const auto divide = [&](const auto& self, int begin, int end, int axis) -> void {
    if (end - begin < 2) return;
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end, [&](int a, int b) {
      const double along_a = facing[static_cast<std::size_t>(a)][axis];
      const double along_b = facing[static_cast<std::size_t>(b)][axis];
      if (along_a != along_b) return along_a < along_b;
      return std::ranges::lexicographical_compare(posture(a), posture(b));
    });
    self(self, begin, middle, (axis + 1) % 3);
    self(self, middle + 1, end, (axis + 1) % 3);
  };
  divide(divide, 0, static_cast<int>(count), 0);
  for (const int i : order) {
    directions_.push_back(facing[static_cast<std::size_t>(i)]);
    points_m_.push_back(placed[static_cast<std::size_t>(i)].p_m);
    coords_.insert(coords_.end(), posture(i).begin(), posture(i).end());
  }
}

struct AimTable::Search {
  const Vec3& wanted;
  std::span<AimHit> hits;
  std::size_t found = 0;

  bool better(const AimHit& a, const AimHit& b) const {
    return a.chord != b.chord ? a.chord < b.chord : a.posture < b.posture;
  }
  bool can_use(double chord) const { return found < hits.size() || chord <= hits.back().chord; }
  void offer(const AimHit& hit) {
    if (found == hits.size() && !better(hit, hits.back())) return;
    std::size_t at = found < hits.size() ? found++ : found - 1;
    for (; at > 0 && better(hit, hits[at - 1]); --at) hits[at] = hits[at - 1];
    hits[at] = hit;
  }
};

void AimTable::search(Search& search, int begin, int end, int axis) const {
  if (begin >= end) return;
  const int middle = begin + (end - begin) / 2;
  const Vec3& here = direction(middle);
  search.offer({middle, squared(here - search.wanted)});
  const double beyond = search.wanted[axis] - here[axis];
  const int next = (axis + 1) % 3;
  const bool low_first = beyond < 0.0;
  this->search(search, low_first ? begin : middle + 1, low_first ? middle : end, next);
  if (search.can_use(beyond * beyond))
    this->search(search, low_first ? middle + 1 : begin, low_first ? end : middle, next);
}

int AimTable::nearest(const Vec3& direction, std::span<AimHit> hits) const {
  if (hits.empty()) return 0;
  Search state{direction, hits};
  search(state, 0, posture_count(), 0);
  return static_cast<int>(state.found);
}

int AimTable::nearest_to_point(const Vec3& target_m, std::span<AimHit> hits) const {
  if (hits.empty()) return 0;
  Search state{target_m, hits};
  for (int i = 0; i < posture_count(); ++i)
    state.offer({i, squared(direction(i) - unit_or(target_m - point_m(i), -direction(i)))});
  return static_cast<int>(state.found);
}

void AimTable::interpolated(const Vec3& direction, std::span<double> coords) const {
  std::array<AimHit, 8> hits;
  interpolated(direction, std::span(hits).first(static_cast<std::size_t>(nearest(direction, hits))), coords);
}

void AimTable::interpolated(const Vec3& direction, std::span<const AimHit> hits, std::span<double> coords) const {
  const std::span<const double> anchor = this->coords(hits[0].posture);
  std::array<double, kMaxAimCoords> sum{};
  double weights = 0.0;
  for (const AimHit& hit : hits) {
    const std::span<const double> near = this->coords(hit.posture);
    if (posture_difference_rad(geometry_, anchor, near) > kNear_rad) continue;
    const double weight = 1.0 / (hit.chord + 1e-6);  // 1e-6: a milliradian, so that an exact hit takes nearly all
    add_weighted(geometry_, near, weight, anchor, sum);
    weights += weight;
  }
  const std::span<double> mean = std::span(sum).first(anchor.size());
  finish_mean(geometry_, weights, mean);
  const Vec3 facing = base_from_socket(geometry_, mean).q * Vec3(0, 0, 1);
  const bool nearer = squared(facing - direction) < hits[0].chord;
  for (std::size_t i = 0; i < anchor.size(); ++i) coords[i] = nearer ? mean[i] : anchor[i];
}

double AimTable::beside_m(int posture) const {
  return beside_first_joint_m(geometry_, point_m(posture), direction(posture));
}

namespace {

// Insertion: of equals the earlier hit stays first, and std::stable_sort would allocate.
template <class Cost>
void put_cheapest_first(std::span<AimHit> hits, Cost cost) {
  for (std::size_t i = 1; i < hits.size(); ++i)
    for (std::size_t j = i; j > 0 && cost(hits[j]) < cost(hits[j - 1]); --j) std::swap(hits[j], hits[j - 1]);
}

}  // namespace

void AimTable::prefer(std::span<const double> present, std::span<AimHit> hits) const {
  put_cheapest_first(
      hits, [&](const AimHit& hit) { return posture_difference_rad(geometry_, present, coords(hit.posture)); });
}

void AimTable::prefer_sighted(std::span<const double> present, std::span<AimHit> hits) const {
  constexpr double kBeside_rad_m = 4.0;
  put_cheapest_first(hits, [&](const AimHit& hit) {
    return posture_difference_rad(geometry_, present, coords(hit.posture)) + kBeside_rad_m * beside_m(hit.posture);
  });
}

}  // namespace contort
