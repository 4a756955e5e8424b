#include "generator/motion/plant_feet.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/foot_rests.h"
#include "generator/motion/foot_roll.h"
#include "generator/motion/low_pass.h"
#include "generator/motion/lowering.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/soft_height.h"
#include "generator/motion/walk_on_spot.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// The cutoff in Hz for each rad/s of the legs as pendulums: 6 Hz for people.
constexpr double kCutoff = 1.77;
constexpr double kStretch = 0.99;            // of a leg, at most
constexpr int kLowerings = 4;
constexpr double kLevel_rad = 1.0 * kRadPerDeg;   // tilts of a foot below this count as flat
constexpr double kRolls_rad = 4.0 * kRadPerDeg;   // tilts above this are kept
constexpr double kMostRoll_rad = 60.0 * kRadPerDeg;
constexpr double kSmooth_s = 0.1;
constexpr double kSwingHeight_m = 0.015;  // of feet in the air
constexpr double kLifts = 0.25;           // which they reach in this share of a radian of their leg as a pendulum
constexpr double kFades_s = 0.2;  // speed and acceleration of a correction, after and before a rest

// The difference between the wanted place of a sole and its path.
struct Offset {
  Vec3 shift_m{0.0};
  Vec3 turn_rad{0.0};
  Offset operator+(const Offset& o) const { return {shift_m + o.shift_m, turn_rad + o.turn_rad}; }
  Offset operator-(const Offset& o) const { return {shift_m - o.shift_m, turn_rad - o.turn_rad}; }
};
Offset operator*(double share, const Offset& o) { return {share * o.shift_m, share * o.turn_rad}; }

Offset offset_of(const Rigid& wanted, const Rigid& path) {
  return {wanted.p_m - path.p_m, to_rotation_vector(wanted.q * glm::conjugate(path.q))};
}

// An offset at the end of a rest, with its rate and its second difference, per frame.
struct OffsetEnd {
  Offset value, rate, bend;
};

// The quintics that begin with rate 1 or bend 1 and end with nothing; u in [0, 1].
double rate_shape(double u) { return u * (1.0 - u * u * (6.0 - u * (8.0 - 3.0 * u))); }
double bend_shape(double u) { return 0.5 * u * u * (1.0 - u * (3.0 - u * (3.0 - u))); }

Offset fading(const OffsetEnd& end, double frames, double window) {
  const double u = frames / window;
  return u >= 1.0 ? Offset{} : (window * rate_shape(u)) * end.rate + (window * window * bend_shape(u)) * end.bend;
}

// 0 for tilts that count as flat, the tilt itself for those that are kept; smooth between.
double kept_tilt_rad(double tilt_rad) {
  const double u = std::clamp((tilt_rad - kLevel_rad) / (kRolls_rad - kLevel_rad), 0.0, 1.0);
  return std::min(u * u * (3.0 - 2.0 * u) * tilt_rad, kMostRoll_rad);
}

// A flat sole on the ground at a point, with this direction of its toes.
Rigid flat_sole(const Environment& environment, const Vec3& point_m, const Vec3& forward) {
  const GroundBelow ground = ground_below(environment, point_m);
  const Quat upright = shortest_arc(Vec3(0, 1, 0), ground.normal);
  const Vec3 ahead = upright * Vec3(0, 0, 1);
  const double heading = det::atan2(glm::dot(ground.normal, glm::cross(ahead, forward)), glm::dot(ahead, forward));
  return {axis_angle(ground.normal, heading) * upright, point_m - Vec3(0.0, ground.height_m, 0.0)};
}

// Plants one leg's foot.
class FootPlanter {
 public:
  FootPlanter(const Leg& leg, const Environment& environment, double rate_hz, std::span<const FootRest> rests,
              SolePath path)
      : leg_(leg), environment_(environment), rate_hz_(rate_hz), rests_(rests), path_(std::move(path)) {}

