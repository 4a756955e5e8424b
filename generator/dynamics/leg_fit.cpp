#include "generator/dynamics/leg_fit.h"

#include <algorithm>
#include <cmath>

#include "generator/motion/joint_clamp.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr double kBeyond_rad = 1e-5;
constexpr double kOverlap_m = 0.0005;

}  // namespace

LegFit::LegFit(const Character& character, const DynamicFigure& figure, std::span<const Leg> legs)
    : character_(character), body_(figure.body), legs_(legs), leg_of_(character.joints().size(), 0) {
  bodies_.begin(character, figure);
  for (std::size_t i = 0; i < legs.size(); ++i)
    for (const int joint : legs[i].joints) leg_of_[at(joint)] |= static_cast<std::uint8_t>(1U << i);
}

bool LegFit::overbend(std::span<const double> row) const {
  const auto is_beyond = [&](int j) {
    const Joint& joint = character_.joint(j);
    if (joint.kind != JointKind::hinge) return false;
    double inside = row[at(joint.coord)];
    clamp_to_range(joint, &inside);
    return std::fabs(inside - row[at(joint.coord)]) > kBeyond_rad;
  };
  return std::ranges::any_of(legs_, [&](const Leg& leg) { return std::ranges::any_of(leg.joints, is_beyond); });
}

bool LegFit::overlap(std::uint8_t legs, const Rigid& root, std::span<const double> row, DynamicsScratch& scratch) {
  return is_near(legs, -kOverlap_m, root, row, scratch);
}

bool LegFit::is_near(std::uint8_t legs, double gap_m, const Rigid& root, std::span<const double> row,
                     DynamicsScratch& scratch) {
  if (legs == 0) return false;
  place(body_, root, row, scratch);
  bodies_.find(scratch, std::max(0.0, gap_m), false);
  return std::ranges::any_of(bodies_.contacts(), [&](const BodyContact& contact) {
    return contact.gap_m < gap_m && ((leg_of_[at(contact.link_a)] | leg_of_[at(contact.link_b)]) & legs) != 0;
  });
}

}  // namespace contort
