#include "generator/built_in.h"

#include <algorithm>

#include "generator/actions/action.h"
#include "generator/execute.h"

namespace contort {

namespace {

constexpr std::size_t kMostCharacters = 256;  // whose offers are remembered

std::vector<EventSource> sources_of(const ActionDef& def, const Character& character, int part) {
  if (def.tells == Tells::aim_reached) return {{Event::aim_reached, part}};
  if (def.tells == Tells::impact) return {{Event::impact, part}};
  if (def.tells == Tells::contact && def.spread != Spread::legs) return {{Event::contact, part}};
  std::vector<EventSource> feet;
  if (def.tells == Tells::contact)
    for (const Leg& leg : find_legs(character)) feet.push_back({Event::contact, leg.foot_part});
  return feet;
}

int file_of(const ActionDesc* desc, const Library& library) {
  if (desc == nullptr) return -1;
  return static_cast<int>(std::ranges::find(library.actions, *desc) - library.actions.begin());
}

OfferedAction offered(const Action& action, const Character& character, int part, const Library& library) {
  const ActionDef& def = *action.def;
  return {std::string(action.name),
          std::string(action.help),
          def.layer,
          def.timing,
          def.promise,
          params_of(action, character, character.parts()[static_cast<std::size_t>(part)]),
          parts_moved(def, character, part),
          sources_of(def, character, part),
          file_of(action.desc, library)};
}

Offers offers_of(const Character& character, const Library& library) {
  Offers offers(character.parts().size());
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const Action& action : actions_of(character, character.parts()[p]))
      offers[p].push_back(offered(action, character, static_cast<int>(p), library));
  return offers;
}

}  // namespace

BuiltInGenerator::BuiltInGenerator(const Library& library) {
  manifest_.name = "contort";
  manifest_.library = &library;
  for (const ActionDef& action : all_actions()) manifest_.actions.emplace_back(action.name);
  for (const ActionDesc& action : library.actions)
    if (std::ranges::find(manifest_.actions, action.name) == manifest_.actions.end())
      manifest_.actions.push_back(action.name);
}

const Offers& BuiltInGenerator::offers(const Character& character) {
  const auto known = offers_.find(character.hash());
  if (known != offers_.end()) return known->second;
  if (offers_.size() >= kMostCharacters) offers_.clear();
  return offers_.emplace(character.hash(), offers_of(character, *manifest_.library)).first->second;
}

// Most specs have the character of the one before: it need not be assembled again for them.
Result<Done> BuiltInGenerator::build(const Spec& spec) {
  if (stage_.ok() && spec == spec_) return Done{};
  const bool same_figure = stage_.ok() && spec.character == spec_.character;
  stage_ = same_figure ? build_stage(spec, stage_->character, *manifest_.library)
                       : build_stage(spec, *manifest_.library);
  if (!stage_) return stage_.issue();
  spec_ = spec;
  return Done{};
}

Result<Admission> BuiltInGenerator::admit(const Spec& spec) {
  if (const Result<Done> built = build(spec); !built) return built.issue();
  return Admission{stage_->most_frames};
}

Result<Done> BuiltInGenerator::run(const Spec& spec, Execution& execution) {
  if (const Result<Done> built = build(spec); !built) return built.issue();
  execute(*stage_, scratch_, execution);
  return Done{};
}

std::unique_ptr<Generator> BuiltInGenerator::another() const {
  return std::make_unique<BuiltInGenerator>(*manifest_.library);
}

Result<std::unique_ptr<Generator>> BuiltInGenerator::with(const Library& library) const {
  if (const Result<Done> fit = check_actions(library); !fit) return fit.issue();
  return Result<std::unique_ptr<Generator>>(std::make_unique<BuiltInGenerator>(library));
}

}  // namespace contort
