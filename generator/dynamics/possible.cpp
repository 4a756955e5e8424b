#include "generator/dynamics/possible.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "generator/dynamics/feet.h"
#include "generator/dynamics/leg_fit.h"
#include "generator/dynamics/re_aim.h"
#include "generator/dynamics/retreat.h"
#include "generator/dynamics/shift_rows.h"
#include "generator/dynamics/soft_joints.h"
#include "generator/dynamics/support_hull.h"
#include "generator/dynamics/target.h"
#include "generator/dynamics/tracker.h"
#include "generator/motion/lowering.h"
#include "generator/motion/place_foot.h"
#include "generator/motion/soft_height.h"
#include "model/core/detmath.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kPasses = 8;
constexpr int kLowerings = 3;
constexpr double kLowestBody_m = 0.2;
constexpr double kInset_m = 0.02;         // that the zero moment point of a target keeps from the edge
constexpr double kInsetOfSteps_m = 0.026; // the same while a foot is off the ground: tracking is less exact then
constexpr double kStretch = 0.99;         // of a leg, at most
constexpr double kEasyStretch = 0.97;
constexpr double kStretched = 0.997;
constexpr double kLetsGo_s = 0.15;
constexpr double kUnmoved_m = 1e-4;       // moves below this are not made
constexpr double kTravels_m_s = 0.2;
constexpr int kRetreats = 14;
constexpr double kOff_m = 0.005;          // of the zero moment point from where it should be
constexpr double kLeastPressure = 0.2;    // of the weight, below which the figure counts as flying

// The force and moment that the ground would have to give in a frame.
struct Need {
  Vec3 com_m{0.0};
  Vec3 force_N{0.0};
  Vec3 moment_N_m{0.0};  // about the world's origin
};

// All joints of legs and of what carries them, carriers first; without the root.
std::vector<int> joints_down_to_feet(const Character& character, std::span<const Leg> legs) {
  std::vector<char> needed(character.joints().size(), 0);
  for (const Leg& leg : legs)
    for (const int joint : leg.joints)
      for (int j = joint; j > 0; j = character.joint(j).parent) needed[at(j)] = 1;
  std::vector<int> joints;
  for (int j = 1; j < static_cast<int>(needed.size()); ++j)
    if (needed[at(j)] != 0) joints.push_back(j);
  return joints;
}

class PossibleTarget {
 public:
  PossibleTarget(const Character& character, const DynamicFigure& figure, const ContactPlan& plan, double missed,
                 Motion& motion)
      : character_(character),
        figure_(figure),
        missed_(missed),
        body_(Multibody::of(character)),
        plan_(plan),
        motion_(motion) {
    state_ = moving_start(body_, TargetMotion(body_, motion));
    acceleration_.assign(state_.velocity.size(), 0.0);
    forces_ = acceleration_;
    shift_m_.assign(at(motion.frame_count), Vec3(0.0)), shifted_m_ = shift_m_;
    world_.resize(character.joints().size());
  }

  BalancePlan run(bool changed) {
    if (changed || is_stretched()) keep_all_soles(), lower_where_needed();
    soften();
    settle();
    for (int again = 0; again < kRetreats && retreat(); ++again) settle();
    re_aim(character_, legs_, missed_, motion_);
    measure();
    return balance();
  }

 private:
  // Passes that lead farther away from what the ground can hold are taken back: a small shift does what the system
  // says, but a figure that would have to go far has other legs and moments there.
  void settle() {
    const Motion given = motion_;
    const std::vector<Vec3> given_shift_m = shifted_m_;
    double given_N_m = 0.0;
    for (int pass = 0; pass < kPasses; ++pass) {
      measure();
      if (!find_shift()) return;
      if (pass == 0) given_N_m = asked_N_m_;
      move();
    }
    measure();
    if (!find_shift() || asked_N_m_ <= given_N_m) return;
    motion_.root = given.root, motion_.coords = given.coords, shifted_m_ = given_shift_m;
    measure();
  }

  // Brings the figure nearer to standing where its legs cannot take the posture or the ground cannot hold it. Answers
  // whether there is such a place.
  bool retreat() {
    std::vector<char> impossible;
    for (int f = 0; f < motion_.frame_count; ++f) impossible.push_back(is_impossible(f) ? 1 : 0);
    if (!retreat_.go(impossible, motion_)) return false;
    shift_back();
    keep_all_soles(), lower_where_needed();
    return true;
  }

