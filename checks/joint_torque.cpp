// joint_torque: required torques and forces as a fraction of the strength that the character's file declares, in
// motions that dynamics made.
#include <algorithm>

#include "checks/check.h"

namespace contort {

namespace {

// The fraction of the joint's strength that is left. A joint without strength gives the negative effort, in N m.
double margin_of(const Joint& joint, double effort) {
  const double limit = effort > 0.0 ? joint.strength_high : joint.strength_low;
  return limit != 0.0 ? 1.0 - effort / limit : -(effort > 0.0 ? effort : -effort);
}

}  // namespace

int joint_torque_subject_count(const Character& character) { return static_cast<int>(character.joints().size()) - 1; }

Subject joint_torque_subject(const Character& character, int subject) {
  return {character.joints()[static_cast<std::size_t>(subject) + 1].name, "of its strength"};
}

void joint_torque_measure(const CheckInput& in, MarginFold& fold) {
  const Response& response = in.motion.response;
  if (response.dof_count == 0) return;
  for (int frame = 0; frame < in.motion.frame_count; ++frame) {
    const double* effort =
        &response.efforts[static_cast<std::size_t>(frame) * static_cast<std::size_t>(response.dof_count)];
    effort += freedom_count(JointKind::root);
    for (std::size_t j = 1; j < in.character.joints().size(); ++j) {
      const Joint& joint = in.character.joints()[j];
      double margin = margin_of(joint, *effort++);
      for (int k = 1; k < freedom_count(joint.kind); ++k) margin = std::min(margin, margin_of(joint, *effort++));
      fold.report(static_cast<int>(j) - 1, frame, margin);
    }
  }
}

}  // namespace contort
