#include "generator/actions/limb_way.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "generator/motion/blend.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kStops = 8;
constexpr double kFree_m = 0.001;

const Limb& way_limb(const RuleInput& in) {
  return in.room.limb_of(static_cast<std::size_t>(&in.part - in.character.parts().data()));
}

double room_m(const RuleInput& in, const Posture& posture, const RoomRange& range) {
  const auto part = static_cast<std::size_t>(&in.part - in.character.parts().data());
  forward_kinematics(in.character, posture.coords, way_limb(in).joints, in.world);
  return in.room.room_m(part, in.world, range);
}

// The limb's coordinates, so that they can be put back.
struct Kept {
  std::array<double, kMaxAimCoords> coords{};
  bool fits = true;
};

template <class Copy>
bool for_limb_coords(const RuleInput& in, Copy copy) {
  std::size_t at = 0;
  for (const int j : way_limb(in).joints) {
    const Joint& joint = in.character.joint(j);
    for (int c = 0; c < coord_size(joint.kind); ++c, ++at) {
      if (at == kMaxAimCoords) return false;
      copy(static_cast<std::size_t>(joint.coord + c), at);
    }
  }
  return true;
}

// Turns the limb's first ball joint in the frame of what carries it.
void raise(const RuleInput& in, const Vec3& by_rad, Posture& posture) {
  const Joint& first = in.character.joint(in.part.first_joint);
  if (first.kind != JointKind::ball) return;
  double* q = posture.coords.data() + first.coord;
  const Quat out = first.parent_from_joint.q;
  const Quat turned = glm::normalize(glm::conjugate(out) * from_rotation_vector(by_rad) * out * quat_at(q));
  q[0] = turned.w, q[1] = turned.x, q[2] = turned.y, q[3] = turned.z;
}

// Blending in multiplies a detour by the share that has come in, so that it is greatest half way.
double left_of_detour(double came_in) { return 4.0 * (1.0 - came_in); }

// Forward, out and up, in the frame of what carries a limb that hangs down.
std::array<Vec3, 13> detours_of(Side side) {
  const double out = side == Side::right ? -1.0 : 1.0;
  std::array<Vec3, 13> detours{};
  std::size_t n = 1;
  for (const double angle_rad : {25.0 * kRadPerDeg, 50.0 * kRadPerDeg, 75.0 * kRadPerDeg})
    for (const Vec3& axis : {Vec3(-1, 0, 0), Vec3(0, 0, out), Vec3(-0.7, 0, 0.7 * out), Vec3(0.7, 0, 0.7 * out)})
      detours[n++] = angle_rad * axis;
  return detours;
}

// The least room at seven stops on the way, by a detour; exact from `matters_m` to kFree_m, which is enough for any
// way.
double room_on_way_m(const RuleInput& in, const Vec3& by_rad, double matters_m, Posture& posture) {
  Kept kept;
  const auto keep = [&](std::size_t coord, std::size_t at) { kept.coords[at] = posture.coords[coord]; };
  if (!for_limb_coords(in, keep)) return kFree_m;
  double least_m = kFree_m;
  for (int stop = 1; stop < kStops && least_m > matters_m; ++stop) {
    const double share = static_cast<double>(stop) / kStops;
    if (by_rad != Vec3(0.0)) raise(in, left_of_detour(share) * by_rad, posture);
    for (const int p : way_limb(in).parts) blend_part(in.character, at(p), in.from, posture, share, posture);
    least_m = std::min(least_m, room_m(in, posture, {matters_m, least_m}));
    for_limb_coords(in, [&](std::size_t coord, std::size_t at) { posture.coords[coord] = kept.coords[at]; });
  }
  return least_m;
}

}  // namespace

bool find_way(const RuleInput& in, Posture& posture) {
  constexpr double kMore_m = 1e-4;  // rounding must not choose
  WholeBody& body = in.body;
  body.way_chosen_in = in.took_over, body.detour_rad = Vec3(0.0);
  double most_m = -1e30;
  for (const Vec3& by_rad : detours_of(in.part.side)) {
    const double room = room_on_way_m(in, by_rad, most_m, posture);
    if (room > most_m + kMore_m) most_m = room, body.detour_rad = by_rad;
    if (most_m >= -kTooNear_m) return true;
  }
  return false;
}

bool has_way(const RuleInput& in, Posture& posture) {
  return room_on_way_m(in, Vec3(0.0), -kTooNear_m, posture) >= -kTooNear_m;
}

void go_round(const RuleInput& in, Posture& posture) {
  WholeBody& body = in.body;
  if (body.way_chosen_in != in.took_over) find_way(in, posture);
  if (in.came_in < 1.0 && body.detour_rad != Vec3(0.0))
    raise(in, left_of_detour(in.came_in) * body.detour_rad, posture);
}

}  // namespace contort
