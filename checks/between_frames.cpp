#include "checks/between_frames.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kMissed_m = 0.001;  // a penetration that is deeper by no more than this may be missed
constexpr int kMostHalvings = 8;     // 256 parts of the time between two frames

std::size_t at(int i) { return static_cast<std::size_t>(i); }
double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

Quat ball_at(std::span<const double> row, const Joint& joint) {
  const double* q = row.data() + joint.coord;
  return Quat(q[0], q[1], q[2], q[3]);
}

Rigid motion_between(const Joint& joint, std::span<const double> before, std::span<const double> now, double time) {
  if (joint.kind == JointKind::ball) return {slerp_short(ball_at(before, joint), ball_at(now, joint), time), Vec3(0.0)};
  const double from = before[at(joint.coord)], step = now[at(joint.coord)] - from;
  const double value = from + time * (joint.kind == JointKind::hinge ? wrap_angle(step) : step);
  if (joint.kind == JointKind::hinge) return {axis_angle(joint.axis, value), Vec3(0.0)};
  return {kNoRotation, value * joint.axis};
}

// How far b is beyond a along n; no more than their distance, whatever n.
double gap_along(const Solid& a, const Solid& b, const Vec3& n) {
  return glm::dot(b.center_m - a.center_m, n) - extent_along(a, n) - extent_along(b, -n);
}

}  // namespace

BetweenFrames::BetweenFrames(const Character& character) : character_(character) {
  for (const Collider& collider : character.colliders()) own_.push_back(solid_of(collider));
  for (const Body& body : character.bodies()) add_links(body);
  directions_.resize(character.judged_colliders().size(), Vec3(0.0));
  steps_.resize(character.joints().size());
  travels_m_.resize(character.bodies().size());
}

void BetweenFrames::add_links(const Body& body) {
  double reach_m = 0.0;
  for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c)
    reach_m = std::max(reach_m, length(own_[at(c)].center_m) + own_[at(c)].bound_m);
  std::vector<Link> links;
  for (int j = body.joint; j > 0; j = character_.joints()[at(j)].parent) {
    links.push_back({j, reach_m});
    reach_m += length(character_.joints()[at(j)].parent_from_joint.p_m);
  }
  links_.push_back(std::move(links));
}

double BetweenFrames::step_of(const Joint& joint) const {
  if (joint.kind == JointKind::ball)
    return rotation_angle(glm::conjugate(ball_at(before_.coords, joint)) * ball_at(now_.coords, joint));
  const double step = now_.coords[at(joint.coord)] - before_.coords[at(joint.coord)];
  return std::fabs(joint.kind == JointKind::hinge ? wrap_angle(step) : step);
}

void BetweenFrames::set(const Frame& before, const Frame& now) {
  before_ = before, now_ = now;
  farthest_out_m_ = 0.0;
  const std::span<const Joint> joints = character_.joints();
  for (std::size_t j = 1; j < joints.size(); ++j) {
    steps_[j] = step_of(joints[j]);
    const std::size_t coord = at(joints[j].coord);
    if (joints[j].kind == JointKind::prismatic)
      farthest_out_m_ += std::max(std::fabs(before.coords[coord]), std::fabs(now.coords[coord]));
  }
  for (std::size_t b = 0; b < links_.size(); ++b) {
    double travel_m = 0.0;
    for (const Link& link : links_[b]) {
      const bool slides = joints[at(link.joint)].kind == JointKind::prismatic;
      travel_m += steps_[at(link.joint)] * (slides ? 1.0 : link.reach_m + farthest_out_m_);
    }
    travels_m_[b] = travel_m;
  }
}

// The first joint that both bodies hang on: indices of parents are smaller.
int BetweenFrames::trunk_of(int body_a, int body_b) const {
  int a = character_.bodies()[at(body_a)].joint, b = character_.bodies()[at(body_b)].joint;
  while (a != b) (a > b ? a : b) = character_.joints()[at(std::max(a, b))].parent;
  return a;
}

// Rates of turning add up along the chain; a joint adds to the curve with its own turning and twice with that of those
// before it.
BetweenFrames::Travel BetweenFrames::travel_below(int trunk, int body) const {
  Travel travel;
  double turning = 0.0;
  const std::vector<Link>& links = links_[at(body)];
  std::size_t count = 0;
  while (count < links.size() && links[count].joint != trunk) ++count;
  for (std::size_t i = count; i-- > 0;) {
    const double step = steps_[at(links[i].joint)];
    if (character_.joints()[at(links[i].joint)].kind == JointKind::prismatic) {
      travel.path_m += step;
      travel.curve_m += 2.0 * turning * step;
    } else {
      const double reach_m = links[i].reach_m + farthest_out_m_;
      travel.path_m += step * reach_m;
      travel.curve_m += step * (step + 2.0 * turning) * reach_m;
      turning += step;
    }
  }
  return travel;
}

