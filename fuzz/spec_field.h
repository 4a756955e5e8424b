// Places in a spec that have defaults: what shrinking resets and moves, what explaining varies, what a deeper failure
// is looked for with. They come from the spec's own field lists and the parameters that actions declare, so a new field
// is shrunk without a word here. Places are data: they stay right as long as no list of the spec gets shorter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/generator.h"

namespace contort {

struct SpecField {
  std::string pointer;  // into the spec
  bool is_number = false;
  // If the field is a number: present value, default, and the range in which other values make sense. Whole motions of
  // 36000 frames are allowed and are no use, so frames, weights and blows reach up to twice what they are.
  double value = 0.0;
  double preset = 0.0;
  double low = 0.0;
  double high = 0.0;
  double steps_per_unit = 1.0;     // of the lattice to stay on
  std::vector<std::string> words;  // where it is a choice: all that are allowed
  bool operator==(const SpecField&) const = default;
};

// Returns the fields that are not at their defaults, in the spec's order. The generator says the limits and defaults of
// parameters. Without the character they are not known: then parameters have no limits, and 0 stands for the default.
std::vector<SpecField> spec_fields_of(const Spec& spec, Generator& generator, const Character* character);

// Back to their defaults.
void reset_spec_fields(Spec& spec, std::span<const SpecField> places);

void set_spec_field(Spec& spec, const SpecField& place, double value);
void set_spec_field(Spec& spec, const SpecField& place, const std::string& word);

}  // namespace contort
