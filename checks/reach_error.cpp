// reach_error: a limb that was sent to a point must come there. `reach` is judged in its last frame, `weapon_hold` in
// the frames in which it is fully in force; both only where nothing is added to the limb and dynamics does not move it
// (there tracking_error judges). Where the limb is follows from the pose alone; a point out of reach is found here.
#include <algorithm>
#include <cmath>
#include <optional>

#include "checks/plan.h"

namespace contort {

namespace {

constexpr double kReachLimit_m = 0.001;
constexpr double kComeBack_s = 0.2;  // an action that was cut takes this long to come in again

// The limb's grip: of the part, or of one that hangs on it; else the tip of its chain.
int grip_of_limb(const Character& character, int arm) {
  for (std::size_t s = 0; s < character.sockets().size(); ++s) {
    const Socket& socket = character.sockets()[s];
    const int part = character.joints()[static_cast<std::size_t>(socket.joint)].part;
    const Part& carrying = character.parts()[static_cast<std::size_t>(part)];
    const int docked = character.joints()[static_cast<std::size_t>(carrying.first_joint)].parent;
    const bool is_own =
        part == arm || (docked >= 0 && character.joints()[static_cast<std::size_t>(docked)].part == arm);
    if (is_own && std::string_view(socket.name).ends_with("/grip")) return static_cast<int>(s);
  }
  return character.parts()[static_cast<std::size_t>(arm)].reach.front().tip;
}

struct Goal {
  int socket = 0;
  int first_frame = 0;
  int last_frame = -1;  // inclusive
};

Vec3 place_of(const CheckInput& in, int socket, int frame) {
  const Socket& s = in.character.sockets()[static_cast<std::size_t>(socket)];
  return in.world_at(frame)[static_cast<std::size_t>(s.joint)] * s.joint_from_socket.p_m;
}

bool is_reach(const PlannedAction& action) { return action.def->name == "reach" && !(action.blend_out > 0.0); }
bool is_hold(const PlannedAction& action) { return action.def->name == "weapon_hold"; }

Goal goal_of(const CheckInput& in, const ActionSpan& span, const PlannedAction& action) {
  const Part& part = in.character.parts()[static_cast<std::size_t>(span.part)];
  if (is_reach(action)) {
    const bool ended = content_frame(in.motion, span.sequence, span.last_frame) >= action.last_frame;
    return {part.reach.front().tip, span.last_frame, ended ? span.last_frame : -1};
  }
  Goal goal{grip_of_limb(in.character, span.part), span.last_frame + 1, -1};
  for (int frame = span.first_frame; frame <= span.last_frame; ++frame) {
    const double content = content_frame(in.motion, span.sequence, frame);
    const bool is_in = content >= action.start + action.blend_in && content <= action.end - action.blend_out &&
                       frame - span.first_frame >= kComeBack_s * in.motion.rate_hz;
    if (is_in) goal.first_frame = std::min(goal.first_frame, frame), goal.last_frame = frame;
  }
  return goal;
}

Vec3 target_of(const CheckInput& in, const PlannedAction& action, int frame) {
  if (is_hold(action)) return place_of(in, static_cast<int>(action.params[0]), frame);
  const Rigid world_from_character = in.world_at(frame)[0] * inverse(in.character.rest_root());
  return world_from_character * Vec3(action.params[0], action.params[1], action.params[2]);
}

// Something is added to the limb in this frame.
bool is_disturbed(const CheckInput& in, int socket, int arm, int frame) {
  const int joint = in.character.sockets()[static_cast<std::size_t>(socket)].joint;
  const int hand = in.character.joints()[static_cast<std::size_t>(joint)].part;
  return has_layer(in, arm, Layer::additive, frame, frame) || has_layer(in, hand, Layer::additive, frame, frame);
}

}  // namespace

int reach_error_subject_count(const Character& character) { return static_cast<int>(character.sockets().size()); }

Subject reach_error_subject(const Character& character, int subject) {
  return {character.sockets()[static_cast<std::size_t>(subject)].name, "m"};
}

void reach_error_measure(const CheckInput& in, MarginFold& fold) {
  if (in.timeline == nullptr || in.motion.response.dof_count > 0) return;
  for (const ActionSpan& span : in.motion.spans) {
    const PlannedAction* action = planned_of(*in.timeline, span);
    if (action == nullptr || !(is_reach(*action) || is_hold(*action)) || action->named != span.part) continue;
    const Goal goal = goal_of(in, span, *action);
    for (int frame = goal.first_frame; frame <= goal.last_frame; ++frame) {
      if (is_disturbed(in, goal.socket, span.part, frame)) continue;
      const Vec3 missing = place_of(in, goal.socket, frame) - target_of(in, *action, frame);
      fold.report(goal.socket, frame, kReachLimit_m - std::sqrt(glm::dot(missing, missing)));
    }
  }
}

}  // namespace contort
