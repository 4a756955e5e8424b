// Measures angular_velocity and pop for animations made elsewhere: the speed of every rotation channel of a clip
// between its own neighbouring keys, so that no peak between keys is averaged away. An interval that is too fast is
// one of the two, never both: a pop if the surrounding motion does not explain the speed (pop.h), otherwise
// angular_velocity.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/asset/asset.h"

namespace contort {

struct SpeedLimits {
  double max_rad_s = 0.0;                 // for every node without its own limit, > 0
  std::map<std::string, double> of_node;  // rad/s, by node label or name
  CheckSettings settings{};               // rules for angular_velocity and pop apply by node label; clips have no
                                          // phases
};

// A finding of one clip. Its frames are key intervals: interval i is between keys i and i + 1.
struct ClipFinding {
  Finding finding;
  double worst_t0_s = 0.0;  // the interval of the worst margin
  double worst_t1_s = 0.0;
  double worst_speed_rad_s = 0.0;
};

struct ClipSpeeds {
  std::string clip;
  std::string peak_node;  // "" if nothing turns
  double peak_rad_s = 0.0;
  double peak_t0_s = 0.0;
  double peak_t1_s = 0.0;
  int channels = 0;
  // The smallest value of limit - speed over all intervals, rad/s; infinite if nothing turns.
  double least_margin_rad_s = std::numeric_limits<double>::infinity();
  std::vector<ClipFinding> findings;  // in the order of channels, then time
};

ClipSpeeds check_clip_speeds(const Asset& asset, const AssetClip& clip, const SpeedLimits& limits);

// Measures each clip of that name, or all clips if `name` is empty. It cannot fail: a clip without rotations has a
// peak of 0.
std::vector<ClipSpeeds> check_clip_speeds(const Asset& asset, const SpeedLimits& limits, const std::string& name = "");

}  // namespace contort
