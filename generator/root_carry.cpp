#include "generator/root_carry.h"

#include "generator/motion/stand_on.h"
#include "generator/motion/way.h"

#include "model/motion/kinematics.h"

namespace contort {

namespace {

// Puts the hips over the feet, and the feet on the ground. `soles` are moved where an ankle does not bend so far.
void fit_to_ground(const Stage& stage, const GaitFrame& frame, std::span<Rigid> world, Posture& posture,
                   std::span<Rigid> soles) {
  const Character& character = *stage.character;
  posture.root = frame.root;
  forward_kinematics(character, posture.root, posture.coords, world);
  for (std::size_t i = 0; i < stage.legs.size(); ++i)
    soles[i] = stand_on(character, stage.legs[i], world, frame.feet[i].world_from_sole, posture.coords).world_from_sole;
}

}  // namespace

void RootCarry::begin(const Stage& stage, std::span<Rigid> world, Posture& posture) {
  stage_ = &stage;
  stands_at_ = base_stands_at_ = stage.start, lowered_m_ = 0.0;
  Gait gait;
  gait.begin(*stage.character, stage.legs, stage.environment, stage.start, {});
  soles_ = gait.first_soles();
  const Vec3& at = stage.start.p_m;
  if ((stage.environment.is_level() && !stage.bends) || stage.legs.empty())
    posture.root.p_m.y += stage.environment.height_at(at.x, at.z);
  else
    fit_to_ground(stage, gait.stand(0.0), world, posture, soles_);
}

void RootCarry::remember(const GaitFrame& frame) {
  stands_at_ = frame.stands_at;
  for (std::size_t i = 0; i < stage_->legs.size(); ++i) soles_[i] = frame.feet[i].world_from_sole;
}

std::array<Rigid, kMaxLegs> RootCarry::soles_in(std::span<const Rigid> world) const {
  constexpr double kElsewhere_s = 0.102;  // the way to a sole that is more than 1 mm or 0.2 degrees away
  std::array<Rigid, kMaxLegs> soles = soles_;
  for (std::size_t leg = 0; leg < stage_->legs.size(); ++leg) {
    const Rigid shown = world_from_socket(*stage_->character, world, stage_->legs[leg].sole);
    if (way_s(soles[leg], shown) > kElsewhere_s) soles[leg] = shown;
  }
  return soles;
}

void RootCarry::settle(const Rigid& base_root, const Rigid& settled) {
  base_stands_at_ = stands_at_;
  if (!(settled == base_root)) lowered_m_ = 0.0;
}

void RootCarry::raise(Rigid& base_root) {
  base_root.p_m.y += lowered_m_;
  lowered_m_ = 0.0;
}

void RootCarry::bring_along(const LegsBelow& below, Rigid& base_root) {
  base_root = brought_along(below, base_root, base_stands_at_, stands_at_);
  base_stands_at_ = stands_at_;
  lowered_m_ += lower_to_reach_m(below, base_root);
}

}  // namespace contort
