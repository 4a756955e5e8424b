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

double heel_rise(double stance, double swing) {
  constexpr double kRises = 0.5;   // from here on, of the stance
  constexpr double kLevel = 0.75;  // here again, of the swing
  if (swing > 0.0) return 1.0 - minimum_jerk(std::min(swing / kLevel, 1.0));
  return minimum_jerk(std::max(0.0, (stance - kRises) / (1.0 - kRises)));
}

double toe_rise(double stance, double swing) {
  constexpr double kRise = 0.6;   // from here on, of the swing
  constexpr double kFlat = 0.25;  // of the stance
  if (swing > 0.0) return minimum_jerk(std::max(0.0, (swing - kRise) / (1.0 - kRise)));
  return 1.0 - minimum_jerk(std::min(stance / kFlat, 1.0));
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
