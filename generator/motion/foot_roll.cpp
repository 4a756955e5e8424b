#include "generator/motion/foot_roll.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

Rigid turned_about(double z_m, double angle_rad) {
  const Quat turn = axis_angle(Vec3(1, 0, 0), angle_rad);
  const Vec3 line(0.0, 0.0, z_m);
  return {turn, line - turn * line};
}

}  // namespace

double heel_rise(const RollTimes& times, double duty, double stance, double swing) {
  const double rises = times.heel_rises * duty, peaks = duty + times.heel_peaks * (1.0 - duty);
  const double level = duty + times.heel_level * (1.0 - duty);
  const double now = swing > 0.0 ? duty + swing * (1.0 - duty) : stance * duty;
  if (now <= peaks) return minimum_jerk(std::max(0.0, (now - rises) / (peaks - rises)));
  return 1.0 - minimum_jerk(std::min((now - peaks) / (level - peaks), 1.0));
}

double toe_rise(const RollTimes& times, double stance, double swing) {
  if (swing > 0.0) return minimum_jerk(std::max(0.0, (swing - times.toes_rise) / (1.0 - times.toes_rise)));
  return 1.0 - minimum_jerk(std::min(stance / times.toes_flat, 1.0));
}

Rigid rolled_sole(const Leg& leg, double heel_up_rad, double toes_up_rad) {
  return turned_about(leg.high_m.z, heel_up_rad) * turned_about(leg.low_m.z, -toes_up_rad);
}

Vec3 lower_end_m(const Leg& leg, const Rigid& world_from_sole) {
  constexpr double kFlat_m = 0.001;
  const Vec3 heel(0.0, 0.0, leg.low_m.z), toes(0.0, 0.0, leg.high_m.z);
  const double higher_m = (world_from_sole * heel).y - (world_from_sole * toes).y;
  return std::fabs(higher_m) < kFlat_m ? Vec3(0.0) : higher_m > 0.0 ? toes : heel;
}

}  // namespace contort
