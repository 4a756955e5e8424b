#include "generator/dynamics/contact_plan.h"

#include <algorithm>
#include <cmath>

#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kCornerNear_m = 0.02;
constexpr double kGives_m = 0.02;   // of toes and heels: a figure without toe joints rolls over the tips of its feet
constexpr double kSlide_m_s = 0.1;  // feet of recorded motion do slide
constexpr double kTouches_s = 0.15;
constexpr double kOn_m = 0.004;  // a foot that bears comes as near to the ground at some time
constexpr double kRise_m_s = 0.03;  // but one that rises has been lifted: to hold it would fight its own leg

struct CornerPlace {
  Vec3 point_m{0.0};
  Vec3 normal{0.0};
  double gap_m = 0.0;
};

bool rests_at(const Vec3& speed, const Vec3& normal) {
  const double rise = glm::dot(speed, normal);
  return std::fabs(rise) < kRise_m_s && glm::dot(speed, speed) - rise * rise < kSlide_m_s * kSlide_m_s;
}

}  // namespace

ContactPlan::ContactPlan(const Character& character, const DynamicFigure& figure, const Environment& environment,
                         const Motion& motion)
    : rate_hz_(motion.rate_hz),
      frame_count_(motion.frame_count),
      sole_count_(static_cast<int>(figure.soles.size())),
      bearings_(at(frame_count_) * figure.soles.size()) {
  std::vector<Rigid> world(character.joints().size());
  std::vector<CornerPlace> places;
  for (int f = 0; f < frame_count_; ++f) {
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    for (const Sole& sole : figure.soles) {
      soles_.push_back(world[at(sole.link)] * sole.link_from_sole);
      for (const Vec3& corner : sole.corners_m) {
        const Vec3 point = world[at(sole.link)] * corner;
        const Surface ground = environment.nearest_ground(point);
        places.push_back({point, ground.normal, ground.distance_m});
      }
    }
  }
  const int per_frame = 4 * sole_count_;
  // A corner keeps its place from the frame in which it lands to the one in which it leaves.
  const auto rests = [&](int from, int to, int i) {
    if (from < 0 || to >= frame_count_) return false;
    const CornerPlace& a = places[at(from * per_frame + i)];
    return rests_at(rate_hz_ * (places[at(to * per_frame + i)].point_m - a.point_m), a.normal);
  };
  for (int f = 0; f < frame_count_; ++f)
    for (int i = 0; i < per_frame; ++i)
      if (std::fabs(places[at(f * per_frame + i)].gap_m) < kCornerNear_m &&
          (frame_count_ == 1 || rests(f - 1, f, i) || rests(f, f + 1, i)))
        bearings_[index(f, i / 4)].corners |= static_cast<std::uint8_t>(1U << (i % 4));
  std::vector<double> lowest_m;  // frames x soles
  for (int f = 0; f < frame_count_; ++f)
    for (int s = 0; s < sole_count_; ++s) {
      double low_m = places[at(f * per_frame + 4 * s)].gap_m, high_m = low_m;
      for (int k = 1; k < 4; ++k) {
        const double gap_m = places[at(f * per_frame + 4 * s + k)].gap_m;
        low_m = std::min(low_m, gap_m), high_m = std::max(high_m, gap_m);
      }
      lowest_m.push_back(low_m);
      bearings_[index(f, s)].depth = high_m > kGives_m ? kGives_m / high_m : 1.0;
    }
  for (int s = 0; s < sole_count_; ++s) drop_touches(s, lowest_m);
  count_airborne();
}

// A foot on its way that touches the ground with an edge for a moment, or is slow above it, bears nothing while another
// foot stands.
void ContactPlan::drop_touches(int sole, std::span<const double> lowest_m) {
  for (int f = 0, end = 0; f < frame_count_; f = end + 1) {
    bool is_flat = false, is_on_ground = false, others_stand = true;
    for (end = f; end < frame_count_ && bearing(end, sole).corners != 0; ++end) {
      is_flat = is_flat || bearing(end, sole).corners == kAllCorners;
      is_on_ground = is_on_ground || lowest_m[index(end, sole)] < kOn_m;
      others_stand = others_stand && standing(end) != (1U << sole);
    }
    const bool is_passing = f > 0 && end < frame_count_ && end - f < kTouches_s * rate_hz_ && !is_flat;
    if (!others_stand || (is_on_ground && !is_passing)) continue;
    for (int g = f; g < end; ++g) bearings_[index(g, sole)].corners = 0;
  }
}

std::uint8_t ContactPlan::standing(int frame) const {
  std::uint8_t soles = 0;
  for (int i = 0; i < sole_count_; ++i)
    if (bearing(frame, i).corners != 0) soles |= static_cast<std::uint8_t>(1U << i);
  return soles;
}

