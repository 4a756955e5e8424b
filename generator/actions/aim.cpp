// aim: a point of an arm or a head, or of what it carries, is directed at a target while the body moves (P13). Its first posture
// comes from the aim table; every frame goes on from the one before, so that joints turn little.
#include <algorithm>
#include <array>

#include "generator/actions/hand.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr std::size_t kCandidates = 96;  // postures of the table that are tried

void place_chain(const RuleInput& in, const Posture& posture) {
  const std::span<const int> joints = in.aim->chain.joints;
  const int last = in.character.sockets()[static_cast<std::size_t>(in.aim->chain.socket)].joint;
  forward_kinematics(in.character, posture.coords, joints.front(), std::max(joints.back(), last) + 1, in.world);
}

// The chain's coordinates, in the order of its joints.
template <class Copy>
void for_coords(const RuleInput& in, Copy copy) {
  std::size_t at = 0;
  for (const int j : in.aim->chain.joints) {
    const Joint& joint = in.character.joints()[static_cast<std::size_t>(j)];
    for (int c = 0; c < coord_size(joint.kind); ++c) copy(static_cast<std::size_t>(joint.coord + c), at++);
  }
}

bool has_room(const RuleInput& in, const Posture& posture) {
  const auto part = static_cast<std::size_t>(&in.part - in.character.parts().data());
  for (const int j : in.room.limb_of(part).joints) forward_kinematics(in.character, posture.coords, j, j + 1, in.world);
  return in.room.room_m(part, in.world) >= -kTooNear_m;
}

// Chooses, from the postures of the table that point there, the one nearest to the present one in which no bodies are
// too near. False where all have such bodies; then `posture` is of no use.
bool find_room(const RuleInput& in, const AimTarget& target, Posture& posture) {
  const AimTable& table = *in.aim->table;
  const auto base = static_cast<std::size_t>(in.character.joint(in.aim->chain.joints.front()).parent);
  std::array<double, kMaxAimCoords> present{};
  for_coords(in, [&](std::size_t coord, std::size_t at) { present[at] = in.from.coords[coord]; });
  std::array<AimHit, kCandidates> hits;
  const int found = table.nearest_to_point(inverse(in.world[base]) * target.world, hits);
  const std::span<AimHit> near = std::span(hits).first(static_cast<std::size_t>(found));
  table.prefer(present, near);
  return std::ranges::any_of(near, [&](const AimHit& hit) {
    const std::span<const double> coords = table.coords(hit.posture);
    for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = coords[at]; });
    place_chain(in, posture);
    return continue_aim(in.character, in.aim->chain, in.world, target, posture.coords).reached && has_room(in, posture);
  });
}

void solve(const RuleInput& in, Posture& posture) {
  WholeBody& body = in.body;
  const AimTarget target{AimTarget::Kind::point, in.world_from_start * Vec3(in.params[1], in.params[2], in.params[3])};
  const auto from_table = [&] {
    place_chain(in, posture);
    return aim(in.character, in.aim->chain, *in.aim->table, in.world, target, posture.coords);
  };
  if (body.begun != in.took_over) {
    if (from_table().reached && !has_room(in, posture) && !find_room(in, target, posture)) from_table();
    for_coords(in, [&](std::size_t coord, std::size_t at) { body.aimed[at] = posture.coords[coord]; });
    body.begun = in.took_over;
  }
  for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = body.aimed[at]; });
  place_chain(in, posture);
  AimResult result = continue_aim(in.character, in.aim->chain, in.world, target, posture.coords);
  if (!result.reached) result = from_table();
  for_coords(in, [&](std::size_t coord, std::size_t at) { body.aimed[at] = posture.coords[coord]; });
  in.feedback.aim_reached = result.reached;
  in.feedback.shortfall = result.reached ? 0.0 : result.error_rad;
}

// The end of a limb that can face something: a head, a tail.
bool is_head(const Character& character, const Part& part) {
  if (part.facing.empty()) return false;
  const int own = static_cast<int>(&part - character.parts().data());
  for (int p = own + 1; p < static_cast<int>(character.parts().size()); ++p)
    if (carrier_of(character, p) == own) return false;
  return true;
}

}  // namespace

std::vector<ParamDef> aim_params(const Character& character, const Part& part) {
  ParamDef point;
  point.name = "point";
  point.type = ParamType::own_point;
  const std::vector<std::string> points = own_points(character, part);
  const bool armed = std::find(points.begin(), points.end(), "muzzle") != points.end();
  point.preset = armed ? std::string("muzzle") : points.empty() ? std::string("grip") : points.front();
  point.help = "What is directed: the grip of a hand, a face, or a point of what is carried.";
  ParamDef target;
  target.name = "target_m";
  target.type = ParamType::vector;
  target.low = -1000.0, target.high = 1000.0;
  target.preset = Vec3(0.0, 1.2, 5.0);
  target.domain = Domain::around;
  target.mirrored = Mirrored::point;
  target.help = "The point, m, from where the character stood at first.";
  return {point, target};
}

bool aim_supports(const Character& character, const Part& part) {
  return (is_arm(character, part) || is_head(character, part)) && !own_points(character, part).empty();
}

void aim_rule(const RuleInput& in, Posture& posture) {
  if (!in.part.reach.empty() || !in.part.facing.empty()) return solve(in, posture);
  // The hand: solved with its arm, which comes before it.
  for_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = in.body.aimed[at]; });
}

}  // namespace contort
