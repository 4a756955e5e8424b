// The bodies of a robot's file as the joints of a guest.
#pragma once

#include "formats/robot/robot.h"
#include "guest/manifest.h"

namespace contort::cli {

// A joint for each body, in the file's axes, named like its only joint in the file, or like the body if there are none,
// several, or one of that name already. Travels are fixed, and a body with several joints hangs on a ball without
// limits. Shapes are boxes, spheres and capsules; hulls and meshes are left out.
GuestCharacter joints_of_robot(const RobotModel& robot);

}  // namespace contort::cli
