#include "generator/timeline/second_hand.h"

#include <algorithm>

#include "generator/actions/hand.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// "object:rifle/" of a point of an attached object; "" of other sockets.
std::string_view object_of(const Character& character, int socket) {
  const std::string_view name = character.sockets()[at(socket)].name;
  return name.starts_with("object:") ? name.substr(0, name.find('/') + 1) : std::string_view();
}

bool holds(const Character& character, const PlannedAction& aim, const PlannedAction& other) {
  if (other.def->promise != Promise::holds || other.part != other.named || other.named == aim.named) return false;
  if (other.sequence != aim.sequence || !(other.start < aim.end && aim.start < other.end)) return false;
  const std::string_view object = object_of(character, aim.aim->chain.socket);
  return !object.empty() && object_of(character, static_cast<int>(other.params[0])) == object;
}

// The arm as it is at rest, stretched.
double reach_of(const Character& character, const Part& arm) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const ReachChain& chain = arm.reach.front();
  const Vec3 shoulder = world[at(chain.upper)].p_m, elbow = world[at(chain.middle)].p_m;
  return length(elbow - shoulder) + length(world_from_socket(character, world, grip_of(character, arm)).p_m - elbow);
}

SecondHand second_hand(const Character& character, const PlannedAction& hold) {
  const Part& arm = character.parts()[at(hold.named)];
  const double side = arm.side == Side::left ? 1.0 : arm.side == Side::right ? -1.0 : 0.0;
  return {hold.named, static_cast<int>(hold.params[0]), reach_of(character, arm), side * kBladed_rad};
}

void tell(const SecondHand& second, PlannedAction& action) {
  AimPlan plan = *action.aim;
  plan.second = second;
  action.aim = std::make_shared<const AimPlan>(std::move(plan));
}

}  // namespace

void pair_hands(const Character& character, Timeline& out) {
  for (PlannedAction& aim : out.actions) {
    if (aim.aim == nullptr || aim.further >= 0) continue;
    if (character.parts()[at(aim.named)].reach.empty()) continue;  // a torso or head that carries the object
    const auto hold =
        std::ranges::find_if(out.actions, [&](const PlannedAction& other) { return holds(character, aim, other); });
    if (hold == out.actions.end()) continue;
    const SecondHand second = second_hand(character, *hold);
    tell(second, aim);
    for (const FurtherAction& further : out.further)
      if (PlannedAction& help = out.actions[at(further.action)]; further.of_use == aim.use && help.aim != nullptr)
        tell(second, help);
  }
}

}  // namespace contort
