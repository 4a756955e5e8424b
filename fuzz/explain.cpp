#include "fuzz/explain.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "fuzz/places.h"
#include "fuzz/shrink_state.h"
#include "generator/core/math.h"

namespace contort {

namespace {

constexpr std::size_t kOtherValues = 3;

// The ends of the range and the middle of the larger side, those that are not the present value.
std::vector<double> other_numbers(const SpecPlace& place) {
  if (!std::isfinite(place.low) || !std::isfinite(place.high)) return {};
  const double far = place.high - place.value > place.value - place.low ? place.high : place.low;
  std::set<double> values = {place.low, place.high};
  values.insert(on_lattice(0.5 * (place.value + far), place.steps_per_unit));
  values.erase(place.value);
  return {values.begin(), values.end()};
}

std::vector<Spec> with_others(const Spec& spec, const SpecPlace& place) {
  std::vector<Spec> candidates;
  const auto add = [&](const auto& value) {
    candidates.push_back(spec);
    set_place(candidates.back(), place, value);
  };
  if (place.is_number)
    for (const double value : other_numbers(place)) add(value);
  for (const std::string& word : place.words)
    if (candidates.size() < kOtherValues) add(word);
  std::erase(candidates, spec);
  return candidates;
}

std::vector<Spec> with_other_parts(const Spec& spec, const std::string& slot, const CharacterDesc& character) {
  std::vector<Spec> candidates;
  for (const SlotDesc& desc : character.slots)
    for (const std::string& part : desc.parts) {
      if (desc.name != slot || part == spec.character.parts.at(slot) || candidates.size() == kOtherValues) continue;
      candidates.push_back(spec);
      candidates.back().character.parts[slot] = part;
    }
  return candidates;
}

bool all_fail(ShrinkState& state, const std::vector<Spec>& candidates) {
  return !candidates.empty() && std::all_of(candidates.begin(), candidates.end(),
                                            [&](const Spec& candidate) { return state.fails(candidate); });
}

}  // namespace

std::vector<std::string> free_fields_of(ShrinkState& state, const Library& library) {
  std::vector<std::string> pointers;
  const Spec& spec = state.spec();
  const auto character = library.characters.find(spec.character.name);
  for (const auto& [slot, part] : spec.character.parts)
    if (character != library.characters.end() && all_fail(state, with_other_parts(spec, slot, character->second)))
      pointers.push_back("/character/parts/" + slot);
  for (const SpecPlace& place : places_of(spec, state.shown().character.get()))
    if (all_fail(state, with_others(spec, place))) pointers.push_back(place.pointer);
  return pointers;
}

}  // namespace contort
