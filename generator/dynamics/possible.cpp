#include "generator/dynamics/possible.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "generator/dynamics/feet.h"
#include "generator/dynamics/soft_height.h"
#include "generator/dynamics/support_hull.h"
#include "generator/dynamics/target.h"
#include "generator/dynamics/tracker.h"
#include "generator/motion/place_foot.h"
#include "model/core/index.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kPasses = 8;
constexpr int kLowerings = 3;
constexpr double kSoftly_s = 0.2;  // within which the root goes down where a leg is too short
constexpr double kReached_m = 2e-4;
constexpr double kLowestBody_m = 0.2;
constexpr double kMostLowering_m = 0.03;  // at once
constexpr double kInset_m = 0.01;         // that the zero moment point of a target keeps from the edge
constexpr double kStretch = 0.99;         // of a leg, at most
constexpr double kUnmoved_m = 1e-4;       // moves below this are not made
constexpr double kLeastPressure = 0.2;    // of the weight, below which the figure counts as flying

// The force and moment that the ground would have to give in a frame.
struct Need {
  Vec3 com_m{0.0};
  Vec3 force_N{0.0};
  Vec3 moment_N_m{0.0};  // about the world's origin
};

struct Momentum {
  Vec3 com_m{0.0};
  Vec3 linear{0.0};
  Vec3 angular{0.0};  // about the world's origin
};

// m h u'' - f u = ask for a frame's shift u, both horizontal axes.
struct Row {
  double spread = 0.0;  // m h, for differences between frames
  double pressure_N = 0.0;
  Vec3 ask{0.0};
};

class PossibleTarget {
 public:
  PossibleTarget(const Character& character, const DynamicFigure& figure, const ContactPlan& plan, Motion& motion)
      : character_(character), figure_(figure), body_(Multibody::of(character)), plan_(plan), motion_(motion) {
    velocity_.assign(at(body_.dof_count()), 0.0);
    zeros_ = forces_ = velocity_;
    shift_m_.assign(at(motion.frame_count), Vec3(0.0));
    world_.resize(character.joints().size());
  }

  BalancePlan run() {
    soften();
    for (int pass = 0; pass < kPasses; ++pass) {
      measure();
      if (!find_shift()) break;
      move();
    }
    measure();
    return balance();
  }

