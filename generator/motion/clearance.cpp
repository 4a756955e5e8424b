#include "generator/motion/clearance.h"

#include <algorithm>
#include <array>

#include "generator/motion/blend.h"
#include "generator/motion/joint_clamp.h"
#include "generator/motion/way.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

// A limb may lose a third of its room in a frame, so it slows down before it stops.
constexpr double kApproach = 0.65;
constexpr double kSlowsDown_m = kApproach * kRoomBand_m;  // with more room it has not lost too much of any
constexpr double kCreep_m = 0.003;  // in a frame, which is slow enough to stop at once
constexpr std::array kShares = {0.8, 0.6, 0.4, 0.2, 0.0};
constexpr double kYield = 0.3;  // of a joint's greatest speed, at which it gets out of the way
constexpr int kRounds = 2;
constexpr double kMore_m = 1e-5;  // rounding must not choose

}  // namespace

struct Clearance::Case {
  const Character& character;
  LimbRoom& room;
  const Limb& limb;
  std::size_t part;
  double frame_s;
  const Posture& before;
  const Posture& wanted;
  Posture& shown;
  std::span<Rigid> world;
  double enough_m = -kTooNear_m;

  void place() const {
    for (const int j : limb.joints) forward_kinematics(character, shown.coords, j, j + 1, world);
    for (const int j : limb.carried) forward_kinematics(character, shown.coords, j, j + 1, world);
  }
  double room_m() const { return place(), room.room_m(part, world); }
  // A blend along the edge of a range may be longer than its ends are apart.
  bool is_slow() const {
    return std::ranges::all_of(limb.joints, [&](int j) {
      const Joint& joint = character.joint(j);
      return joint_way(joint, before.coords.data() + joint.coord, shown.coords.data() + joint.coord) <=
             joint.max_speed * frame_s;
    });
  }
  bool is_clear() const { return room_m() >= enough_m; }

  void go(double share) const {
    for (const int p : limb.parts) blend_part(character, at(p), before, wanted, share, shown);
  }

  // The greatest share of the way that is clear.
  bool stop_on_the_way() const {
    return std::ranges::any_of(kShares, [&](double share) { return go(share), is_slow() && is_clear(); });
  }

  // Joints that may go where they are wanted go there, one by one, those that carry the others first.
  void slide() const {
    for (const int j : limb.joints) {
      const Joint& joint = character.joint(j);
      std::array<double, 4> was{};
      const auto coords = shown.coords.begin() + joint.coord;
      std::copy_n(coords, coord_size(joint.kind), was.begin());
      std::copy_n(wanted.coords.begin() + joint.coord, coord_size(joint.kind), coords);
      if (!is_slow() || !is_clear()) std::copy_n(was.begin(), coord_size(joint.kind), coords);
    }
  }

  // Turns one joint to either side, about each of its axes, and keeps what gives more room.
  void yield(const Joint& joint, double step, double& most_m) const {
    const int axes = joint.kind == JointKind::ball ? 3 : 1;
    for (int i = 0; i < 2 * axes; ++i) {
      std::array<double, 4> was{};
      const auto coords = shown.coords.begin() + joint.coord;
      std::copy_n(coords, coord_size(joint.kind), was.begin());
      turn(joint, i / 2, i % 2 == 0 ? step : -step, &*coords);
      clamp_to_range(joint, &*coords);
      if (const double now_m = room_m(); now_m > most_m + kMore_m && is_slow())
        most_m = now_m;
      else
        std::copy_n(was.begin(), coord_size(joint.kind), coords);
    }
  }

  static void turn(const Joint& joint, int axis, double step, double* coords) {
    if (joint.kind != JointKind::ball) {
      coords[0] += step;
      return;
    }
    Vec3 turn_rad(0.0);
    turn_rad[axis] = step;
    const Quat q = glm::normalize(quat_at(coords) * from_rotation_vector(turn_rad));
    coords[0] = q.w, coords[1] = q.x, coords[2] = q.y, coords[3] = q.z;
  }

  void get_out() const {
    double most_m = room_m();
    for (int round = 0; round < kRounds && most_m < -kTooNear_m; ++round)
      for (const int j : limb.joints)
        if (const Joint& joint = character.joint(j); most_m < -kTooNear_m)
          yield(joint, kYield / kRounds * joint.max_speed * frame_s, most_m);
  }
};

void Clearance::begin(const Character& character, LimbRoom& room) {
  character_ = &character, room_ = &room, kept_ = 0;
  wanted_.coords.assign(at(character.coord_count()), 0.0);
}

bool Clearance::keep(std::size_t part, double frame_s, const Posture& before, Posture& shown, std::span<Rigid> world) {
  const Limb& limb = room_->limb_of(part);
  Case now{*character_, *room_, limb, part, frame_s, before, wanted_, shown, world};
  const double wanted_m = now.room_m();
  if (wanted_m >= kSlowsDown_m) return false;
  for (const int p : limb.parts) copy_part(*character_, at(p), shown, wanted_);
  now.go(0.0);
  const double room_m = now.room_m();
  now.enough_m = std::max(-kTooNear_m, std::min(kApproach * room_m, room_m - kCreep_m));
  now.go(1.0);
  if (wanted_m >= now.enough_m) return now.place(), false;
  if (now.stop_on_the_way())
    now.slide();
  else
    now.get_out();
  now.place();
  ++kept_;
  return true;
}

}  // namespace contort
