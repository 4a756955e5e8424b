#include "cli/variants.h"

#include <algorithm>

namespace contort::cli {

namespace {

std::vector<AttachmentDesc> docks_of(const Character& character, const ObjectDesc& object) {
  std::vector<AttachmentDesc> docks;
  for (const Socket& socket : character.sockets()) {
    const std::size_t slash = socket.name.find('/');
    const std::string local = socket.name.substr(slash + 1);
    if (std::find(object.docks.begin(), object.docks.end(), local) != object.docks.end())
      docks.push_back({object.name, socket.name.substr(0, slash), local});
  }
  return docks;
}

}  // namespace

void for_variants(const Library& library, const std::function<void(const Character&)>& visit) {
  const auto visit_choice = [&](const CharacterChoice& choice) {
    if (const Result<Character> character = build_character(choice, library); character) visit(*character);
  };
  for (const auto& [name, desc] : library.characters) {
    const Result<Character> plain = build_character({name, {}, {}}, library);
    if (!plain) continue;
    visit(*plain);
    for (const SlotDesc& slot : desc.slots)
      for (std::size_t i = 1; i < slot.parts.size(); ++i) visit_choice({name, {{slot.name, slot.parts[i]}}, {}});
    for (const std::string& object : desc.objects)
      if (const auto found = library.objects.find(object); found != library.objects.end())
        for (const AttachmentDesc& dock : docks_of(*plain, found->second)) visit_choice({name, {}, {dock}});
  }
}

}  // namespace contort::cli