Rigid BetweenFrames::trunk_from(int trunk, int joint, double time) const {
  Rigid out;
  for (int j = joint; j != trunk; j = character_.joints()[at(j)].parent) {
    const Joint& each = character_.joints()[at(j)];
    out = each.parent_from_joint * motion_between(each, before_.coords, now_.coords, time) * out;
  }
  return out;
}

BetweenFrames::Places BetweenFrames::places(const Search& search, const Frame& frame) const {
  const Rigid from_world = inverse(frame.world[at(search.trunk)]);
  const auto place = [&](int body) { return from_world * frame.world[at(character_.bodies()[at(body)].joint)]; };
  return {place(search.pair.body_a), place(search.pair.body_b)};
}

BetweenFrames::Moment BetweenFrames::moment(const Search& search, double time, const Places& places) const {
  return {time, moved(places.a, own_[at(search.colliders.a)]), moved(places.b, own_[at(search.colliders.b)]), 0.0};
}

// What is farther apart than the paths are long cannot meet: how much farther does not matter.
void BetweenFrames::Search::measure(Moment& moment) const {
  moment.distance_m = signed_distance(moment.a, moment.b, path_m());
}

// What is less deep than this is not looked for.
double BetweenFrames::Search::enough_m() const { return std::min(least_m, 0.0) - kMissed_m; }

// How far paths bend from straight ones between two moments.
double BetweenFrames::Search::sag_m(const Moment& from, const Moment& to) const {
  const double share = to.time - from.time;
  return 0.125 * (a.curve_m + b.curve_m) * share * share;
}

// The distance is never less than the gap along any one direction, and that would lie between those of the two moments
// if all paths were straight.
bool BetweenFrames::Search::is_proved_by(const Vec3& n, const Moment& from, const Moment& to) const {
  return std::min(gap_along(from.a, from.b, n), gap_along(to.a, to.b, n)) - sag_m(from, to) >= enough_m();
}

// Or it cannot fall by more than the paths are long.
bool BetweenFrames::Search::is_proved(const Moment& from, const Moment& to) const {
  if (!(0.5 * (from.distance_m + to.distance_m - path_m() * (to.time - from.time)) < enough_m())) return true;
  if (std::min(from.distance_m, to.distance_m) - sag_m(from, to) < enough_m()) return false;
  return is_proved_by(way_out(to.a, to.b), from, to);
}

// Going by the balls around two colliders.
bool BetweenFrames::may_overlap(const Search& search) const {
  const Solid &a = own_[at(search.colliders.a)], &b = own_[at(search.colliders.b)];
  const auto gap_m = [&](const Places& p) {
    return length(p.a * a.center_m - p.b * b.center_m) - a.bound_m - b.bound_m;
  };
  return 0.5 * (gap_m(search.before) + gap_m(search.now) - search.path_m()) < search.enough_m();
}

void BetweenFrames::halve(Search& search, const Moment& from, const Moment& to, int level) const {
  if (search.is_proved(from, to) || level == kMostHalvings) return;
  const double time = 0.5 * (from.time + to.time);
  const auto place = [&](int body) { return trunk_from(search.trunk, character_.bodies()[at(body)].joint, time); };
  Moment middle = moment(search, time, {place(search.pair.body_a), place(search.pair.body_b)});
  search.measure(middle);
  if (middle.distance_m < search.enough_m()) search.least_m = middle.distance_m;
  halve(search, from, middle, level + 1);
  halve(search, middle, to, level + 1);
}

// Mostly the direction that parted the colliders when they were last measured still does.
void BetweenFrames::search_colliders(Search& search, Vec3& direction) const {
  if (!may_overlap(search)) return;
  Moment from = moment(search, 0.0, search.before), to = moment(search, 1.0, search.now);
  if (direction != Vec3(0.0) && search.is_proved_by(search.now.a.q * direction, from, to)) return;
  search.measure(from), search.measure(to);
  direction = glm::conjugate(search.now.a.q) * way_out(to.a, to.b);
  halve(search, from, to, 0);
}

bool BetweenFrames::may_overlap(const JudgedPair& pair, double before_m, double now_m) const {
  const double path_m = travels_m_[at(pair.body_a)] + travels_m_[at(pair.body_b)];
  return 0.5 * (before_m + now_m - path_m) < std::min({before_m, now_m, 0.0}) - kMissed_m;
}

double BetweenFrames::least_distance(const JudgedPair& pair, double before_m, double now_m) {
  Search search{pair, trunk_of(pair.body_a, pair.body_b), {}, {}, {}, {}, std::min(before_m, now_m)};
  search.a = travel_below(search.trunk, pair.body_a);
  search.b = travel_below(search.trunk, pair.body_b);
  if (!(0.5 * (before_m + now_m - search.path_m()) < search.enough_m())) return search.least_m;
  search.before = places(search, before_), search.now = places(search, now_);
  for (int i = pair.first_pair; i < pair.first_pair + pair.pair_count; ++i) {
    search.colliders = character_.judged_colliders()[at(i)];
    search_colliders(search, directions_[at(i)]);
  }
  return search.least_m;
}

}  // namespace contort