  bool is_impossible(int frame) {
    if (plan_.standing(frame) == 0) return false;
    if (overloaded_[at(frame)]) return true;
    Vec3 is, wanted;
    if (find_points(frame, is, wanted) && length(wanted - is) > kOff_m) return true;
    return legs_fit_.overbend(motion_.row(frame)) ||
           legs_fit_.overlap(retreat_.lifted(frame), motion_.root[at(frame)], motion_.row(frame), dynamics_);
  }


  // Takes the jolts out of the way of the root up and down. Flights keep their heights.
  void soften() {
    std::vector<double> heights_m;
    std::vector<char> flies;
    for (int f = 0; f < motion_.frame_count; ++f) {
      heights_m.push_back(motion_.root[at(f)].p_m.y);
      flies.push_back(plan_.standing(f) == 0 ? 1 : 0);
    }
    const std::vector<double> soft_m = without_jolts(heights_m, flies, motion_.rate_hz);
    if (soft_m == heights_m) return;
    for (int f = 0; f < motion_.frame_count; ++f) motion_.root[at(f)].p_m.y = soft_m[at(f)];
    keep_all_soles();
  }

  double mass() const { return body_.mass_kg(); }

  void measure() {
    const TargetMotion target(body_, motion_);
    needs_.clear(), speeds_.clear(), overloaded_.clear();
    for (int f = 0; f < motion_.frame_count; ++f) measure(target, f);
  }

  // With the accelerations that tracking takes from the target in this frame.
  void measure(const TargetMotion& target, int frame) {
    FigureState& state = state_;
    target.root_at(frame, state.root, state.velocity.data());
    target.root_acceleration_at(frame, acceleration_.data());
    for (const Link& link : body_.links().subspan(1)) {
      target.joint_at(link, frame, &state.coords[at(link.coord)], &state.velocity[at(link.dof)]);
      target.joint_acceleration_at(link, frame, &acceleration_[at(link.dof)]);
    }
    place(body_, state.root, state.coords, dynamics_);
    inverse_dynamics(body_, state.velocity, acceleration_, kGravity_m_s2, dynamics_, forces_);
    Vec3 moment(0.0), momentum(0.0);
    double mass_kg = 0.0;
    for (std::size_t i = 0; i < body_.links().size(); ++i) {
      if (body_.links()[i].massless) continue;
      momentum += (dynamics_.inertia[i] * dynamics_.velocity[i]).force.narrow();
      moment += dynamics_.inertia[i].first_moment.narrow(), mass_kg += dynamics_.inertia[i].mass_kg;
    }
    const Vec3 root = state.root.p_m, force(forces_[0], forces_[1], forces_[2]);
    const Vec3 torque = state.root.q * Vec3(forces_[3], forces_[4], forces_[5]);
    needs_.push_back({root + (1.0 / mass_kg) * moment, force, torque + glm::cross(root, force)});
    speeds_.push_back((1.0 / mass_kg) * momentum);
    overloaded_.push_back(overloads(bears(frame), {torque, force}) ? 1 : 0);
  }

  // Returns true if a leg's joint needs more effort than it has while one sole bears everything. `forces_` are those of
  // a figure that nothing bears, and `ground` what the ground gives, about the root's origin.
  bool overloads(std::uint8_t bearing, const SpatialForce& ground) {
    if (std::popcount(bearing) != 1) return false;
    for (const int dof : figure_.soles[at(std::countr_zero(bearing))].chain_dofs)
      forces_[at(dof)] -= dot(dynamics_.freedoms[at(dof)], ground);
    return std::ranges::any_of(figure_.soles, [&](const Sole& sole) {
      return std::ranges::any_of(sole.leg_dofs, [&](int dof) {
        return forces_[at(dof)] > figure_.strength_high[at(dof)] || forces_[at(dof)] < figure_.strength_low[at(dof)];
      });
    });
  }

  // The soles that bear in a frame and beside it: tracking goes from one frame to the next, so the weight must be where
  // it may be in both.
  std::uint8_t bears(int frame) const {
    const int last = motion_.frame_count - 1;
    const std::uint8_t now = plan_.standing(frame);
    const std::uint8_t before = plan_.standing(std::max(frame - 1, 0));
    const std::uint8_t after = plan_.standing(std::min(frame + 1, last));
    const std::uint8_t always = now & before & after;
    return always != 0 ? always : now;
  }

