// aim_error: the socket that an aim points must face its target. It is judged in the frames in which the generator says
// that an aim is fully in force (Motion::aims). The place and direction of the socket follow from the pose alone.
#include <cmath>
#include <limits>

#include "checks/check.h"
#include "checks/fixed_limits.h"

namespace contort {

namespace {

// The angle between the socket's +Z and the direction to the target.
double error_rad(const Rigid& world_from_socket, const Vec3& target_m) {
  const Vec3 way = target_m - world_from_socket.p_m;
  const double length_m = std::sqrt(glm::dot(way, way));
  if (!(length_m > 1e-9)) return std::numeric_limits<double>::quiet_NaN();
  return rotation_angle(shortest_arc(world_from_socket.q * Vec3(0.0, 0.0, 1.0), way / length_m));
}

}  // namespace

int aim_error_subject_count(const Character& character) { return static_cast<int>(character.sockets().size()); }

Subject aim_error_subject(const Character& character, int subject) {
  return {character.sockets()[static_cast<std::size_t>(subject)].name, "rad"};
}

void aim_error_measure(const CheckInput& in, MarginFold& fold) {
  for (const AimSpan& aim : in.motion.aims) {
    const Socket& socket = in.character.sockets()[static_cast<std::size_t>(aim.socket)];
    for (int frame = aim.first_frame; frame <= aim.last_frame; ++frame) {
      const Rigid at = in.world_at(frame)[static_cast<std::size_t>(socket.joint)] * socket.joint_from_socket;
      fold.report(aim.socket, frame, kAimLimit_rad - error_rad(at, aim.target_m));
    }
  }
}

}  // namespace contort
