// root_pop: the root of a figure jumps or turns to another place for a frame or two, or for good, while it hardly moves
// around that time (lone_steps.h). Places are judged relative to the size of the figure at rest, like those of nodes in
// clips (translation_pop). Turns are judged like those of joints (pop), by the speed that the generator declares.
#include <algorithm>
#include <limits>

#include "checks/check.h"
#include "checks/lone_steps.h"
#include "checks/pop.h"
#include "model/core/function_ref.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr double kBlipOfRoot = 0.01, kJumpOfRoot = 0.05, kLeapOfRoot = 0.5;
constexpr double kSmallestFigure_m = 0.2;  // a figure of one joint has no size

double size_at_rest_m(const Character& character) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  Vec3 low = world.front().p_m, high = low;
  for (const Rigid& joint : world) low = glm::min(low, joint.p_m), high = glm::max(high, joint.p_m);
  const Vec3 size = high - low;
  return std::max({kSmallestFigure_m, size.x, size.y, size.z});
}

// Steps of the root in one frame. `declared` is the greatest step that is always allowed. `leap` is the greatest step
// that is allowed in fast motion.
struct StepLimits {
  LoneLimits lone;
  double declared;
  double leap;
};

void judge_steps(const CheckInput& in, int subject, FunctionRef<double(std::size_t, std::size_t)> apart,
                 const StepLimits& limits, MarginFold& fold) {
  std::vector<SpeedInterval> steps;
  for (int frame = 1; frame < in.motion.frame_count; ++frame)
    steps.push_back({(frame - 1) / in.motion.rate_hz, frame / in.motion.rate_hz,
                     apart(at(frame - 1), at(frame)) * in.motion.rate_hz});
  const std::vector<double> lone = allowed_lone_steps(steps, apart, limits.lone);
  for (int frame = 1; frame < in.motion.frame_count; ++frame) {
    const std::size_t i = at(frame - 1);
    const double step = apart(i, i + 1);
    if (in.may_root_jump_into(frame) || !(step == step)) continue;  // non_finite reports NaN
    const double explained = explained_rad_s(steps, i) / in.motion.rate_hz;
    const double leap = std::max(explained, std::min(limits.leap, limits.declared));
    fold.report(subject, frame, std::min(lone[i], leap) - step);
  }
}

}  // namespace

int root_pop_subject_count(const Character&) { return 2; }

Subject root_pop_subject(const Character&, int subject) {
  return subject == 0 ? Subject{"root position", "m"} : Subject{"root rotation", "rad"};
}

void root_pop_measure(const CheckInput& in, MarginFold& fold) {
  const std::span<const Rigid> root = in.motion.root;
  const double size_m = size_at_rest_m(in.character), any = std::numeric_limits<double>::infinity();
  const double declared_rad = in.foreign->root_max_speed_rad_s / in.motion.rate_hz;
  const auto moved_m = [&](std::size_t a, std::size_t b) { return length(root[b].p_m - root[a].p_m); };
  const auto turned_rad = [&](std::size_t a, std::size_t b) {
    return rotation_angle(glm::conjugate(root[a].q) * root[b].q);
  };
  judge_steps(in, 0, moved_m, {{kBlipOfRoot * size_m, kJumpOfRoot * size_m}, any, kLeapOfRoot * size_m}, fold);
  judge_steps(in, 1, turned_rad, {{kBlip_rad, kJump_rad}, declared_rad, kLeap_rad}, fold);
}

}  // namespace contort
