#include "fuzz/explain.h"

#include <algorithm>
#include <cmath>

#include "fuzz/spec_field.h"
#include "fuzz/shrink_state.h"
#include "model/core/math.h"

namespace contort {

namespace {

constexpr int kQuarters = 4;

// Tries the default first: most fields of a minimal spec matter, and one motion without failure shows it. Then it tries
// the middle between value and default, and the ends and quarters of the range.
std::vector<double> other_numbers(const SpecField& place) {
  if (!std::isfinite(place.low) || !std::isfinite(place.high) || place.low == place.high) return {};
  std::vector<double> values = {place.preset, 0.5 * (place.value + place.preset)};
  for (int i = 0; i <= kQuarters; ++i) values.push_back(place.low + (place.high - place.low) * i / kQuarters);
  std::vector<double> others;
  for (const double value : values) {
    const double near = std::clamp(on_lattice(value, place.steps_per_unit), place.low, place.high);
    if (near != place.value && std::ranges::find(others, near) == others.end()) others.push_back(near);
  }
  return others;
}

std::vector<Spec> with_others(const Spec& spec, const SpecField& place) {
  std::vector<Spec> candidates;
  const auto add = [&](const auto& value) {
    candidates.push_back(spec);
    set_spec_field(candidates.back(), place, value);
  };
  if (place.is_number)
    for (const double value : other_numbers(place)) add(value);
  for (const std::string& word : place.words) add(word);
  std::erase(candidates, spec);
  return candidates;
}

std::vector<Spec> with_other_parts(const Spec& spec, const std::string& slot, const CharacterDesc& character) {
  std::vector<Spec> candidates;
  for (const SlotDesc& desc : character.slots)
    for (const std::string& part : desc.parts) {
      if (desc.name != slot || part == spec.character.parts.at(slot)) continue;
      candidates.push_back(spec);
      candidates.back().character.parts[slot] = part;
    }
  return candidates;
}

bool all_fail(ShrinkState& state, const std::vector<Spec>& candidates) {
  return !candidates.empty() && std::ranges::all_of(candidates, [&](const Spec& c) { return state.fails(c); });
}

}  // namespace

std::vector<std::string> free_fields_of(ShrinkState& state) {
  std::vector<std::string> pointers;
  const Spec& spec = state.spec();
  const auto& characters = state.library().characters;
  const auto character = characters.find(spec.character.name);
  for (const auto& [slot, part] : spec.character.parts)
    if (character != characters.end() && all_fail(state, with_other_parts(spec, slot, character->second)))
      pointers.push_back("/character/parts/" + slot);
  for (const SpecField& place : state.spec_fields(spec))
    if (all_fail(state, with_others(spec, place))) pointers.push_back(place.pointer);
  return pointers;
}

}  // namespace contort
