// Parts, objects, characters and actions, as the one file of a library folder; joint maps and settings of checks.
#include <algorithm>

#include "checks/joint_map.h"
#include "tests/stage_evaluator.h"
#include "generator/actions/action.h"
#include "tests/corpus/temp_folder.h"
#include "tests/libfuzzer/go_on.h"
#include "tests/libfuzzer/targets.h"

namespace contort::hostile {

namespace {

// The part in the first slot that takes its kind, in every stock character.
bool play_part(const PartDesc& part, Library& library) {
  bool moved = false;
  for (auto& [name, character] : library.characters) {
    const auto slot = std::ranges::find(character.slots, part.kind, &SlotDesc::kind);
    if (slot == character.slots.end()) continue;
    slot->parts.push_back(part.name);
    Spec spec;
    spec.character = {name, {{slot->name, part.name}}, {}};
    moved = play_in_both_modes(spec, library) || moved;
  }
  return moved;
}

// The object on the first socket that there is.
bool play_object(const ObjectDesc& object, Library& library) {
  CharacterDesc& human = library.characters.at("human");
  human.objects.push_back(object.name);
  for (const SlotDesc& slot : human.slots)
    for (const SocketDesc& socket : library.parts.at(slot.parts.front()).sockets) {
      Spec spec;
      spec.character = {"human", {}, {{object.name, slot.name, socket.name}}};
      return play_in_both_modes(spec, library);
    }
  return false;
}

bool play_character(const CharacterDesc& character, const Library& library) {
  Spec spec;
  spec.character.name = character.name;
  return play_in_both_modes(spec, library);
}

// Plays the action in every matching slot of the stock characters.
bool play_action(const ActionDesc& action, const Library& library) {
  if (const Result<Done> fit = check_actions(library); !fit) return require_clean(fit.issue()), false;
  bool moved = false;
  for (const auto& [name, character] : library.characters)
    for (const SlotDesc& slot : character.slots) {
      const auto part = std::ranges::find_first_of(slot.parts, action.parts);
      const bool is_of_kind = std::ranges::find(action.kinds, slot.kind) != action.kinds.end();
      if (!is_of_kind && part == slot.parts.end()) continue;
      Spec spec;
      spec.character.name = name;
      if (!is_of_kind) spec.character.parts[slot.name] = *part;
      ActionUse use;
      use.action = action.name, use.slot = slot.name, use.duration_frames = 5;
      spec.sequences = {{"", 0, {{"", 0, 0, 1.0, {use}}}}};
      moved = play(spec, library) || moved;
    }
  return moved;
}

// Plays the one description that the library has more than the stock.
bool play_newest(Library& library) {
  const auto is_new = [](const auto& known) {
    return [&known](const auto& entry) { return !known.contains(entry.first); };
  };
  const Library& stock = stock_library();
  if (const auto part = std::ranges::find_if(library.parts, is_new(stock.parts)); part != library.parts.end())
    return play_part(PartDesc(part->second), library);
  if (const auto o = std::ranges::find_if(library.objects, is_new(stock.objects)); o != library.objects.end())
    return play_object(ObjectDesc(o->second), library);
  const auto character = std::ranges::find_if(library.characters, is_new(stock.characters));
  if (character != library.characters.end()) return play_character(character->second, library);
  return play_action(library.actions.front(), library);
}

bool read_map(std::string_view bytes) {
  const Result<JointMap> map = parse_joint_map(bytes);
  if (!map) require_clean(map.issue());
  return map.ok();
}

bool read_settings(std::string_view bytes) {
  const Result<CheckSettings> settings = parse_settings(bytes);
  if (!settings) return require_clean(settings.issue()), false;
  Spec spec;
  spec.hold_frames = 2;
  StageEvaluator(*settings).run(*build_stage(spec, stock_library()));
  return true;
}

}  // namespace

bool try_description(std::string_view bytes) {
  static const TempFolder folder;
  spill(folder / "file.json", std::string(bytes));
  Library library = stock_library();
  const Result<Done> loaded = load_folder(folder.path(), library);
  if (loaded.ok()) return play_newest(library);
  require_clean(loaded.issue());
  return loaded.issue().code == "library.wrong_format" && (read_map(bytes) || read_settings(bytes));
}

}  // namespace contort::hostile
