// What shrinking may do to a spec: remove units of one kind, set fields to their defaults, move numbers.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "generator/spec.h"

namespace contort {

// Units of one kind that a spec consists of, numbered through.
struct UnitKind {
  const char* name;
  int (*count)(const Spec&);
  void (*remove)(Spec&, int first, int count);
};

// Coarse to fine: sequences, clips, actions, attachments, swapped parts, parameters.
std::span<const UnitKind> unit_kinds();

// One change to one field towards its default.
using Edit = std::function<void(Spec&)>;
std::vector<Edit> default_edits(const Spec& spec);

// A number of a spec that may be moved towards its default.
struct NumberRef {
  std::function<double&(Spec&)> at;
  double preset = 0.0;
  double steps_per_unit = 1.0;  // stay on multiples of 1 / this
};
std::vector<NumberRef> numbers_of(const Spec& spec);

}  // namespace contort
