// reach_error: a limb that was sent to a point must be there in the frames that the generator gives (Intent::goals). It
// is not judged if an additive action or dynamics moves the limb; tracking_error judges the latter. The place of the
// limb follows from the pose alone, so a point out of reach is found here.
#include <algorithm>
#include <cmath>

#include "checks/fixed_limits.h"
#include "checks/plan.h"

namespace contort {

namespace {

Vec3 place_of(const CheckInput& in, int socket, int frame) {
  const Socket& s = in.character.sockets()[static_cast<std::size_t>(socket)];
  return in.world_at(frame)[static_cast<std::size_t>(s.joint)] * s.joint_from_socket.p_m;
}

Vec3 target_of(const CheckInput& in, const Goal& goal, int frame) {
  if (goal.target_socket >= 0) return place_of(in, goal.target_socket, frame);
  if (goal.in_world) return goal.target_m;
  return in.world_at(frame)[0] * inverse(in.character.rest_root()) * goal.target_m;
}

// Returns true if an additive action moves the limb in this frame.
bool is_disturbed(const CheckInput& in, const Goal& goal, int frame) {
  const int joint = in.character.sockets()[static_cast<std::size_t>(goal.socket)].joint;
  const int hand = in.character.joints()[static_cast<std::size_t>(joint)].part;
  return has_layer(in, goal.part, Layer::additive, frame, frame) || has_layer(in, hand, Layer::additive, frame, frame);
}

}  // namespace

int reach_error_subject_count(const Character& character) { return static_cast<int>(character.sockets().size()); }

Subject reach_error_subject(const Character& character, int subject) {
  return {character.sockets()[static_cast<std::size_t>(subject)].name, "m"};
}

void reach_error_measure(const CheckInput& in, MarginFold& fold) {
  if (in.intent == nullptr || in.motion.response.dof_count > 0) return;
  for (const Goal& goal : in.intent->goals)
    for (int frame = goal.first_frame; frame <= goal.last_frame; ++frame) {
      if (is_disturbed(in, goal, frame)) continue;
      const Vec3 missing = place_of(in, goal.socket, frame) - target_of(in, goal, frame);
      const double limit_m = std::max(kReachLimit_m, goal.within_m);
      fold.report(goal.socket, frame, limit_m - std::sqrt(glm::dot(missing, missing)));
    }
}

}  // namespace contort
