#include "generator/dynamics/possible.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "generator/dynamics/feet.h"
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
constexpr double kJolt_m_s2 = 5.0;  // by which the root's acceleration up or down changes
constexpr double kJolt_s = 0.05;    // within twice this
constexpr double kSoftly_s = 0.2;   // within which the root goes down where a leg is too short
constexpr double kReached_m = 2e-4;
constexpr double kMostLowering_m = 0.03;  // at once
constexpr double kInset_m = 0.01;         // that the zero moment point of a target keeps from the edge
constexpr double kStretch = 0.99;         // of a leg, at most
constexpr double kUnmoved_m = 1e-4;       // moves below this are not made
constexpr double kLeastPressure = 0.2;    // of the weight, below which the figure counts as flying

// What the ground would have to give in a frame.
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
  // Takes the jolts out of the way of the root up and down, which would press on legs that bear: there the height
  // becomes a moving mean, lowered until it is nowhere above what it was.
  void soften() {
    const int count = motion_.frame_count, last = count - 1;
    const double rate2 = motion_.rate_hz * motion_.rate_hz;
    const int reach = std::max(1, static_cast<int>(kSoftly_s * motion_.rate_hz));
    std::vector<double> was_m, share(at(count), 0.0);
    for (int f = 0; f < count; ++f) was_m.push_back(motion_.root[at(f)].p_m.y);
    bool any = false;
    const int beside = std::max(1, static_cast<int>(std::lround(kJolt_s * motion_.rate_hz)));
    const auto lift = [&](int f) { return rate2 * (was_m[at(f + 1)] - 2.0 * was_m[at(f)] + was_m[at(f - 1)]); };
    for (int f = 1 + beside; f < last - beside; ++f) {
      if (std::fabs(lift(f + beside) - lift(f - beside)) < kJolt_m_s2) continue;
      any = true;
      for (int k = std::max(0, f - 2 * reach); k <= std::min(last, f + 2 * reach); ++k) share[at(k)] = 1.0;
    }
    for (int f = 0; f < count; ++f)
      if (plan_.standing(f) == 0)
        for (int k = std::max(0, f - reach); k <= std::min(last, f + reach); ++k) share[at(k)] = 0.0;
    if (!any) return;
    smooth(reach, share);
    std::vector<double> lower_m(at(count), 0.0), height_m;
    for (int again = 0; again < 4; ++again) {
      height_m = was_m;
      for (int f = 0; f < count; ++f) height_m[at(f)] -= lower_m[at(f)];
      smooth(reach / 2, height_m);
      std::vector<double> over_m(at(count), 0.0);
      for (int f = 0; f < count; ++f)
        for (int k = std::max(0, f - reach / 2); k <= std::min(last, f + reach / 2); ++k)
          over_m[at(f)] = std::max(over_m[at(f)], height_m[at(k)] - was_m[at(k)]);
      for (int f = 0; f < count; ++f) lower_m[at(f)] += over_m[at(f)];
    }
    for (int f = 0; f < count; ++f) motion_.root[at(f)].p_m.y += share[at(f)] * (height_m[at(f)] - was_m[at(f)]);
    keep_all_soles();
  }

  // A moving mean, twice.
  static void smooth(int window, std::vector<double>& values) {
    const int last = static_cast<int>(values.size()) - 1;
    for (int twice = 0; twice < 2; ++twice) {
      const std::vector<double> before = values;
      for (int f = 0; f <= last; ++f) {
        double sum = 0.0;
        for (int k = -window; k <= window; ++k) sum += before[at(std::clamp(f + k, 0, last))];
        values[at(f)] = sum / (2 * window + 1);
      }
    }
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
    FigureState state = standing_start(body_, target);
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

  // Where the zero moment point of a frame is, on the plane through the bearing corners' mean; and where it should be.
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

  // Fills one row of the tridiagonal system (low, middle, high) u = right for both horizontal axes.
  bool find_shift() {
    const int count = motion_.frame_count;
    const double rate2 = motion_.rate_hz * motion_.rate_hz;
    std::vector<double> middle, low, high;
    std::vector<Vec3> right;
    bool any = false;
    for (int f = 0; f < count; ++f) {
      const Need& need = needs_[at(f)];
      Vec3 is, wanted, ask;
      const bool stands = find_points(f, is, wanted);
      double height_m = 1.0, pressure_N = 0.0;
      if (stands) {
        height_m = std::max(need.com_m.y - wanted.y, 0.2);
        pressure_N = need.force_N.y;
        // The moment about the wanted point is f (is - wanted) across.
        ask = -pressure_N * (wanted - is);
      } else {
        ask = Vec3(-height_m * need.force_N.x, 0.0, -height_m * need.force_N.z);
        height_m = 1.0;
      }
      ask.y = 0.0;
      any = any || length(ask) > kUnmoved_m * mass() * kGravity_m_s2;
      const double spread = mass() * height_m * rate2;
      const double omega = std::sqrt(kGravity_m_s2 / std::max(need.com_m.y, 0.2));
      const double outside = 1.0 / (1.0 + omega / motion_.rate_hz);  // of the shift a frame before the first
      middle.push_back(-2.0 * spread - pressure_N);
      if (f == 0) middle.back() += outside * spread;
      if (f == count - 1) middle.back() += outside * spread;
      low.push_back(spread), high.push_back(spread);
      right.push_back(ask);
    }
    if (!any) return false;
    for (int f = 1; f < count; ++f) {
      const double share = low[at(f)] / middle[at(f - 1)];
      middle[at(f)] -= share * high[at(f - 1)];
      right[at(f)] -= share * right[at(f - 1)];
    }
    Vec3 next(0.0);
    for (int f = count - 1; f >= 0; --f) {
      next = (right[at(f)] - (f + 1 < count ? high[at(f)] : 0.0) * next) / middle[at(f)];
      shift_m_[at(f)] = next;
    }
    return true;
  }

  void move() {
    start_m_s_ += std::sqrt(kGravity_m_s2 / std::max(needs_.front().com_m.y, 0.2)) * shift_m_.front();
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
    out.start_m_s = start_m_s_;
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
  Vec3 start_m_s_{0.0};
  HullScratch hull_;
};

}  // namespace

BalancePlan make_possible(const Character& character, const DynamicFigure& figure, const ContactPlan& plan,
                          Motion& motion) {
  return PossibleTarget(character, figure, plan, motion).run();
}

}  // namespace contort
