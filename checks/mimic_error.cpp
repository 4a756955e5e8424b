// mimic_error: a joint that must follow another one, as URDF's mimic or MuJoCo's joint equality declares, must be where
// the other one takes it. Drives and encoders are not exact, so a degree or a millimetre is allowed.
#include <cmath>

#include "checks/check.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

constexpr double kMimicAngle_rad = 1.0 * kRadPerDeg;
constexpr double kMimicTravel_m = 0.001;

}  // namespace

int mimic_error_subject_count(const Character& character) { return moving_joint_count(character); }

Subject mimic_error_subject(const Character& character, int subject) {
  return moving_joint(character, subject, "rad", "m");
}

void mimic_error_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Joint> joints = in.character.joints();
  for (const Coupling& coupling : in.couplings) {
    const Joint &own = joints[static_cast<std::size_t>(coupling.joint)],
                &leader = joints[static_cast<std::size_t>(coupling.leader)];
    const double allowed = own.kind == JointKind::prismatic ? kMimicTravel_m : kMimicAngle_rad;
    for (int frame = 0; frame < in.motion.frame_count; ++frame) {
      const double* row = in.motion.row(frame).data();
      const double apart = row[own.coord] - (coupling.multiplier * row[leader.coord] + coupling.offset);
      const double off = coupling.is_of_rotation ? wrap_angle(apart) : apart;
      fold.report(coupling.joint - 1, frame, allowed - std::fabs(off));
    }
  }
}

}  // namespace contort
