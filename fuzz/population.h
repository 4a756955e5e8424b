// Requests like a minimal case: the same actions in the same arrangement, with other values.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "corpus/case.h"
#include "corpus/request.h"
#include "fuzz/dice.h"
#include "fuzz/spec_field.h"
#include "model/generator.h"

namespace contort {

struct DrawnRequest {
  Spec spec;
  SpecRequest request;
};

class Population {
 public:
  // Codes of build_character and Generator::admit if the case does not build any more.
  static Result<Population> like(const Case& minimal, Generator& generator);

  // Returns draw `index`; empty if the generator refuses it. Equal indices give equal requests.
  std::optional<DrawnRequest> draw(Generator& generator, std::int64_t index) const;

 private:
  // The character, unchanged or with another part in one slot, and the actions of its parts.
  struct Variant {
    CharacterChoice choice;
    Character character;
    Offers offers;
  };

  Population() = default;
  Result<Done> add_variant(const CharacterChoice& choice, Generator& generator);
  void add_swaps(Generator& generator);
  void vary_sequence(const Variant& variant, Dice& dice, bool keeps_half, SequenceDesc& sequence) const;
  void vary_use(const Variant& variant, Dice& dice, bool keeps_half, ActionUse& use) const;
  static std::vector<int> parts_for(const Variant& variant, const ActionUse& use);
  static ActionUse drawn_use(const Variant& variant, const OfferedAction& offer, int part, Dice& dice,
                             const ActionUse& like);
  void vary_setting(const Variant& variant, Dice& dice, bool keeps_half, Spec& spec) const;

  Spec base_;
  std::vector<std::string> needs_;
  std::vector<Variant> variants_;  // the case's own character comes first
  std::vector<SpecField> setting_;  // numbers of the setting that are not at their defaults
};

}  // namespace contort
