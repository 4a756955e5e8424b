#include "renders/measured_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "checks/fixed_limits.h"
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
  return rounded_text(value) + (unit.empty() ? "" : " ") + std::string(unit);
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

// Some margins of this check stand for an event, and are no distance.
std::string balance_text(double margin) {
  if (margin <= kFallen_m) return "the figure falls";
  if (margin == kAirborne_m) return "the figure is off the ground";
  if (margin == kTipping_m) return "the figure tips over an edge of its feet";
  return "the balance point is " + familiar_text(-margin, "m") + " outside the area under the feet";
}

std::string beyond_text(const Failed& failed) {
  if (std::isnan(failed.margin)) return "is not a number";
  const std::string excess = familiar_text(-failed.margin, failed.unit);
  if (failed.check == "joint_range" && failed.subject.ends_with(" swing"))
    return "bends " + excess + " beyond its swing cone";
  if (failed.check == "pop") return "jumps " + excess + " faster than its limit and the motion around it allow";
  if (failed.check == "root_pop") return "jumps " + excess + " farther than the motion around it explains";
  if (failed.check == "bone_position") return "is " + excess + " outside its region";
  return "is " + excess + " beyond its limit";
}

}  // namespace

std::string failed_text(const Failed& failed, const Character* character, const CheckSettings& settings) {
  if (failed.check == "balance")
    return balance_text(failed.margin - tolerance_of(settings, failed.check, failed.subject));
  if (character != nullptr && !failed.has_own_limit)
    if (const auto measured = measured_of(*character, settings, failed.check, failed.subject, failed.margin))
      return measured_text(failed.check, failed.unit, *measured);
  return beyond_text(failed);
}

std::string measured_text(std::string_view check, std::string_view unit, const Measured& measured) {
  const auto [before, after] = words_of(check, unit.starts_with("m"));
  return std::string(before) + familiar_text(measured.value, unit) + std::string(after) + ", limit " +
         familiar_text(measured.limit, unit);
}

}  // namespace contort
