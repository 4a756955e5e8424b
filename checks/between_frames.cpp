#include "checks/between_frames.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"
#include "model/core/math.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kMissed_m = 0.001;   // a penetration that is deeper by no more than this may be missed
constexpr int kMostHalvings = 8;      // 256 parts of the time between two frames
constexpr int kMostStraightened = 3;  // this many halvings use one direction, before distances are measured anew
constexpr double kMoments = 1 << kMostHalvings;

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

}  // namespace

BetweenFrames::BetweenFrames(const Character& character) : character_(character) {
  for (const Collider& collider : character.colliders()) own_.push_back(solid_of(collider));
  for (const Body& body : character.bodies()) add_links(body);
  first_links_.push_back(links_.size());
  directions_.resize(character.judged_colliders().size(), Vec3(0.0));
  steps_.resize(character.joints().size());
  poses_.resize(static_cast<std::size_t>(kMoments));
  paths_m_.resize(links_.size() + character.bodies().size());
  for (const JudgedPair& pair : character.judged_pairs()) {
    const int trunk = trunk_of(pair.body_a, pair.body_b);
    const auto path = [&](int body) { return first_links_[at(body)] + at(body) + links_below(trunk, body); };
    chains_.push_back({trunk, path(pair.body_a), path(pair.body_b)});
  }
}

void BetweenFrames::add_links(const Body& body) {
  double reach_m = 0.0;
  for (int c = body.first_collider; c < body.first_collider + body.collider_count; ++c)
    reach_m = std::max(reach_m, length(own_[at(c)].center_m) + own_[at(c)].bound_m);
  first_links_.push_back(links_.size());
  for (int j = body.joint; j > 0; j = character_.joints()[at(j)].parent) {
    const Joint& joint = character_.joints()[at(j)];
    links_.push_back({j, reach_m, joint.kind == JointKind::prismatic});
    reach_m += length(joint.parent_from_joint.p_m);
  }
}

std::size_t BetweenFrames::links_below(int trunk, int body) const {
  std::size_t end = first_links_[at(body)];
  while (end < first_links_[at(body) + 1] && links_[end].joint != trunk) ++end;
  return end - first_links_[at(body)];
}

double BetweenFrames::step_of(const Joint& joint) const {
  if (joint.kind == JointKind::ball)
    return rotation_angle(glm::conjugate(ball_at(before_.coords, joint)) * ball_at(now_.coords, joint));
  const double step = std::fabs(now_.coords[at(joint.coord)] - before_.coords[at(joint.coord)]);
  return joint.kind == JointKind::hinge && !(step <= kPi) ? std::fabs(wrap_angle(step)) : step;
}

void BetweenFrames::set(const Frame& before, const Frame& now) {
  before_ = before, now_ = now, ++interval_;
  farthest_out_m_ = 0.0;
  const std::span<const Joint> joints = character_.joints();
  for (std::size_t j = 1; j < joints.size(); ++j) {
    steps_[j] = step_of(joints[j]);
    const std::size_t coord = at(joints[j].coord);
    if (joints[j].kind == JointKind::prismatic)
      farthest_out_m_ += std::max(std::fabs(before.coords[coord]), std::fabs(now.coords[coord]));
  }
  add_paths();
}

// If the root's place is not finite, all paths are NaN.
void BetweenFrames::add_paths() {
  const Rigid &from = before_.world[0], &to = now_.world[0];
  const Vec3 places = from.p_m + to.p_m;
  const double poison = places.x + places.y + places.z + glm::dot(from.q, to.q);
  for (std::size_t b = 0; b + 1 < first_links_.size(); ++b) {
    double path_m = poison - poison;
    double* out = &paths_m_[first_links_[b] + b];
    *out++ = path_m;
    for (std::size_t i = first_links_[b]; i < first_links_[b + 1]; ++i)
      *out++ = path_m += steps_[at(links_[i].joint)] * links_[i].path_m(farthest_out_m_);
  }
}

void BetweenFrames::paths_m(std::span<double> out) const {
  const double* paths = paths_m_.data();
  const Chains* chains = chains_.data();
  for (double& path_m : out) path_m = paths[chains->a] + paths[chains->b], ++chains;
}

// The first joint that both bodies hang on: indices of parents are smaller.
int BetweenFrames::trunk_of(int body_a, int body_b) const {
  int a = character_.bodies()[at(body_a)].joint, b = character_.bodies()[at(body_b)].joint;
  while (a != b) (a > b ? a : b) = character_.joints()[at(std::max(a, b))].parent;
  return a;
}

