// Checks that the legs of a posture fit: within the ranges of their joints, and without touching other bodies.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "generator/dynamics/body_contacts.h"
#include "generator/dynamics/figure.h"

namespace contort {

class LegFit {
 public:
  // All must outlive this object.
  LegFit(const Character& character, const DynamicFigure& figure, std::span<const Leg> legs);

  // Returns true if a hinge of a leg is beyond its range.
  bool overbend(std::span<const double> row) const;

  // Returns true if one of these legs (bit i: leg i) overlaps another body. If there are legs, the scratch is placed
  // anew.
  bool overlap(std::uint8_t legs, const Rigid& root, std::span<const double> row, DynamicsScratch& scratch);
  // Returns true if another body is nearer to one of them than this.
  bool is_near(std::uint8_t legs, double gap_m, const Rigid& root, std::span<const double> row,
               DynamicsScratch& scratch);

 private:
  const Character& character_;
  const Multibody& body_;
  std::span<const Leg> legs_;
  BodyContacts bodies_;
  std::vector<std::uint8_t> leg_of_;  // by link: bit i if it belongs to leg i
};

}  // namespace contort
