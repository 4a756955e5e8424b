// Stock characters for tests: shared so that each is built once.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "model/character/character.h"
#include "model/core/math.h"

namespace contort::fixtures {

inline Character built(const CharacterChoice& choice, const Library& library = stock_library()) {
  Result<Character> character = build_character(choice, library);
  if (!character) ADD_FAILURE() << to_line(character.issue());
  return character ? std::move(character).value() : Character();
}

// The stock library with very fast joints, for laws of timing that hold only if no joint is at its speed limit.
inline const Library& tireless_library() {
  static const Library library = [] {
    Library made = stock_library();
    for (auto& [name, part] : made.parts)
      for (JointDesc& joint : part.joints)
        if (joint.type == JointType::prismatic)
          joint.max_speed_m_s = 1e3;
        else
          joint.max_speed_deg_s = 1e5;
    return made;
  }();
  return library;
}

inline const Character& human() {
  static const Character character = built({});
  return character;
}

inline CharacterChoice mech_choice(std::map<std::string, std::string> parts = {}) {
  CharacterChoice choice;
  choice.name = "mech";
  choice.parts = std::move(parts);
  return choice;
}

inline const Joint& joint(const Character& character, std::string_view name) {
  const int index = character.find_joint(name);
  EXPECT_GE(index, 0) << name;
  return character.joints()[static_cast<std::size_t>(index < 0 ? 0 : index)];
}

// Every combination of parts that the character's slots allow, as choices.
inline std::vector<CharacterChoice> all_combinations(const CharacterDesc& desc) {
  CharacterChoice plain;
  plain.name = desc.name;
  std::vector<CharacterChoice> choices = {plain};
  for (const SlotDesc& slot : desc.slots) {
    std::vector<CharacterChoice> longer;
    for (const CharacterChoice& choice : choices)
      for (const std::string& part : slot.parts) {
        longer.push_back(choice);
        longer.back().parts[slot.name] = part;
      }
    choices = std::move(longer);
  }
  return choices;
}

}  // namespace contort::fixtures
