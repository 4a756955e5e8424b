// The bodies of a robot's file as the joints of a guest.
#pragma once

#include "formats/robot/robot.h"
#include "guest/manifest.h"

namespace contort::cli {

// One joint for each body, in the file's axes. It has the name of the body's only joint; or the body's name if there
// are no or several joints, or if that name is taken. Travels are fixed, and a body with several joints gets a ball
// without limits. Shapes are boxes, spheres and capsules; hulls and meshes are left out.
GuestCharacter joints_of_robot(const RobotModel& robot);

}  // namespace contort::cli