 private:
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
    std::vector<Momentum> momenta;
    for (int f = 0; f < motion_.frame_count; ++f) momenta.push_back(momentum_at(target, f));
    needs_.assign(momenta.size(), {});
    const int last = motion_.frame_count - 1;
    if (last >= 2) continue_to(momenta[0], momenta[1], momenta[2]);
    if (last >= 2) continue_to(momenta[at(last)], momenta[at(last - 1)], momenta[at(last - 2)]);
    for (int f = 0; f <= last; ++f) {
      const int before = std::max(f - 1, 0), after = std::min(f + 1, last);
      const double per_s = motion_.rate_hz / std::max(after - before, 1);
      const Momentum &a = momenta[at(before)], &b = momenta[at(after)];
      const Vec3 weight(0.0, mass() * kGravity_m_s2, 0.0), com = momenta[at(f)].com_m;
      needs_[at(f)] = {com, per_s * (b.linear - a.linear) + weight,
                       per_s * (b.angular - a.angular) + glm::cross(com, weight)};
      speeds_.resize(momenta.size());
      speeds_[at(f)] = momenta[at(f)].linear / mass();
    }
  }

  // A target's ends have no rates of their own: momentum goes on there as it goes beside them.
  static void continue_to(Momentum& end, const Momentum& next, const Momentum& second) {
    end.linear = 2.0 * next.linear - second.linear;
    end.angular = 2.0 * next.angular - second.angular;
  }

  Momentum momentum_at(const TargetMotion& target, int frame) {
    FigureState state = moving_start(body_, target);
    target.root_at(frame, state.root, velocity_.data());
    for (const Link& link : body_.links().subspan(1))
      target.joint_at(link, frame, &state.coords[at(link.coord)], &velocity_[at(link.dof)]);
    place(body_, state.root, state.coords, dynamics_);
    inverse_dynamics(body_, velocity_, zeros_, 0.0, dynamics_, forces_);
    SpatialForce sum;
    Vec3 moment(0.0);
    double mass_kg = 0.0;
    for (std::size_t i = 0; i < body_.links().size(); ++i) {
      if (body_.links()[i].massless) continue;
      sum += dynamics_.inertia[i] * dynamics_.velocity[i];
      moment += dynamics_.inertia[i].first_moment.narrow(), mass_kg += dynamics_.inertia[i].mass_kg;
    }
    const Vec3 root = state.root.p_m;
    return {root + (1.0 / mass_kg) * moment, sum.force.narrow(), sum.moment + glm::cross(root, sum.force.narrow())};
  }

  // Corners that bear in a frame, in the world.
  void find_corners(int frame) {
    corners_.clear();
    const double alone_N = std::popcount(plan_.standing(frame)) == 1 ? needs_[at(frame)].force_N.y : 0.0;
    for (std::size_t i = 0; i < figure_.soles.size(); ++i) {
      const Sole& sole = figure_.soles[i];
      const Rigid world_from_link = plan_.sole(frame, static_cast<int>(i)) * inverse(sole.link_from_sole);
      const std::size_t first = corners_.size();
      add_bearing_points(sole, plan_.bearing(frame, static_cast<int>(i)), alone_N, corners_);
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
    wanted = nearest_inside(corners_, kInset_m, is, hull_);
    return true;
  }

  static Vec3 zmp_at(const Need& need, double height_m) {
    const Vec3 n = need.moment_N_m - glm::cross(Vec3(0.0, height_m, 0.0), need.force_N);
    return {n.z / need.force_N.y, height_m, -n.x / need.force_N.y};
  }

  // One row of the system: what a shift of this frame must do, and how it depends on the frames beside it.
  Row row_of(int frame) {
    const Need& need = needs_[at(frame)];
    Vec3 is, wanted;
    Row row;
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
    std::vector<Row> rows;
    bool any = false;
    for (int f = 0; f < motion_.frame_count; ++f) {
      rows.push_back(row_of(f));
      any = any || length(rows.back().ask) > kUnmoved_m * mass() * kGravity_m_s2;
    }
    if (any) solve_rows(rows);
    return any;
  }

  // Gauss's elimination, down and up again. Before the first frame and after the last the shift fades as a pendulum
  // does.
  void solve_rows(std::vector<Row>& rows) {
    const std::size_t count = rows.size();
    std::vector<double> middle;
    for (const Row& row : rows) middle.push_back(-2.0 * row.spread - row.pressure_N);
    for (const std::size_t end : {std::size_t{0}, count - 1})
      middle[end] += rows[end].spread / (1.0 + pendulum_per_s(end) / motion_.rate_hz);
    for (std::size_t f = 1; f < count; ++f) {
      const double share = rows[f].spread / middle[f - 1];
      middle[f] -= share * rows[f - 1].spread;
      rows[f].ask -= share * rows[f - 1].ask;
    }
    Vec3 next(0.0);
    for (std::size_t f = count; f-- > 0;) {
      next = (rows[f].ask - (f + 1 < count ? rows[f].spread : 0.0) * next) / middle[f];
      shift_m_[f] = next;
    }
  }

  double pendulum_per_s(std::size_t frame) const {
    return std::sqrt(kGravity_m_s2 / std::max(needs_[frame].com_m.y, kLowestBody_m));
  }

  void move() {
    for (int f = 0; f < motion_.frame_count; ++f) motion_.root[at(f)].p_m += shift_m_[at(f)];
    keep_all_soles();
    for (int again = 0; again < kLowerings && lower(missing_m_); ++again) keep_all_soles();
  }

  void keep_all_soles() {
    missing_m_.resize(at(motion_.frame_count));
    for (int f = 0; f < motion_.frame_count; ++f) missing_m_[at(f)] = keep_soles(f);
  }

  // Lowers the root, softly, where a leg is too short for its sole. Answers whether there was such a place.
  bool lower(const std::vector<double>& missing_m) {
    const int reach = std::max(1, static_cast<int>(kSoftly_s * motion_.rate_hz));
    std::vector<double> lower_m(missing_m.size(), 0.0);
    const int count = motion_.frame_count;
    bool any = false;
    for (int f = 0; f < count; ++f) {
      if (missing_m[at(f)] <= kReached_m) continue;
      any = true;
      for (int g = std::max(0, f - reach); g <= std::min(count - 1, f + reach); ++g) {
        const double away = static_cast<double>(g - f) / (reach + 1), near = (1.0 - away * away);
        lower_m[at(g)] = std::max(lower_m[at(g)], std::min(missing_m[at(f)], kMostLowering_m) * near * near);
      }
    }
    for (int f = 0; f < count; ++f) motion_.root[at(f)].p_m.y -= lower_m[at(f)];
    return any;
  }

  // Puts all feet of a frame back. Answers by how much the root is too high for the longest leg, m.
  double keep_soles(int frame) {
    const std::span<double> row = motion_.row(frame);
    forward_kinematics(character_, motion_.root[at(frame)], row, world_);
    double most_m = 0.0;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const Rigid& wanted = plan_.sole(frame, static_cast<int>(i));
      place_foot(character_, legs_[i], world_, wanted, row);
      most_m = std::max(most_m, too_far_m(legs_[i], wanted));
    }
    return most_m;
  }

  double too_far_m(const Leg& leg, const Rigid& sole) const {
    const Vec3 hip = world_[at(character_.parts()[at(leg.part)].reach.front().upper)].p_m;
    const Vec3 way = sole * leg.sole_from_ankle - hip;
    const double longest_m = kStretch * leg.length_m, level2 = way.x * way.x + way.z * way.z;
    return std::max(0.0, -way.y - std::sqrt(std::max(0.0, longest_m * longest_m - level2)));
  }

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
  const Multibody body_;
  const ContactPlan& plan_;
  Motion& motion_;
  DynamicsScratch dynamics_;
  const std::vector<Leg> legs_ = find_legs(character_);
  std::vector<Rigid> world_;
  std::vector<double> velocity_, zeros_, forces_, missing_m_;
  std::vector<Need> needs_;
  std::vector<Vec3> speeds_, shift_m_, corners_;
  HullScratch hull_;
};

}  // namespace

BalancePlan make_possible(const Character& character, const DynamicFigure& figure, const ContactPlan& plan,
                          Motion& motion) {
  return PossibleTarget(character, figure, plan, motion).run();
}

}  // namespace contort
