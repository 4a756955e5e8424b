// rest_error, fresh_error, none_error, undo_error, history_error, rate_error, gain_error and mirror_error: a motion
// must be equal to another one, because the generator promises it. The checks differ in the promise and in the allowed
// difference.
#include <cmath>

#include "checks/check.h"
#include "checks/joint_steps.h"

namespace contort {

namespace {

struct Allowed {
  double angle_rad;
  double distance_m;
};

constexpr Allowed kEqual{1.0 * kRadPerDeg, 0.01};
// An integrator with half as many steps does not reach exactly the same pose. Neither does a limb whose target moves by
// a ten-thousandth of its range: an almost straight arm of 2 x 0.3 m bends by 1.5 degrees for 0.1 mm, because the angle
// grows with the root of the distance.
constexpr Allowed kAboutEqual{5.0 * kRadPerDeg, 0.05};

// Subjects are the joints, then the root's position, then the root's rotation.
int subjects_of(const Character& character) { return static_cast<int>(character.joints().size()) + 1; }

Subject subject_of(const Character& character, int subject) {
  const std::span<const Joint> joints = character.joints();
  if (subject == 0) return {"root position", "m"};
  if (subject == static_cast<int>(joints.size())) return {"root rotation", "rad"};
  const Joint& joint = joints[static_cast<std::size_t>(subject)];
  return {joint.name, unit_of(joint, "rad", "m")};
}

void compare_frame(const CheckInput& in, const EqualMotion& other, std::size_t i, const Allowed& allowed,
                   MarginFold& fold) {
  const int frame = other.first_frame + static_cast<int>(i) * other.step;
  if (frame >= in.motion.frame_count) return;
  const std::span<const Joint> joints = in.character.joints();
  const Rigid& root = in.motion.root[static_cast<std::size_t>(frame)];
  fold.report(0, frame, allowed.distance_m - length(root.p_m - other.root[i].p_m));
  fold.report(static_cast<int>(joints.size()), frame,
              allowed.angle_rad - rotation_angle(glm::conjugate(root.q) * other.root[i].q));
  const double* theirs = other.coords.data() + i * static_cast<std::size_t>(in.motion.coord_count);
  for (std::size_t j = 1; j < joints.size(); ++j) {
    const double most = joints[j].kind == JointKind::prismatic ? allowed.distance_m : allowed.angle_rad;
    fold.report(static_cast<int>(j), frame, most - joint_step(joints[j], in.motion.row(frame).data(), theirs));
  }
}

void compare(const CheckInput& in, Equality why, const Allowed& allowed, MarginFold& fold) {
  for (const EqualMotion& other : in.foreign->equals)
    for (std::size_t i = 0; other.why == why && i < other.root.size(); ++i) compare_frame(in, other, i, allowed, fold);
}

}  // namespace

int rest_error_subject_count(const Character& character) { return subjects_of(character); }
int fresh_error_subject_count(const Character& character) { return subjects_of(character); }
int none_error_subject_count(const Character& character) { return subjects_of(character); }
int undo_error_subject_count(const Character& character) { return subjects_of(character); }
int history_error_subject_count(const Character& character) { return subjects_of(character); }
int rate_error_subject_count(const Character& character) { return subjects_of(character); }
int gain_error_subject_count(const Character& character) { return subjects_of(character); }
int mirror_error_subject_count(const Character& character) { return subjects_of(character); }

Subject rest_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject fresh_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject none_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject undo_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject history_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject rate_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject gain_error_subject(const Character& character, int subject) { return subject_of(character, subject); }
Subject mirror_error_subject(const Character& character, int subject) { return subject_of(character, subject); }

void rest_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::rest, kEqual, fold); }
void fresh_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::fresh, kEqual, fold); }
void none_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::none, kEqual, fold); }
void undo_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::undo, kEqual, fold); }
void history_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::history, kEqual, fold); }
void rate_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::rate, kAboutEqual, fold); }
void gain_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::gain, kAboutEqual, fold); }
void mirror_error_measure(const CheckInput& in, MarginFold& fold) { compare(in, Equality::mirror, kEqual, fold); }

}  // namespace contort
