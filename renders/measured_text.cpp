#include "renders/measured_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/core/math.h"
#include "renders/wording.h"

namespace contort {

namespace {

// Lengths below a metre are in millimetres.
std::string familiar_text(double value, std::string_view unit) {
  if (unit == "m") return std::fabs(value) < 1.0 ? rounded_text(1000.0 * value) + " mm" : rounded_text(value) + " m";
  if (unit == "of its strength") return rounded_text(100.0 * value) + " %";
  if (unit == "rad") return rounded_text(kDegPerRad * value) + "\xC2\xB0";
  if (unit.starts_with("rad/")) return rounded_text(kDegPerRad * value) + " \xC2\xB0" + std::string(unit.substr(3));
  return rounded_text(value) + " " + std::string(unit);
}

// The words around the value.
std::pair<std::string_view, std::string_view> words_of(std::string_view check, bool is_travel) {
  if (check == "angular_velocity") return {is_travel ? "moves " : "turns ", ""};
  if (check == "angular_acceleration") return {"changes its speed by ", ""};
  if (check == "joint_torque") return {"needs ", " of its strength"};
  if (check == "ground_penetration") return {"", " deep in the ground"};
  if (check == "obstacle_penetration") return {"", " deep in an obstacle"};
  if (check == "foot_slide") return {"slides ", ""};
  if (check == "self_collision") return {"", " deep in each other"};
  if (check == "reach_error") return {"misses by ", ""};
  if (check == "aim_error") return {"points aside by ", ""};
  if (check == "residue") return {"", " left behind"};
  if (check == "tracking_error") return {"still off by ", ""};
  return {"is at ", ""};
}

}  // namespace

std::string measured_text(std::string_view check, std::string_view unit, const Measured& measured) {
  const auto [before, after] = words_of(check, unit.starts_with("m"));
  return std::string(before) + familiar_text(measured.value, unit) + std::string(after) + ", limit " +
         familiar_text(measured.limit, unit);
}

}  // namespace contort
