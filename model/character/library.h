// A library of all descriptions by name: the stock ones, which are compiled in, and those of a user's folders.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/asset/asset.h"
#include "model/character/action_desc.h"
#include "model/character/desc.h"
#include "model/core/result.h"

namespace contort {

struct Library {
  std::map<std::string, PartDesc> parts;
  std::map<std::string, ObjectDesc> objects;
  std::map<std::string, CharacterDesc> characters;
  std::vector<ActionDesc> actions;  // from files; actions for kinds of parts come before actions for named parts
  std::map<std::string, std::shared_ptr<const Asset>> recordings;  // animations, by file name without ending
  // The joint that follows each node of the file from which a character was imported, by the character's name.
  std::map<std::string, std::map<std::string, std::string>> joint_maps;
};

// Returns the library with `human`, `mech` and `quadruped`. It is built once and needs no files.
const Library& stock_library();

// Adds every *.json of `folder` (parts, objects, characters, actions, recognised by their "format") to `into`. A name
// that exists already is an error, so that a file never changes the meaning of a stored case. Only actions for
// different parts may share a name. check_actions (generator/actions) checks whether the parts can perform it.
Result<Done> load_folder(const std::string& folder, Library& into);

// Reads one description from JSON text. Codes "part.*", "object.*", "character.*", "action.*", "json.*".
Result<PartDesc> parse_part(std::string_view json);
Result<ObjectDesc> parse_object(std::string_view json);
Result<CharacterDesc> parse_character(std::string_view json);
Result<ActionDesc> parse_action(std::string_view json);

// Prints a description as indented text: sorted keys, defaults left out, shortest numbers that read back to the same
// bits.
std::string print_part(const PartDesc& part);
std::string print_object(const ObjectDesc& object);
std::string print_character(const CharacterDesc& character);
std::string print_action(const ActionDesc& action);

// JSON Schemas (draft 2020-12), from the same field lists as the readers.
std::string part_schema();
std::string object_schema();
std::string character_schema();
std::string action_schema();

}  // namespace contort
