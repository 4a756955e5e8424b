#include "renders/divergence.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "model/geometry/solid_points.h"
#include "model/motion/kinematics.h"
#include "renders/wording.h"

namespace contort {
namespace {

using json_fields::Json;

bool is_finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Points of a joint's body, in the joint's frame.
std::vector<std::vector<Vec3>> points_of(const Character& character) {
  std::vector<std::vector<Vec3>> points(character.joints().size(), {Vec3(0.0)});
  for (const Collider& collider : character.colliders())
    for (const Vec3& point : core_points(solid_of(collider))) points[at(collider.joint)].push_back(point);
  return points;
}

// A joint that both characters have, with its indices.
struct Common {
  int a = 0, b = 0;
};

class Comparison {
 public:
  Comparison(const Performance& a, const Performance& b)
      : a_(a), b_(b), world_a_(a.character.joints().size()), world_b_(b.character.joints().size()) {
    points_a_ = points_of(a.character), points_b_ = points_of(b.character);
  }

  std::vector<Common> joints(Divergence& divergence) const {
    std::vector<Common> common;
    for (const Joint& joint : a_.character.joints()) {
      const int b = b_.character.find_joint(joint.name);
      if (b >= 0)
        common.push_back({static_cast<int>(&joint - a_.character.joints().data()), b});
      else
        divergence.only_a.push_back(joint.name);
    }
    for (const Joint& joint : b_.character.joints())
      if (a_.character.find_joint(joint.name) < 0) divergence.only_b.push_back(joint.name);
    return common;
  }

  // The joint whose positions differ most in a frame; NaN counts as the greatest difference.
  Divergence::At worst_in(int frame, const std::vector<Common>& joints) {
    place(a_, frame, world_a_);
    place(b_, frame, world_b_);
    Divergence::At worst{frame, "", 0.0};
    for (const Common& joint : joints) {
      const double apart_m = distance_m(joint);
      if (apart_m <= worst.apart_m || std::isnan(worst.apart_m)) continue;
      worst.apart_m = apart_m, worst.joint = a_.character.joints()[at(joint.a)].name;
    }
    return worst;
  }

 private:
  static void place(const Performance& of, int frame, std::vector<Rigid>& world) {
    forward_kinematics(of.character, of.motion.root[at(frame)], of.motion.row(frame), world);
  }

  double distance_m(const Common& joint) const {
    const std::vector<Vec3>&a = points_a_[at(joint.a)], &b = points_b_[at(joint.b)];
    // For different bodies only the joint's own position is compared.
    const std::size_t count = a.size() == b.size() ? a.size() : 1;
    double most_m = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 pa = world_a_[at(joint.a)] * a[i], pb = world_b_[at(joint.b)] * b[i];
      if (is_finite(pa) != is_finite(pb)) return std::numeric_limits<double>::quiet_NaN();
      if (is_finite(pa)) most_m = std::max(most_m, glm::length(pa - pb));
    }
    return most_m;
  }

  const Performance &a_, &b_;
  std::vector<Rigid> world_a_, world_b_;
  std::vector<std::vector<Vec3>> points_a_, points_b_;
};

bool is_worse(double apart_m, double than_m) { return !std::isnan(than_m) && !(apart_m <= than_m); }

std::string apart_text(double apart_m) {
  if (std::isnan(apart_m)) return "has no finite place in one of them";
  char text[64];
  if (apart_m < 1.0)
    std::snprintf(text, sizeof text, "is %.3g mm apart", 1000.0 * apart_m);
  else
    std::snprintf(text, sizeof text, "is %.3g m apart", apart_m);
  return text;
}

std::string at_text(const Divergence::At& place, double rate_hz) {
  return "frame " + std::to_string(place.frame) + " (" + time_text(place.frame, rate_hz) + "): " + place.joint + " " +
         apart_text(place.apart_m);
}

std::string names_text(const std::vector<std::string>& names) {
  return names.size() == 1 ? names.front() : names.front() + " and " + std::to_string(names.size() - 1) + " more";
}

Json at_json(const Divergence::At& place, double rate_hz) {
  if (place.frame < 0) return nullptr;
  Json apart = nullptr;
  if (std::isfinite(place.apart_m)) apart = place.apart_m;
  return {{"frame", place.frame}, {"time_s", place.frame / rate_hz}, {"joint", place.joint}, {"apart_m", apart}};
}

}  // namespace

Result<Divergence> find_divergence(const Performance& a, const Performance& b, double tolerance_m) {
  if (a.motion.rate_hz != b.motion.rate_hz)
    return Issue{"compare.other_rate", "",
                 "found motions of " + std::to_string(a.motion.rate_hz) + " and " + std::to_string(b.motion.rate_hz) +
                     " frames a second: frames of one number are at different times"};
  Divergence divergence;
  divergence.frames_a = a.motion.frame_count, divergence.frames_b = b.motion.frame_count;
  divergence.frames = std::min(divergence.frames_a, divergence.frames_b);
  Comparison comparison(a, b);
  const std::vector<Common> joints = comparison.joints(divergence);
  divergence.joints = static_cast<int>(joints.size());
  for (int frame = 0; frame < divergence.frames; ++frame) {
    const Divergence::At here = comparison.worst_in(frame, joints);
    if (here.apart_m <= tolerance_m) continue;  // false for NaN
    if (divergence.first.frame < 0) divergence.first = divergence.worst = here;
    if (is_worse(here.apart_m, divergence.worst.apart_m)) divergence.worst = here;
    divergence.last_frame = frame;
  }
  return divergence;
}

std::string divergence_text(const Divergence& d, double tolerance_m, double rate_hz) {
  char tolerance[64];
  std::snprintf(tolerance, sizeof tolerance, "to %.3g mm", 1000.0 * tolerance_m);
  const std::string compared =
      counted(d.frames, "frame", "frames") + " and " + counted(d.joints, "joint", "joints") + " compared " + tolerance;
  std::string text = d.none() ? "no difference" : "";
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
  if (d.first.frame >= 0) add("first difference at " + at_text(d.first, rate_hz));
  if (d.worst.frame != d.first.frame) add("most at " + at_text(d.worst, rate_hz));
  if (!d.same_length())
    add(std::string(d.first.frame < 0 ? "no difference as long as both last; " : "") + "one has " +
        std::to_string(d.frames_a) + " frames, the other " + std::to_string(d.frames_b));
  if (!d.only_a.empty()) add("only the first has " + names_text(d.only_a));
  if (!d.only_b.empty()) add("only the second has " + names_text(d.only_b));
  return text + " (" + compared + ")";
}

std::string divergence_json(const Divergence& d, double tolerance_m, double rate_hz) {
  const Json json{{"same", d.none()},
                  {"tolerance_m", tolerance_m},
                  {"first_difference", at_json(d.first, rate_hz)},
                  {"greatest_difference", at_json(d.worst, rate_hz)},
                  {"last_different_frame", d.last_frame < 0 ? Json(nullptr) : Json(d.last_frame)},
                  {"frames_compared", d.frames},
                  {"frames", {d.frames_a, d.frames_b}},
                  {"joints_compared", d.joints},
                  {"joints_of_first_only", d.only_a},
                  {"joints_of_second_only", d.only_b}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace contort
