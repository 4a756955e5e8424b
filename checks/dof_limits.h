// Measures joint_range for motion capture: the numbers of an AMC against the limits that its own ASF declares. It
// assumes nothing about people.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "checks/fold.h"
#include "checks/settings.h"
#include "model/asset/capture.h"
#include "model/character/character.h"
#include "model/motion/file_joint.h"

namespace contort {

struct DofLimits {
  // The number of judged values: all frames of all degrees of freedom with limits, without the root.
  std::int64_t samples = 0;
  std::int64_t out_of_range = 0;
  int subjects = 0;  // number of limits that have samples
  // Subjects are "lwrist ry min" and "max", units rad (prismatic: the file's unit of length). Frames are the file's own
  // numbers, which mostly begin with 1.
  std::vector<Finding> findings;
  double least_margin = 0.0;  // The least margin of all samples, measured as in findings; infinite without samples.
  double worst_depth = 0.0;   // -least_margin / scale of joint_range: below 0 if all values are in range.
};

// Limits are inclusive; 1e-6 degrees beyond are the rounding of printed numbers.
inline constexpr double kDofResolution_rad = 1e-6 * kRadPerDeg;

// The subjects of the character's joint_range whose limits are declared by the skeleton itself, as an import from it
// makes them; check_dof_limits judges them. `joints` maps degrees of freedom ("lwrist_ry") to joints of the character.
// The range of a travel may be in another unit of length than the declared one.
std::set<std::string> subjects_with_declared_range(const AsfSkeleton& skeleton, const Character& character,
                                                   const FileJoints& joints);

// The subjects of all limits that the skeleton declares.
std::vector<std::string> dof_subjects(const AsfSkeleton& skeleton);

// Rules of the settings for joint_range change the findings, but not the counts.
DofLimits check_dof_limits(const AsfSkeleton& skeleton, const AmcMotion& motion, const CheckSettings& settings = {});

}  // namespace contort
