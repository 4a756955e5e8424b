#include <cmath>

#include "formats/robot/mjcf.h"
#include "formats/robot/shapes.h"
#include "formats/robot/urdf.h"
#include "import/robot.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

constexpr std::size_t kMostImportedBodies = 40;  // bounded work

void require_sound(const RobotModel& robot) {
  require(!robot.bodies.empty(), "a robot has a root");
  for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
    const RobotBody& body = robot.bodies[i];
    require(i == 0 ? body.parent == -1 : body.parent >= 0 && body.parent < static_cast<int>(i), "parents come first");
    for (const RobotJoint& joint : body.joints) {
      require(std::fabs(length(joint.axis) - 1.0) < 1e-9, "an axis has length 1");
      require(joint.low <= joint.high, "a range is not turned around");
    }
    for (const RobotShape& shape : body.shapes)
      require(!shape.mesh.empty() || is_solid(shape.shape), "a shape without a mesh is solid");
  }
}

Result<RobotModel> read(std::string_view bytes) {
  if (bytes.starts_with("<mujoco"))
    return parse_mjcf(bytes, [](const std::string&) { return Issue{"file.unreadable", "", "there is no such file"}; });
  const std::size_t end = std::min(bytes.find("#!"), bytes.size());
  Result<RobotModel> robot = parse_urdf(bytes.substr(0, end));
  if (!robot || end == bytes.size()) return robot;
  RobotModel out = std::move(robot).value();
  if (const Result<Done> pairs = add_srdf(bytes.substr(end + 2), out); !pairs) return pairs.issue();
  return out;
}

}  // namespace

bool try_robot(std::string_view bytes) {
  const Result<RobotModel> robot = read(bytes);
  if (!robot) return require_clean(robot.issue()), false;
  require_sound(*robot);
  if (robot->bodies.size() > kMostImportedBodies) return true;
  const Result<ImportedRobot> imported = import_robot(*robot, "robot");
  if (!imported) return require_clean(imported.issue()), false;
  return true;
}

}  // namespace contort::hostile
