// An Acclaim skeleton (ASF) as the description of a robot, so that it is imported by the same rules: the ranges that
// the file declares become ranges of hinges (docs/reference/import.md).
#pragma once

#include "formats/robot/robot.h"
#include "import/import.h"
#include "model/asset/capture.h"

namespace contort {

// Each bone is a body with a hinge for each rotation that it declares, named "lfemur_rx", the outermost first. A
// capsule lies along each bone, with a thickness that follows from the meaning of the bone's name. Masses are in
// proportion to the capsules' volumes; for figures of up to 3 m the total is 24.1 kg/m2 times height squared. Lengths
// are converted to metres by `options`, else by the file's unit (1 / length inches) if that gives a figure of 0.5 to 3
// m, else by a power of ten.
RobotModel robot_of_asf(const AsfSkeleton& skeleton, const ImportOptions& options);

}  // namespace contort
