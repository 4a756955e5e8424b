// angular_velocity: the speed between two neighbouring frames must stay below the joint's limit. Jumps are judged by
// pop instead.
#include "checks/check.h"
#include "checks/joint_steps.h"
#include "checks/pop.h"

namespace contort {

int angular_velocity_subject_count(const Character& character) { return moving_joint_count(character); }

Subject angular_velocity_subject(const Character& character, int subject) {
  return moving_joint(character, subject, "rad/s", "m/s");
}

void angular_velocity_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (int frame = 1; frame < in.motion.frame_count; ++frame)
    for (std::size_t j = 1; j < joints.size() && !in.may_jump_into(frame); ++j) {
      const double speed = speed_into(in.motion, joints[j], frame);
      if (speed <= joints[j].max_speed || !(speed > explained_speed(in.motion, joints[j], frame)))
        fold.report(static_cast<int>(j) - 1, frame, joints[j].max_speed - speed);
    }
}

}  // namespace contort
