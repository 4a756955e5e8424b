// Fields of a spec that have defaults. Shrinking resets and moves them, and the searches for free fields and for the
// deepest failure vary them. They come from the spec's own field lists and from the parameters that actions declare, so
// a new field is shrunk without a change here. A field stays valid as long as no list of the spec gets shorter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/generator.h"

namespace contort {

struct SpecField {
  std::string pointer;  // JSON pointer into the spec
  bool is_number = false;
  // If the field is a number: present value, default, and the range in which other values make sense. Motions of 36000
  // frames are allowed but useless, so frames, weights and blows go up to twice their present value.
  double value = 0.0;
  double preset = 0.0;
  double low = 0.0;
  double high = 0.0;
  double steps_per_unit = 1.0;     // grid on which values stay
  std::vector<std::string> words;  // for a choice: all allowed words
  bool operator==(const SpecField&) const = default;
};

// Returns the fields that are not at their defaults, in the spec's order. The generator knows the limits and defaults
// of parameters. Without the character they are unknown: parameters then have no limits, and 0 stands for the default.
std::vector<SpecField> spec_fields_of(const Spec& spec, Generator& generator, const Character* character);

// Sets the fields back to their defaults.
void reset_spec_fields(Spec& spec, std::span<const SpecField> places);

void set_spec_field(Spec& spec, const SpecField& place, double value);
void set_spec_field(Spec& spec, const SpecField& place, const std::string& word);

}  // namespace contort
