// Units that shrinking may remove from a spec. Units of one kind are numbered across all lists of the spec.
#pragma once

#include <span>

#include "model/spec/spec.h"

namespace contort {

// The number of all sequences, and sequence s: sequences of the queue come first, then those of the interrupts.
std::size_t sequence_count(const Spec& spec);
SequenceDesc& sequence_at(Spec& spec, std::size_t s);
const SequenceDesc& sequence_at(const Spec& spec, std::size_t s);

// The units of one kind, numbered from 0.
struct UnitKind {
  const char* name;
  int (*count)(const Spec&);
  void (*remove)(Spec&, int first, int count);
};

// Returns all kinds of units, from coarse to fine: sequences, interrupts, clips, actions; the surroundings; swapped
// parts, parameters.
std::span<const UnitKind> unit_kinds();

}  // namespace contort
