#include "fuzz/population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "fuzz/compose_params.h"
#include "fuzz/profile.h"
#include "model/character/library.h"
#include "model/core/index.h"

namespace contort {

namespace {

constexpr std::uint64_t kPopulationStream = 0x706f70756cULL;
constexpr int kShortestDrawn = 4, kOctaves = 5;  // lengths from 4 to 127 frames
constexpr int kLongestFade = 30;
constexpr std::array kSpeeds = {0.5, 0.75, 1.5, 2.0};

// The minimal spec, reduced to its culprit if one action fails alone.
Spec base_of(const Case& minimal, const Cause& cause) {
  Spec spec = minimal.spec;
  if (cause.scope != CauseScope::alone) return spec;
  for (const LoneAction& one : lone_actions_of(spec))
    if (one.action == cause.names.front()) {
      spec.sequences = {one.sequence};
      spec.interrupts.clear();
      break;
    }
  spec.only_sequence = spec.only_clip = 0;
  return spec;
}

bool takes_the_same(const OfferedAction& a, const OfferedAction& b) {
  return std::ranges::equal(a.params, b.params, [](const ParamDef& one, const ParamDef& other) {
    return one.name == other.name && one.type == other.type && one.choices == other.choices &&
           one.points == other.points;
  });
}

// Short lengths are as frequent as long ones, by octaves.
int drawn_length(Dice& dice) {
  const int shortest = kShortestDrawn << dice.below(kOctaves);
  return shortest + dice.below(shortest);
}

double drawn_speed(Dice& dice) {
  return dice.one_in(4) ? kSpeeds[static_cast<std::size_t>(dice.below(kSpeeds.size()))] : 1.0;
}

std::set<std::string> slots_used(const Spec& spec) {
  std::set<std::string> slots;
  for (const LoneAction& one : lone_actions_of(spec)) slots.insert(one.sequence.clips.front().actions.front().slot);
  return slots;
}

bool is_of_setting(const SpecField& field) {
  const bool is_there = field.pointer.starts_with("/dynamics/") || field.pointer.starts_with("/environment/") ||
                        field.pointer.starts_with("/start/");
  return is_there && field.is_number && field.low < field.high;
}

}  // namespace

Result<Population> Population::like(const Case& minimal, Generator& generator) {
  Population made;
  const Cause cause = cause_of(minimal);
  made.needs_ = needs_of(cause);
  made.base_ = base_of(minimal, cause);
  if (const Result<Admission> admitted = generator.admit(made.base_); !admitted) return admitted.issue();
  if (const Result<Done> added = made.add_variant(made.base_.character, generator); !added) return added.issue();
  made.setting_ = spec_fields_of(made.base_, generator, &made.variants_.front().character);
  std::erase_if(made.setting_, [](const SpecField& field) { return !is_of_setting(field); });
  if (cause.scope != CauseScope::setting) made.add_swaps(generator);
  return made;
}

Result<Done> Population::add_variant(const CharacterChoice& choice, Generator& generator) {
  Result<Character> character = build_character(choice, *generator.manifest().library);
  if (!character) return character.issue();
  Offers offers = generator.offers(*character);
  variants_.push_back({choice, std::move(character).value(), std::move(offers)});
  return Done{};
}

// Adds other parts for the slots that the actions use. Parts with which the character does not build are left out.
void Population::add_swaps(Generator& generator) {
  const Library& library = *generator.manifest().library;
  const auto desc = library.characters.find(base_.character.name);
  if (desc == library.characters.end()) return;
  for (const std::string& used : slots_used(base_))
    for (const SlotDesc& slot : desc->second.slots)
      for (const std::string& part : slot.parts) {
        CharacterChoice choice = base_.character;
        choice.parts[slot.name] = part;
        if (slot.name == used && choice != base_.character) (void)add_variant(choice, generator);
      }
}

std::optional<DrawnRequest> Population::draw(Generator& generator, std::int64_t index) const {
  Dice dice(0, index, kPopulationStream);
  const bool keeps_half = dice.one_in(2);
  const auto others = static_cast<int>(variants_.size()) - 1;
  const bool is_swapped = others > 0 && dice.one_in(3);
  const Variant& variant = variants_[is_swapped ? 1 + static_cast<std::size_t>(dice.below(others)) : 0];
  DrawnRequest drawn{base_, {}};
  drawn.spec.character = variant.choice;
  for (SequenceDesc& sequence : drawn.spec.sequences) vary_sequence(variant, dice, keeps_half, sequence);
  for (InterruptDesc& interrupt : drawn.spec.interrupts) vary_sequence(variant, dice, keeps_half, interrupt.sequence);
  vary_setting(variant, dice, keeps_half, drawn.spec);
  if (!generator.admit(drawn.spec)) return std::nullopt;
  std::vector<SpecRequest> requests = requests_of(drawn.spec, needs_, variant.character, variant.offers);
  if (requests.empty()) return std::nullopt;
  drawn.request = std::move(requests.front());
  return drawn;
}

void Population::vary_sequence(const Variant& variant, Dice& dice, bool keeps_half, SequenceDesc& sequence) const {
  const auto keeps = [&] { return keeps_half && dice.one_in(2); };
  if (!keeps()) sequence.duration_frames = 0;
  bool is_first = true;
  for (ClipDesc& clip : sequence.clips) {
    if (!keeps()) clip.duration_frames = 0, clip.speed = drawn_speed(dice);
    for (ActionUse& use : clip.actions) {
      vary_use(variant, dice, keeps_half, use);
      if (!is_first && !keeps()) use.start_frame = dice.below(2 * kShortestDrawn << dice.below(kOctaves));
      is_first = false;
    }
  }
}

void Population::vary_use(const Variant& variant, Dice& dice, bool keeps_half, ActionUse& use) const {
  const auto keeps = [&] { return keeps_half && dice.one_in(2); };
  const std::vector<int> parts = parts_for(variant, use);
  if (parts.empty()) return;  // the generator will refuse the request
  const Character& character = variant.character;
  if (!keeps()) use.slot = character.parts()[at(parts[at(dice.below(static_cast<int>(parts.size())))])].slot;
  const int part = character.find_part(use.slot);
  const OfferedAction& offer = *find_offer(variant.offers, part, use.action);
  const ActionUse fresh = drawn_use(variant, offer, part, dice, use);
  for (const ParamDef& def : offer.params) {
    if (keeps()) continue;
    use.params.erase(def.name);
    if (const auto drawn = fresh.params.find(def.name); drawn != fresh.params.end()) use.params.insert(*drawn);
  }
  if (!keeps()) use.duration_frames = fresh.duration_frames;
  if (!keeps()) use.speed = fresh.speed;
  if (!keeps()) use.blend_in_frames = fresh.blend_in_frames;
  if (!keeps()) use.blend_out_frames = fresh.blend_out_frames;
}

// The parts that have the same action, with the same parameters.
std::vector<int> Population::parts_for(const Variant& variant, const ActionUse& use) {
  std::vector<int> parts;
  const OfferedAction* own = find_offer(variant.offers, variant.character.find_part(use.slot), use.action);
  if (own == nullptr) return parts;
  for (int part = 0; part < std::ssize(variant.character.parts()); ++part)
    if (const OfferedAction* offer = find_offer(variant.offers, part, use.action))
      if (takes_the_same(*own, *offer)) parts.push_back(part);
  return parts;
}

ActionUse Population::drawn_use(const Variant& variant, const OfferedAction& offer, int part, Dice& dice,
                                const ActionUse& like) {
  ActionUse use = like;
  use.params.clear();
  std::array<int, kRawValues> raw{};
  for (int& value : raw) value = dice.raw();
  draw_params(variant.character, variant.character.parts()[at(part)], offer, Profile{}, raw, use);
  take_corners(offer, dice, use);
  use.duration_frames = drawn_length(dice);
  use.speed = drawn_speed(dice);
  const int in = dice.one_in(2) ? -1 : dice.below(kLongestFade + 1);
  const int out = dice.one_in(2) ? 0 : dice.below(kLongestFade + 1);
  if (offer.timing == Timing::course) use.blend_in_frames = in;
  if (offer.layer != Layer::overwrite) use.blend_out_frames = out;
  return use;
}

void Population::vary_setting(const Variant& variant, Dice& dice, bool keeps_half, Spec& spec) const {
  const auto keeps = [&] { return keeps_half && dice.one_in(2); };
  for (const SpecField& field : setting_) {
    if (keeps()) continue;
    const double value = field.low + (field.high - field.low) * fraction(dice.raw());
    set_spec_field(spec, field, std::round(value * field.steps_per_unit) / field.steps_per_unit);
  }
  const std::span<const Part> parts = variant.character.parts();
  for (ImpactDesc& impact : spec.dynamics.impacts)
    if (!keeps() && dice.one_in(2)) {
      impact.slot = parts[at(dice.below(static_cast<int>(parts.size())))].slot;
      impact.joint.clear();
      impact.point_m = Vec3(0.0);
    }
}

}  // namespace contort