  // The wanted place of the sole by frame.
  SolePath plant() {
    straighten();
    settle();
    wanted_ = path_;
    for (const FootRest& rest : rests_) put(rest);
    for (std::size_t i = 0; i <= rests_.size(); ++i) swing(i);
    return wanted_;
  }

 private:
  // Visits the frames of a rest in which the foot lies flat; if there are none, all frames.
  template <typename Visit>
  static void visit_flat(const FootRest& rest, const Visit& visit) {
    for (const int f : rest.flat) visit(f);
    for (int f = rest.first; f <= rest.last && rest.flat.empty(); ++f) visit(f);
  }

  // A foot that is tilted whenever it lies flat is tilted by the skeleton that it comes from. It turns about its ankle.
  void straighten() {
    Vec3 up(0.0);
    for (const FootRest& rest : rests_)
      for (const int f : rest.flat)
        up += glm::conjugate(path_[at(f)].q) * ground_below(environment_, path_[at(f)].p_m).normal;
    if (up == Vec3(0.0)) return;
    const Quat straight = shortest_arc(Vec3(0, 1, 0), glm::normalize(up));
    const Rigid about_ankle{straight, leg_.sole_from_ankle - straight * leg_.sole_from_ankle};
    for (Rigid& sole : path_) sole = sole * about_ankle;
  }

  // Moves the path down or up so that the sole is on the ground, on average, while it rests.
  void settle() {
    double height_m = 0.0, count = 0.0;
    for (const FootRest& rest : rests_)
      visit_flat(rest, [&](int f) { height_m += lower_end(f).height_m, count += 1.0; });
    if (count == 0.0) return;
    for (Rigid& sole : path_) sole.p_m.y -= height_m / count;
  }

  GroundBelow lower_end(int frame) const {
    const Rigid& sole = path_[at(frame)];
    return ground_below(environment_, sole * lower_end_m(leg_, sole));
  }

  // Gives a rest one place, over which the foot rolls as recorded.
  void put(const FootRest& rest) {
    Vec3 point_m(0.0), forward(0.0);
    double count = 0.0;
    visit_flat(rest, [&](int f) {
      point_m += path_[at(f)].p_m, forward += path_[at(f)].q * Vec3(0, 0, 1), count += 1.0;
    });
    const Rigid flat = flat_sole(environment_, point_m / count, forward);
    const Vec3 up = flat.q * Vec3(0, 1, 0);
    for (int f = rest.first; f <= rest.last; ++f) {
      const double toes_up_rad = det::asin(std::clamp(glm::dot(up, path_[at(f)].q * Vec3(0, 0, 1)), -1.0, 1.0));
      wanted_[at(f)] = flat * rolled_sole(leg_, kept_tilt_rad(-toes_up_rad), kept_tilt_rad(toes_up_rad));
    }
  }

  Offset offset(int frame) const { return offset_of(wanted_[at(frame)], path_[at(frame)]); }

  // One-sided differences: into the rest from its last (step -1) or first (step 1) frame, in the direction of time
  // away from it.
  OffsetEnd end_of(const FootRest& rest, int frame, int step) const {
    OffsetEnd end{offset(frame), {}, {}};
    if (rest.last - rest.first < 2) return end;
    const Offset one = offset(frame + step), two = offset(frame + 2 * step);
    end.bend = two - 2.0 * one + end.value;
    end.rate = 0.5 * (3.0 * end.value - 4.0 * one + two);
    return end;
  }