// Turning rates add up along the chain. The curvature bound of a joint is its own turning rate plus twice the rates of
// the joints before it.
BetweenFrames::Travel BetweenFrames::travel_below(int trunk, int body) const {
  Travel travel;
  double turning = 0.0;
  const std::span<const Link> links = std::span(links_).subspan(first_links_[at(body)], links_below(trunk, body));
  for (std::size_t i = links.size(); i-- > 0;) {
    const double step = steps_[at(links[i].joint)];
    if (links[i].slides) {
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

// Cached: all searched pairs use the same moments, and share most joints on the chain to the root.
const Rigid& BetweenFrames::root_from(Pose& pose, int joint) const {
  if (pose.is_known[at(joint)] != 0 || joint == 0) return pose.root_from[at(joint)];
  const Joint& each = character_.joints()[at(joint)];
  pose.is_known[at(joint)] = 1;
  return pose.root_from[at(joint)] = root_from(pose, each.parent) * each.parent_from_joint *
                                     motion_between(each, before_.coords, now_.coords, pose.time);
}

BetweenFrames::Pose& BetweenFrames::pose_at(double time) {
  Pose& pose = poses_[static_cast<std::size_t>(time * kMoments)];
  if (pose.interval == interval_) return pose;
  pose.interval = interval_, pose.time = time;
  pose.root_from.resize(character_.joints().size());
  pose.is_known.assign(character_.joints().size(), 0);
  return pose;
}

BetweenFrames::Places BetweenFrames::places(const Search& search, const Frame& frame) const {
  const Rigid from_world = inverse(frame.world[at(search.trunk)]);
  const auto place = [&](int body) { return from_world * frame.world[at(character_.bodies()[at(body)].joint)]; };
  return {place(search.pair.body_a), place(search.pair.body_b)};
}

BetweenFrames::Moment BetweenFrames::moment(const Search& search, double time, const Places& places) const {
  const auto& [a, b] = search.colliders;
  return {time, moved(places.a, own_[at(a)]), moved(places.b, own_[at(b)]), 0.0, Vec3(0.0)};
}

// Bodies that are farther apart than the sum of their paths cannot meet, so greater distances are not measured exactly.
void BetweenFrames::Search::measure(Moment& moment) const {
  moment.distance_m = signed_distance(moment.a, moment.b, path_m(), moment.way);
}

// The search ignores overlaps that are not deeper than this.
double BetweenFrames::Search::enough_m() const { return std::min(least_m, 0.0) - kMissed_m; }

// The greatest distance between a path and the straight line, between two moments.
double BetweenFrames::Search::sag_m(const Moment& from, const Moment& to) const {
  const double share = to.time - from.time;
  return 0.125 * (a.curve_m + b.curve_m) * share * share;
}

// Returns true if the bodies cannot overlap. It bounds their distance from below by the gap along n. For straight paths
// that gap lies between its values at both moments.
bool BetweenFrames::is_parted_along(const Search& search, const Vec3& n, const Moment& from, const Moment& to,
                                    int halvings) {
  const double gap_m = std::min(gap_along(from.a, from.b, n), gap_along(to.a, to.b, n));
  if (gap_m - search.sag_m(from, to) >= search.enough_m()) return true;
  if (!(gap_m >= search.enough_m()) || halvings == 0) return false;
  const Moment middle = middle_of(search, from, to);
  return is_parted_along(search, n, from, middle, halvings - 1) && is_parted_along(search, n, middle, to, halvings - 1);
}

// Returns true if the bodies can come near enough: the distance can shrink at most by the length of their paths.
bool BetweenFrames::Search::is_near(const Moment& from, const Moment& to) const {
  return 0.5 * (from.distance_m + to.distance_m - path_m() * (to.time - from.time)) < enough_m();
}

// Tests the bounding spheres of two colliders.
bool BetweenFrames::may_overlap(const Search& search) const {
  const Solid &a = own_[at(search.colliders.a)], &b = own_[at(search.colliders.b)];
  const auto gap_m = [&](const Places& p) {
    return length(p.a * a.center_m - p.b * b.center_m) - a.bound_m - b.bound_m;
  };
  return 0.5 * (gap_m(search.before) + gap_m(search.now) - search.path_m()) < search.enough_m();
}

BetweenFrames::Moment BetweenFrames::middle_of(const Search& search, const Moment& from, const Moment& to) {
  Pose& pose = pose_at(0.5 * (from.time + to.time));
  const Rigid trunk_from_root = inverse(root_from(pose, search.trunk));
  const auto place = [&](int body) { return trunk_from_root * root_from(pose, character_.bodies()[at(body)].joint); };
  return moment(search, pose.time, {place(search.pair.body_a), place(search.pair.body_b)});
}

void BetweenFrames::halve(Search& search, const Moment& from, const Moment& to, int level) {
  if (!search.is_near(from, to) || level == kMostHalvings) return;
  const int straightened = std::min(kMostStraightened, kMostHalvings - level);
  if (is_parted_along(search, way_out_of_deeper(from, to), from, to, straightened)) return;
  Moment middle = middle_of(search, from, to);
  search.measure(middle);
  if (middle.distance_m < search.enough_m()) search.least_m = middle.distance_m;
  halve(search, from, middle, level + 1);
  halve(search, middle, to, level + 1);
}

// The direction that separates the colliders at the deeper of the two moments. Along another direction the gap would be
// smaller.
Vec3 BetweenFrames::way_out_of_deeper(const Moment& from, const Moment& to) {
  const Moment& deeper = from.distance_m < to.distance_m ? from : to;
  return deeper.way != Vec3(0.0) ? deeper.way : way_out(deeper.a, deeper.b);
}

// Tests first the direction that separated the colliders at their last measurement: it mostly still does.
void BetweenFrames::search_colliders(Search& search, Vec3& direction) {
  if (!may_overlap(search)) return;
  Moment from = moment(search, 0.0, search.before), to = moment(search, 1.0, search.now);
  if (direction != Vec3(0.0) && is_parted_along(search, search.now.a.q * direction, from, to, kMostStraightened))
    return;
  search.measure(from), search.measure(to);
  direction = glm::conjugate(search.now.a.q) * way_out_of_deeper(from, to);
  halve(search, from, to, 0);
}

bool BetweenFrames::may_overlap(std::size_t judged, double before_m, double now_m) const {
  return 0.5 * (before_m + now_m - path_m(judged)) < std::min({before_m, now_m, 0.0}) - kMissed_m;
}

double BetweenFrames::least_distance(std::size_t judged, double before_m, double now_m) {
  const JudgedPair& pair = character_.judged_pairs()[judged];
  Search search{pair, chains_[judged].trunk, {}, {}, {}, {}, std::min(before_m, now_m)};
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