  // Corners that bear in a frame, in the world.
  void find_corners(int frame) {
    corners_.clear();
    const std::uint8_t bearing = bears(frame);
    // Either of two flat feet may have to bear everything; of four, half of it. A figure on its toes shares its weight.
    const double all_N = needs_[at(frame)].force_N.y, count = std::max(1, std::popcount(bearing));
    for (std::size_t i = 0; i < figure_.soles.size(); ++i) {
      if ((bearing & (1U << i)) == 0) continue;
      const Sole& sole = figure_.soles[i];
      const Rigid world_from_link = plan_.sole(frame, static_cast<int>(i)) * inverse(sole.link_from_sole);
      const std::size_t first = corners_.size();
      const Bearing& on = plan_.bearing(frame, static_cast<int>(i));
      const double shares = on.corners == kAllCorners ? std::max(1.0, 0.5 * count) : count;
      add_bearing_points(sole, on, all_N / shares, corners_);
      for (Vec3& corner : std::span(corners_).subspan(first)) corner = world_from_link * corner;
    }
  }

  // Finds where the zero moment point of a frame is, on the plane through the bearing corners' mean, and where it
  // should be. Answers whether the frame has one: not in flight.
  bool find_points(int frame, Vec3& is, Vec3& wanted) {
    find_corners(frame);
    const Need& need = needs_[at(frame)];
    if (corners_.empty() || need.force_N.y < kLeastPressure * mass() * kGravity_m_s2) return false;
    double height_m = 0.0;
    for (const Vec3& corner : corners_) height_m += corner.y / static_cast<double>(corners_.size());
    is = zmp_at(need, height_m);
    const bool all_bear = std::popcount(bears(frame)) == static_cast<int>(figure_.soles.size());
    wanted = nearest_inside(corners_, all_bear ? kInset_m : kInsetOfSteps_m, is, hull_);
    return true;
  }

  static Vec3 zmp_at(const Need& need, double height_m) {
    const Vec3 n = need.moment_N_m - glm::cross(Vec3(0.0, height_m, 0.0), need.force_N);
    return {n.z / need.force_N.y, height_m, -n.x / need.force_N.y};
  }

  // One row of the system: what a shift of this frame must do, and how it depends on the frames beside it.
  ShiftRow row_of(int frame) {
    const Need& need = needs_[at(frame)];
    Vec3 is, wanted;
    ShiftRow row;
    row.spread = mass() * motion_.rate_hz * motion_.rate_hz;
    if (find_points(frame, is, wanted)) {
      row.spread *= std::max(need.com_m.y - wanted.y, kLowestBody_m);
      row.pressure_N = need.force_N.y;
      row.ask = -row.pressure_N * (wanted - is);  // the moment about the wanted point, across
    } else {
      row.ask = -need.force_N;  // nothing pushes in flight
    }
    row.ask.y = 0.0;
    return row;
  }

  // The shift of every frame. Answers whether there is anything to move.
  bool find_shift() {
    std::vector<ShiftRow> rows;
    bool any = false;
    asked_N_m_ = 0.0;
    for (int f = 0; f < motion_.frame_count; ++f) {
      rows.push_back(row_of(f));
      asked_N_m_ += length(rows.back().ask);
      any = any || length(rows.back().ask) > kUnmoved_m * mass() * kGravity_m_s2;
    }
    if (any) solve_shift(rows, end_at(0), end_at(motion_.frame_count - 1), shift_m_);
    return any;
  }

  // Before its first frame and after its last one a figure stands still there, or goes on elsewhere if it travels.
  ShiftEnd end_at(int frame) {
    const Need& need = needs_[at(frame)];
    const double height_m = std::max(need.com_m.y, kLowestBody_m);
    ShiftEnd end{std::sqrt(kGravity_m_s2 / height_m) / motion_.rate_hz, Vec3(0.0)};
    Vec3 speed = speeds_[at(frame)];
    speed.y = 0.0;
    find_corners(frame);
    if (corners_.empty() || length(speed) > kTravels_m_s) return end;
    end.rest_m = nearest_inside(corners_, kInset_m, need.com_m, hull_) - need.com_m;
    end.rest_m.y = 0.0;
    return end;
  }

  void move() {
    for (int f = 0; f < motion_.frame_count; ++f)
      motion_.root[at(f)].p_m += shift_m_[at(f)], shifted_m_[at(f)] += shift_m_[at(f)];
    keep_all_soles();
    lower_where_needed();
  }

  // Takes back all shifts so far: a motion that has come nearer to standing needs others.
  void shift_back() {
    for (int f = 0; f < motion_.frame_count; ++f) motion_.root[at(f)].p_m -= shifted_m_[at(f)];
    std::ranges::fill(shifted_m_, Vec3(0.0));
  }