  // The way between the rest before index i and rest i; one of them may be missing.
  void swing(std::size_t i) {
    if (rests_.empty()) return;
    const bool has_before = i > 0, has_after = i < rests_.size();
    const int first = has_before ? rests_[i - 1].last : -1;
    const int last = has_after ? rests_[i].first : static_cast<int>(path_.size());
    const OffsetEnd after = has_after ? end_of(rests_[i], last, 1) : OffsetEnd{};
    const OffsetEnd before = has_before ? end_of(rests_[i - 1], first, -1) : OffsetEnd{};
    const double window = std::max(1.0, std::min(0.5 * (last - first), kFades_s * rate_hz_));
    for (int f = first + 1; f < last; ++f) {
      const double way = static_cast<double>(f - first) / (last - first);
      const double share = !has_before ? 1.0 : !has_after ? 0.0 : minimum_jerk(way);
      const Offset o = (1.0 - share) * before.value + share * after.value + fading(before, f - first, window) +
                       fading(after, last - f, window);
      wanted_[at(f)] = {from_rotation_vector(o.turn_rad) * path_[at(f)].q, path_[at(f)].p_m + o.shift_m};
    }
    clear_ground(first + 1, last);
  }

  // Raises a foot in the air, [first, end), where it would touch the ground; less near the rests before and after.
  void clear_ground(int first, int end) {
    const double frames = kLifts / pendulum_rad_s(leg_) * rate_hz_;
    const auto near = [&](int f) { return minimum_jerk(std::min({1.0, (f - first + 1) / frames, (end - f) / frames})); };
    std::vector<double> missing_m;
    for (int f = first; f < end; ++f) {
      const Rigid& sole = wanted_[at(f)];
      const double height_m = ground_below(environment_, sole * lower_end_m(leg_, sole)).height_m;
      missing_m.push_back(std::max(0.0, near(f) * kSwingHeight_m - height_m));
    }
    const std::vector<double> up_m = soft_envelope(static_cast<int>(frames), missing_m);
    for (int f = first; f < end; ++f) wanted_[at(f)].p_m.y += near(f) * up_m[at(f - first)];
  }

  const Leg& leg_;
  const Environment& environment_;
  const double rate_hz_;
  const std::span<const FootRest> rests_;
  SolePath path_;
  SolePath wanted_;
};

class MotionPlanter {
 public:
  MotionPlanter(const Character& character, std::span<const Leg> legs, const Environment& environment, Motion& motion)
      : character_(character), legs_(legs), environment_(environment), motion_(motion) {}

  void run() {
    if (legs_.empty()) return;
    std::vector<SolePath> given = sole_paths(character_, legs_, motion_);
    walk_on(belt_velocity_m_s(legs_, given, environment_, motion_), given);
    for (std::size_t i = 0; i < legs_.size(); ++i)
      rests_.push_back(find_rests(legs_[i], given[i], environment_, motion_.rate_hz));
    remove_jumps(character_, motion_);
    low_pass(character_, cutoff_hz(), motion_);
    paths_ = sole_paths(character_, legs_, motion_);
    stop_slides();
    for (std::size_t i = 0; i < legs_.size(); ++i)
      wanted_.push_back(FootPlanter(legs_[i], environment_, motion_.rate_hz, rests_[i], paths_[i]).plant());
    raise();
    missing_m_.resize(at(motion_.frame_count));
    place_legs();
    for (int again = 0; again < kLowerings && lower_softly(missing_m_, motion_); ++again) place_legs();
  }

 private:
  // A walk on the spot goes on over ground that stands.
  void walk_on(const Vec3& belt_m_s, std::span<SolePath> paths) {
    if (belt_m_s == Vec3(0.0)) return;
    for (int f = 0; f < motion_.frame_count; ++f) {
      const Vec3 way_m = (-f / motion_.rate_hz) * belt_m_s;
      motion_.root[at(f)].p_m += way_m;
      for (SolePath& path : paths) path[at(f)].p_m += way_m;
    }
  }

  double cutoff_hz() const {
    double mean_rad_s = 0.0;
    for (const Leg& leg : legs_) mean_rad_s += pendulum_rad_s(leg) / static_cast<double>(legs_.size());
    return kCutoff * mean_rad_s;
  }