// From the frames before, and then from those after.
void ContactPlan::count_airborne() {
  airborne_.assign(bearings_.size(), frame_count_);
  for (int s = 0; s < sole_count_; ++s) {
    int away = frame_count_;
    const auto count = [&](int frame) {
      away = bearing(frame, s).corners != 0 ? 0 : std::min(away + 1, frame_count_);
      airborne_[index(frame, s)] = std::min(airborne_[index(frame, s)], away);
    };
    for (int f = 0; f < frame_count_; ++f) count(f);
    away = frame_count_;
    for (int f = frame_count_; f-- > 0;) count(f);
  }
}

void ContactPlan::move_airborne(const Character& character, const DynamicFigure& figure, const Motion& motion) {
  std::vector<Rigid> world(character.joints().size());
  for (int f = 0; f < frame_count_; ++f) {
    if (standing(f) == (1U << sole_count_) - 1) continue;
    forward_kinematics(character, motion.root[at(f)], motion.row(f), world);
    for (int s = 0; s < sole_count_; ++s)
      if (bearing(f, s).corners == 0)
        soles_[index(f, s)] = world[at(figure.soles[at(s)].link)] * figure.soles[at(s)].link_from_sole;
  }
}

// Catmull and Rom's, a frame. At its ends a sole goes on as it goes beside them, as joints do (TargetMotion).
SoleMotion ContactPlan::slope(int frame, int s) const {
  SoleMotion out;
  const int first = std::max(frame - 1, 0), last = std::min(frame + 1, frame_count_ - 1);
  if (first == last) return out;
  const Rigid &before = sole(first, s), &after = sole(last, s);
  out.linear = (after.p_m - before.p_m) / static_cast<double>(last - first);
  out.angular = to_rotation_vector(after.q * glm::conjugate(before.q)) / static_cast<double>(last - first);
  return out;
}

// Second differences.
SoleMotion ContactPlan::bend(int frame, int s) const {
  SoleMotion out;
  if (frame <= 0 || frame >= frame_count_ - 1) return out;
  const Rigid &before = sole(frame - 1, s), &now = sole(frame, s), &after = sole(frame + 1, s);
  out.linear = after.p_m - 2.0 * now.p_m + before.p_m;
  out.angular =
      to_rotation_vector(after.q * glm::conjugate(now.q)) + to_rotation_vector(before.q * glm::conjugate(now.q));
  return out;
}

void ContactPlan::acceleration_at(double frame, int s, Vec3& linear, Vec3& angular) const {
  const double last = frame_count_ - 1, clamped = std::clamp(frame, 0.0, last);
  const int before = std::min(static_cast<int>(std::floor(clamped)), std::max(frame_count_ - 2, 0));
  const SoleMotion from = bend(before, s), to = bend(std::min(before + 1, frame_count_ - 1), s);
  const double u = clamped - before, rate2 = rate_hz_ * rate_hz_;
  linear = rate2 * (from.linear + u * (to.linear - from.linear));
  angular = rate2 * (from.angular + u * (to.angular - from.angular));
}

SoleMotion ContactPlan::sole_at(double frame, int s) const {
  const double last = frame_count_ - 1;
  const double clamped = std::clamp(frame, 0.0, last);
  const int before = std::min(static_cast<int>(std::floor(clamped)), std::max(frame_count_ - 2, 0));
  const int after = std::min(before + 1, frame_count_ - 1);
  const double u = clamped - before, per_s = rate_hz_;
  const Rigid &from = sole(before, s), &to = sole(after, s);
  const SoleMotion m0 = slope(before, s), m1 = slope(after, s);
  const double a0 = u * (1 - u) * (1 - u), a1 = -u * u * (1 - u), b = u * u * (3 - 2 * u);
  const double d0 = (1 - u) * (1 - 3 * u), d1 = u * (3 * u - 2), db = 6 * u * (1 - u);
  const Vec3 way = to.p_m - from.p_m, turn = to_rotation_vector(to.q * glm::conjugate(from.q));
  SoleMotion out;
  out.world_from_sole.p_m = from.p_m + b * way + a0 * m0.linear + a1 * m1.linear;
  out.linear = per_s * (db * way + d0 * m0.linear + d1 * m1.linear);
  // Turns of one frame are small: their rotation vectors add.
  out.world_from_sole.q = from_rotation_vector(b * turn + a0 * m0.angular + a1 * m1.angular) * from.q;
  out.angular = per_s * (db * turn + d0 * m0.angular + d1 * m1.angular);
  return out;
}

}  // namespace contort