  void lower_where_needed() {
    for (int again = 0; again < kLowerings && lower_softly(missing_m_, motion_); ++again) keep_all_soles();
  }

  // Returns true if a standing leg is stretched to its full length: a figure that follows it would overstretch it.
  bool is_stretched() {
    for (int f = 0; f < motion_.frame_count; ++f) {
      forward_kinematics(character_, motion_.root[at(f)], motion_.row(f), world_);
      for (std::size_t i = 0; i < legs_.size(); ++i) {
        const Rigid& sole = plan_.sole(f, static_cast<int>(i));
        const bool stands = (plan_.standing(f) & (1U << i)) != 0;
        if (stands && too_high_m(legs_[i], hip_m(legs_[i]), sole, kStretched) > 0.0) return true;
      }
    }
    return false;
  }

  void keep_all_soles() {
    missing_m_.resize(at(motion_.frame_count));
    for (int f = 0; f < motion_.frame_count; ++f) missing_m_[at(f)] = keep_soles(f);
  }

  // Puts all feet of a frame back. Answers by how much the root is too high for the longest leg, m.
  double keep_soles(int frame) {
    const std::span<double> row = motion_.row(frame);
    world_[0] = motion_.root[at(frame)];
    forward_kinematics(character_, row, leg_joints_, world_);
    double most_m = 0.0;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const Rigid wanted = within_reach(i, frame);
      place_foot(character_, legs_[i], world_, wanted, row);
      most_m = std::max(most_m, too_high_m(legs_[i], hip_m(legs_[i]), wanted, kStretch));
    }
    return most_m;
  }

  // A sole in the air comes nearer to a hip that has moved away from it, the more the straighter its leg would be:
  // knees that become straight are fast. Before it lands, and after it is lifted, a sole is where it is planned.
  Rigid within_reach(std::size_t leg, int frame) const {
    Rigid sole = retreat_.sole(frame, static_cast<int>(leg));
    const double free = plan_.airborne(frame, static_cast<int>(leg)) / (kLetsGo_s * motion_.rate_hz);
    if (free <= 0.0) return sole;
    const Vec3 way = sole * legs_[leg].sole_from_ankle - hip_m(legs_[leg]);
    const double far_m = length(way), easy_m = kEasyStretch * legs_[leg].length_m;
    if (far_m <= easy_m) return sole;
    const double more_m = (kStretch - kEasyStretch) * legs_[leg].length_m;
    const double soft_m = easy_m + more_m * (1.0 - det::exp(-(far_m - easy_m) / more_m));
    sole.p_m += way * (std::min(1.0, free) * (soft_m / far_m - 1.0));
    return sole;
  }

  Vec3 hip_m(const Leg& leg) const { return world_[at(character_.parts()[at(leg.part)].reach.front().upper)].p_m; }

  BalancePlan balance() {
    BalancePlan out;
    for (int f = 0; f < motion_.frame_count; ++f) {
      Vec3 is, wanted;
      const Need& need = needs_[at(f)];
      out.com_m.push_back(need.com_m);
      out.com_m_s.push_back(speeds_[at(f)]);
      out.zmp_m.push_back(find_points(f, is, wanted) ? wanted : need.com_m);
    }
    return out;
  }

  const Character& character_;
  const DynamicFigure& figure_;
  const double missed_;
  const Multibody body_;
  const ContactPlan& plan_;
  Motion& motion_;
  DynamicsScratch dynamics_;
  const std::vector<Leg> legs_ = find_legs(character_);
  const std::vector<int> leg_joints_ = joints_down_to_feet(character_, legs_);
  std::vector<Rigid> world_;
  FigureState state_;
  std::vector<double> acceleration_, forces_, missing_m_;
  std::vector<Need> needs_;
  double asked_N_m_ = 0.0;  // the sum of all frames' moments that a shift is to remove
  std::vector<Vec3> speeds_, shift_m_, corners_;
  std::vector<Vec3> shifted_m_;  // the sum of all shifts, by frame
  LegFit legs_fit_{character_, figure_, legs_};
  Retreat retreat_{character_, plan_, legs_, motion_};
  std::vector<char> overloaded_;  // by frame
  HullScratch hull_;
};

}  // namespace

BalancePlan make_possible(const Character& character, const DynamicFigure& figure, std::span<const double> easy,
                          const ContactPlan& plan, int ticks_per_frame, Motion& motion) {
  const bool changed = soften_joints(character, find_legs(character), easy, motion);
  const double missed = missed_of_bend(ticks_per_frame);
  return PossibleTarget(character, figure, plan, missed, motion).run(changed);
}

}  // namespace contort
