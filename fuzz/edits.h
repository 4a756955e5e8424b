// Units that shrinking may remove from a spec: those of one kind, in all lists together.
#pragma once

#include <span>

#include "model/spec/spec.h"

namespace contort {

// The sequences of the queue, then those of the interrupts: s counts through both.
std::size_t sequence_count(const Spec& spec);
SequenceDesc& sequence_at(Spec& spec, std::size_t s);
const SequenceDesc& sequence_at(const Spec& spec, std::size_t s);

// Units of one kind that a spec consists of, numbered through.
struct UnitKind {
  const char* name;
  int (*count)(const Spec&);
  void (*remove)(Spec&, int first, int count);
};

// From coarse to fine: sequences, interrupts, clips, actions; the surroundings; swapped parts, parameters.
std::span<const UnitKind> unit_kinds();

}  // namespace contort
