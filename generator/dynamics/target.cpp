#include "generator/dynamics/target.h"

#include <algorithm>
#include <cmath>

#include "generator/dynamics/rotation_rates.h"

namespace contort {

namespace {

void put(const Quat& q, double* out) { out[0] = q.w, out[1] = q.x, out[2] = q.y, out[3] = q.z; }

// The cubic from a to b over one frame with slopes m0 and m1 a frame: value and slope.
struct Cubic {
  double value, slope;
};
Cubic cubic(double a, double b, double m0, double m1, double u) {
  const double d = b - a;
  const double c2 = 3.0 * d - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * d;
  return {a + u * (m0 + u * (c2 + u * c3)), m0 + u * (2.0 * c2 + u * 3.0 * c3)};
}

}  // namespace

TargetMotion::TargetMotion(const Multibody& body, const Motion& motion)
    : rate_hz_(motion.rate_hz), frame_count_(motion.frame_count), coord_count_(motion.coord_count + 7) {
  for (int f = 0; f < frame_count_; ++f) {
    const Rigid& root = motion.root[static_cast<std::size_t>(f)];
    coords_.insert(coords_.end(), motion.row(f).begin(), motion.row(f).end());
    coords_.insert(coords_.end(), {root.p_m.x, root.p_m.y, root.p_m.z, root.q.w, root.q.x, root.q.y, root.q.z});
  }
  for (const Link& link : body.links()) knots_.push_back(knots_of(link));
}

std::vector<int> TargetMotion::knots_of(const Link& link) const {
  std::vector<int> knots;
  const int coord = link.kind == JointKind::root ? coord_count_ - 4 : link.coord;
  const bool turns = link.kind == JointKind::root || link.kind == JointKind::ball;
  for (int k = 0; k < (turns ? 3 : 1); ++k) {
    std::vector<double> curve;
    for (int f = 0; f < frame_count_; ++f)
      curve.push_back(turns ? to_rotation_vector(quat_at(row(f) + coord))[k] : row(f)[coord]);
    knots = merged_knots(knots, find_knots(curve));
  }
  return knots;
}

TargetMotion::Between TargetMotion::between(double frame) const {
  const double clamped = std::clamp(frame, 0.0, static_cast<double>(frame_count_ - 1));
  const int before = std::min(static_cast<int>(std::floor(clamped)), std::max(frame_count_ - 2, 0));
  const bool stands = frame < 0.0 || frame > frame_count_ - 1 || frame_count_ < 2;
  return {before, std::min(before + 1, frame_count_ - 1), clamped - before, stands ? 0.0 : rate_hz_};
}

// The way to the inside of the motion from a frame at its end, 0 from other frames.
int TargetMotion::inward(int frame) const {
  if (frame_count_ < 4) return 0;
  return frame == 0 ? 1 : frame == frame_count_ - 1 ? -1 : 0;
}

// Half of the way from the frame before to the one after: Catmull and Rom's slope. At its ends the motion goes on as it
// goes beside them: a target is a piece of a longer motion, and a figure that had to start or stop within a frame would
// need any force. Motions of less than four frames stand still at their ends.
double TargetMotion::slope(int frame, int coord) const {
  if (const int way = inward(frame))
    return way * (row(frame + way)[coord] - row(frame)[coord]) - 0.5 * way * bend(frame + way, coord);
  if (frame == 0 || frame == frame_count_ - 1) return 0.0;
  return 0.5 * (row(frame + 1)[coord] - row(frame - 1)[coord]);
}

Vec3 TargetMotion::turn_slope(int frame, int coord) const {
  if (const int way = inward(frame)) {
    const Quat from = glm::conjugate(quat_at(row(frame) + coord));
    const Vec3 turn = to_rotation_vector(from * quat_at(row(frame + way) + coord));
    return static_cast<double>(way) * (turn - 0.5 * turn_bend(frame + way, coord));
  }
  if (frame == 0 || frame == frame_count_ - 1) return Vec3(0.0);
  return 0.5 * to_rotation_vector(glm::conjugate(quat_at(row(frame - 1) + coord)) * quat_at(row(frame + 1) + coord));
}

void TargetMotion::joint_at(const Link& link, double frame, double* coords, double* rates) const {
  const Between at = between(frame);
  if (link.kind == JointKind::ball) return ball_at(link.coord, at, coords, rates);
  const Cubic now = cubic(row(at.frame)[link.coord], row(at.next)[link.coord], slope(at.frame, link.coord),
                          slope(at.next, link.coord), at.share);
  coords[0] = now.value, rates[0] = at.per_s * now.slope;
}

// The same in the rotation vector from the frame before.
void TargetMotion::ball_at(int coord, const Between& at, double* coords, double* rates) const {
  const Quat from = quat_at(row(at.frame) + coord), to = quat_at(row(at.next) + coord);
  const Vec3 way = to_rotation_vector(glm::conjugate(from) * to);
  const Vec3 m0 = turn_slope(at.frame, coord), m1 = rotation_vector_rate(way, turn_slope(at.next, coord));
  Vec3 turn, rate;
  for (int k = 0; k < 3; ++k) {
    const Cubic now = cubic(0.0, way[k], m0[k], m1[k], at.share);
    turn[k] = now.value, rate[k] = at.per_s * now.slope;
  }
  put(glm::normalize(from * from_rotation_vector(turn)), coords);
  const Vec3 angular = angular_velocity_of(turn, rate);
  for (int k = 0; k < 3; ++k) rates[k] = angular[k];
}

Link TargetMotion::root_travel(int axis) const {
  Link place;
  place.kind = JointKind::prismatic, place.coord = coord_count_ - 7 + axis, place.dof_count = 1;
  return place;
}

Link TargetMotion::root_turn() const {
  Link turn;
  turn.kind = JointKind::ball, turn.coord = coord_count_ - 4, turn.dof_count = 3;
  return turn;
}

void TargetMotion::root_at(double frame, Rigid& world_from_root, double* velocity) const {
  for (int k = 0; k < 3; ++k) joint_at(root_travel(k), frame, &world_from_root.p_m[k], velocity + k);
  double q[4];
  joint_at(root_turn(), frame, q, velocity + 3);
  world_from_root.q = quat_at(q);
}

// Second differences; at the ends those of the frame beside.
double TargetMotion::bend(int frame, int coord) const {
  frame += inward(frame);
  if (frame <= 0 || frame >= frame_count_ - 1) return 0.0;
  return row(frame + 1)[coord] - 2.0 * row(frame)[coord] + row(frame - 1)[coord];
}

Vec3 TargetMotion::turn_bend(int frame, int coord) const {
  frame += inward(frame);
  if (frame <= 0 || frame >= frame_count_ - 1) return Vec3(0.0);
  const Quat from = glm::conjugate(quat_at(row(frame) + coord));
  return to_rotation_vector(from * quat_at(row(frame + 1) + coord)) +
         to_rotation_vector(from * quat_at(row(frame - 1) + coord));
}

void TargetMotion::joint_acceleration_at(const Link& link, double frame, double* acceleration) const {
  const Between at = between(frame);
  const double per_s2 = at.per_s * at.per_s;
  if (link.kind == JointKind::ball) {
    const Vec3 from = turn_bend(at.frame, link.coord), to = turn_bend(at.next, link.coord);
    for (int k = 0; k < 3; ++k) acceleration[k] = per_s2 * (from[k] + at.share * (to[k] - from[k]));
    return;
  }
  const double from = bend(at.frame, link.coord), to = bend(at.next, link.coord);
  acceleration[0] = per_s2 * (from + at.share * (to - from));
}

void TargetMotion::root_bend(int frame, double* bends) const {
  const int coord = coord_count_ - 7;
  const Vec3 turn = turn_bend(frame, coord + 3);
  for (int k = 0; k < 3; ++k) bends[k] = bend(frame, coord + k), bends[3 + k] = turn[k];
}

void TargetMotion::root_acceleration_at(double frame, double* acceleration) const {
  const Between at = between(frame);
  double from[kRootDofs], to[kRootDofs];
  root_bend(at.frame, from), root_bend(at.next, to);
  for (int k = 0; k < kRootDofs; ++k) acceleration[k] = at.per_s * at.per_s * (from[k] + at.share * (to[k] - from[k]));
}

void TargetMotion::share_knots(const std::vector<int>& links) {
  std::vector<int> all;
  for (const int link : links) all = merged_knots(all, knots(link));
  for (const int link : links) knots_[static_cast<std::size_t>(link)] = all;
}

}  // namespace contort
