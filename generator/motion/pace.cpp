#include "generator/motion/pace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Gentler gaits before slower ones.
constexpr std::array kSpeeds = {1.0, 0.85, 0.7, 0.55, 0.4, 0.3, 0.2, 0.1};
constexpr std::array kRolls = {1.0, 0.6, 0.3};
constexpr double kOfSpeed = 0.985;         // of a joint's greatest speed: room for what the frames in between do
constexpr double kShortestRise_s = 0.0205;  // from rest to a joint's greatest speed
// An even gait with this much to spare needs no trial of its start and stop, which bend joints a little farther.
constexpr double kEasySpeed = 0.75;      // of a joint's greatest speed
constexpr double kEasyRange_rad = 0.08;  // from the ends of its range
// A bend is tried at no more places than these if joints stay slow from one to the next. A joint that turns too fast in
// one of the frames between two places, as a knee does just before it is straight, is not slow there either.
constexpr double kMostPlaces = 40.0;
constexpr double kSlow = 0.4;    // of a joint's greatest speed
constexpr int kMostJoints = 64;  // of legs that are tried

class Trial {
 public:
  Trial(const Character& character, LimbRoom& room, const CourseTrial& course, std::span<const Rigid> world,
        const TrialSpace& scratch, std::span<double> row)
      : character_(character), room_(room), course_(course), world_(world), scratch_(scratch), row_(row) {}

  bool is_easy(Gait gait) {
    constexpr int kSamples = 12;
    if (course_.even_for_s <= 0.0) return false;
    const double step_s = course_.even_for_s / kSamples;
    for (int n = 0; n <= kSamples; ++n) {
      place(course_.frame_at(gait, {}, course_.even_s + n * step_s));
      if (!keeps_joints_easily(n > 0 ? step_s * course_.frame_s / course_.step_s : 0.0) || !has_room()) return false;
      std::ranges::copy(row_, scratch_.row.begin());
    }
    return true;
  }

  bool is_slow(Gait gait, const Pace& pace) {
    const double frames = std::ceil(course_.lasts_s / course_.step_s / kMostPlaces);  // from one place to the next
    const double step_s = std::max(1.0, frames) * course_.step_s;
    const int steps = static_cast<int>(std::ceil(course_.lasts_s / step_s));
    for (int n = 0; n <= steps; ++n) {
      place(course_.frame_at(gait, pace, std::min(n * step_s, course_.lasts_s)));
      if (!keeps_joints_slow(n > 0 ? step_s * course_.frame_s / course_.step_s : 0.0) || !has_room()) return false;
      std::ranges::copy(row_, scratch_.row.begin());
    }
    return true;
  }

  bool fits(Gait gait, const Pace& pace) {
    steps_ = {};
    is_first_ = true, knows_step_ = false;
    const int frames = static_cast<int>(course_.lasts_s / course_.step_s);
    for (int n = 0; n <= frames; ++n) {
      place(course_.frame_at(gait, pace, n * course_.step_s));
      if (!keeps_joints() || !has_room()) return false;
      std::ranges::copy(row_, scratch_.row.begin());
      knows_step_ = !is_first_, is_first_ = false;
    }
    return true;
  }

 private:
  std::span<const Leg> legs() const { return room_.feet().legs(); }

  void place(const GaitFrame& frame) {
    const Rigid moved = frame.root * inverse(world_[0]);
    std::ranges::transform(world_, scratch_.world.begin(), [&](const Rigid& joint) { return moved * joint; });
    for (std::size_t i = 0; i < legs().size(); ++i) {
      stand_on(character_, legs()[i], scratch_.world, frame.feet[i].world_from_sole, row_);
    }
  }

  bool keeps_joints() {
    int index = 0;
    for (const Leg& leg : legs())
      for (const int j : leg.joints)
        if (!keeps_joint(character_.joint(j), steps_[at(std::min(index++, kMostJoints - 1))])) return false;
    return true;
  }

  // `way_s` is the time since the sample before, whose row scratch_ holds; 0 for the first sample, which has no speed.
  bool keeps_joints_easily(double way_s) const {
    return std::ranges::all_of(legs(), [&](const Leg& leg) {
      return std::ranges::all_of(leg.joints, [&](int j) { return keeps_easily(character_.joint(j), way_s); });
    });
  }

  bool keeps_joints_slow(double way_s) const {
    return std::ranges::all_of(legs(), [&](const Leg& leg) {
      return std::ranges::all_of(leg.joints, [&](int j) {
        const Joint& joint = character_.joint(j);
        return is_in_range(joint, row_) && (way_s <= 0.0 || way_of(joint) <= kSlow * joint.max_speed * way_s);
      });
    });
  }

  // The way since the sample before.
  double way_of(const Joint& joint) const {
    return joint_way(joint, scratch_.row.data() + joint.coord, row_.data() + joint.coord);
  }

  bool keeps_easily(const Joint& joint, double way_s) const {
    if (!is_in_range(joint, row_)) return false;
    const double angle = row_[at(joint.coord)];
    const bool is_free = joint.kind != JointKind::hinge || joint.high - joint.low < 2.0 * kEasyRange_rad ||
                         std::min(angle - joint.low, joint.high - angle) > kEasyRange_rad;
    return is_free && (way_s <= 0.0 || way_of(joint) <= kEasySpeed * joint.max_speed * way_s);
  }

  bool keeps_joint(const Joint& joint, Vec3& last_step) {
    if (!is_in_range(joint, row_)) return false;
    if (is_first_) return true;
    const Vec3 step = joint_way_vector(joint, scratch_.row.data() + joint.coord, row_.data() + joint.coord);
    const double most = kOfSpeed * joint.max_speed * course_.frame_s;
    const bool is_smooth = !knows_step_ || length(step - last_step) <= most * course_.frame_s / kShortestRise_s;
    last_step = step;
    return length(step) <= most && is_smooth;
  }

  bool has_room() {
    return std::ranges::none_of(legs(),
                                [&](const Leg& leg) { return room_.touches(at(leg.foot_part), scratch_.world); });
  }

  const Character& character_;
  LimbRoom& room_;
  const CourseTrial& course_;
  std::span<const Rigid> world_;
  const TrialSpace& scratch_;
  std::span<double> row_;
  std::array<Vec3, kMostJoints> steps_{};  // of joints of legs, in the frame before
  bool is_first_ = true;
  bool knows_step_ = false;
};

}  // namespace

Pace fitting_pace(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                    std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row) {
  Trial trial(character, room, course, world, scratch, row);
  if (trial.is_easy(begun)) return {};
  for (const double speed : kSpeeds)
    for (const double roll : kRolls)
      if (trial.fits(begun, {speed, roll})) return {speed, roll};
  return {0.0, 0.0};
}

double fitting_depth(const Character& character, LimbRoom& room, const Gait& begun, const CourseTrial& course,
                     std::span<const Rigid> world, const TrialSpace& scratch, std::span<double> row) {
  Trial trial(character, room, course, world, scratch, row);
  const auto* fits = std::ranges::find_if(kSpeeds, [&](double share) {
    return trial.is_slow(begun, {share, 1.0}) || trial.fits(begun, {share, 1.0});
  });
  return fits != kSpeeds.end() ? *fits : 1.0;
}

}  // namespace contort