  // The mean over the feet that lie flat, by frame, of what `value` says of a leg and a frame. Between such frames it
  // goes evenly from one to the next. Empty if no foot ever lies flat.
  template <typename Value>
  std::vector<double> mean_of_flat(const Value& value) const {
    std::vector<double> sum(at(motion_.frame_count), 0.0), count(sum);
    for (std::size_t i = 0; i < legs_.size(); ++i)
      for (const FootRest& rest : rests_[i])
        for (const int f : rest.flat) sum[at(f)] += value(i, f), count[at(f)] += 1.0;
    int before = -1;
    for (int f = 0; f < motion_.frame_count; ++f) {
      if (count[at(f)] == 0.0) continue;
      sum[at(f)] /= count[at(f)];
      const double from = sum[at(before < 0 ? f : before)];
      for (int g = before + 1; g < f; ++g) sum[at(g)] = from + (sum[at(f)] - from) * (g - before) / (f - before);
      before = f;
    }
    if (before < 0) return {};
    std::fill(sum.begin() + before + 1, sum.end(), sum[at(before)]);
    smooth_twice(static_cast<int>(kSmooth_s * motion_.rate_hz), sum);
    return sum;
  }

  // A figure with other legs than the recorded one slides. The root's way becomes shorter or longer, so that feet that
  // rest stay in place on average.
  void stop_slides() {
    for (const int axis : {0, 2}) {
      const std::vector<double> slide_m = mean_of_flat([&](std::size_t leg, int f) {
        const int before = std::max(f - 1, 0), after = std::min(f + 1, motion_.frame_count - 1);
        return (paths_[leg][at(after)].p_m - paths_[leg][at(before)].p_m)[axis] / std::max(after - before, 1);
      });
      double back_m = 0.0;
      for (int f = 0; f < static_cast<int>(slide_m.size()); ++f) {
        back_m += slide_m[at(f)];
        motion_.root[at(f)].p_m[axis] -= back_m;
        for (SolePath& path : paths_) path[at(f)].p_m[axis] -= back_m;
      }
    }
  }

  // The root moves up and down with the feet that rest.
  void raise() {
    const std::vector<double> up_m = mean_of_flat([&](std::size_t leg, int f) {
      return wanted_[leg][at(f)].p_m.y - paths_[leg][at(f)].p_m.y;
    });
    for (std::size_t f = 0; f < up_m.size(); ++f) motion_.root[f].p_m.y += up_m[f];
  }

  bool rests_at(std::size_t leg, int frame) const {
    return std::ranges::any_of(rests_[leg], [&](const FootRest& r) { return r.first <= frame && frame <= r.last; });
  }

  void place_legs() {
    std::vector<Rigid> world(character_.joints().size());
    for (int f = 0; f < motion_.frame_count; ++f) {
      forward_kinematics(character_, motion_.root[at(f)], motion_.row(f), world);
      missing_m_[at(f)] = 0.0;
      for (std::size_t i = 0; i < legs_.size(); ++i) {
        const Rigid& sole = wanted_[i][at(f)];
        const Vec3 hip_m = world[at(character_.parts()[at(legs_[i].part)].reach.front().upper)].p_m;
        if (rests_at(i, f)) missing_m_[at(f)] = std::max(missing_m_[at(f)], too_high_m(legs_[i], hip_m, sole, kStretch));
        place_foot(character_, legs_[i], world, sole, motion_.row(f));
      }
    }
  }

  const Character& character_;
  const std::span<const Leg> legs_;
  const Environment& environment_;
  Motion& motion_;
  std::vector<SolePath> paths_, wanted_;  // by leg
  std::vector<std::vector<FootRest>> rests_;
  std::vector<double> missing_m_;  // by frame
};

}  // namespace

void plant_feet(const Character& character, std::span<const Leg> legs, const Environment& environment, Motion& motion) {
  MotionPlanter(character, legs, environment, motion).run();
}

}  // namespace contort
