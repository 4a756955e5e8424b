#include "fuzz/compose.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <variant>

#include "fuzz/compose_dynamics.h"
#include "fuzz/compose_params.h"
#include "fuzz/compose_turns.h"
#include "fuzz/features.h"
#include "generator/actions/action.h"
#include "generator/motion/legs.h"
#include "model/character/character.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kTimeToReturn = 50;  // frames in which a figure may come back to its target

// Mostly the default, else one of a few: 0.5, 2, 0.8, 1.25.
double speed_of(int raw, const Features& features) {
  if (!features.profile().speeds || features.omits("speed")) return 1.0;
  constexpr double kSpeeds[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 2.0, 0.8, 1.25};
  return kSpeeds[pick(raw, std::size(kSpeeds))];
}

// Unless a rule of the profile says otherwise, half of the blends are at once; the others take up to 20 frames.
int blend_of(int raw, const Features& features, const DrawRule* rule) {
  if (rule != nullptr) return between(raw, static_cast<int>(rule->low[0]), static_cast<int>(rule->high[0]));
  return features.omits("blend") ? 0 : std::max(0, between(raw, -20, 20));
}

// What may be moved, and by what.
struct Stock {
  const Character& character;
  const Features& features;
  std::vector<const Part*> parts;

  std::vector<Action> actions(const Part& part) const {
    std::vector<Action> all = actions_of(character, part);
    std::erase_if(all, [&](const Action& action) { return features.profile().never(part.slot, action.name); });
    all = features.among(all, "action", features.profile().actions,
                         [](const Action& action) { return std::string_view(action.name); });
    return weighted(all, part);
  }

  // Each as often as the profile wants it.
  std::vector<Action> weighted(const std::vector<Action>& all, const Part& part) const {
    std::vector<Action> often;
    for (const Action& action : all)
      often.insert(often.end(), static_cast<std::size_t>(features.profile().weight(part.slot, action.name)), action);
    return often;
  }
};

Stock stock_of(const Character& character, const Features& features) {
  Stock all{character, features, {}};
  for (const Part& part : character.parts())
    if (!all.actions(part).empty()) all.parts.push_back(&part);
  all.parts = features.among(all.parts, "slot", features.profile().slots,
                             [](const Part* part) { return std::string_view(part->slot); });
  return all;
}

ActionUse compose_action(const RawAction& raw, const Stock& stock) {
  const Part& part = *stock.parts[pick(raw.slot, stock.parts.size())];
  const std::vector<Action> actions = stock.actions(part);
  const Action& action = actions[pick(raw.action, actions.size())];
  ActionUse use;
  use.action = action.name;
  use.slot = part.slot;
  use.start_frame = between(raw.start, 0, 40);
  const Profile& profile = stock.features.profile();
  use.duration_frames = between(raw.duration, profile.shortest_frames, profile.longest_frames);
  use.speed = speed_of(raw.speed, stock.features);
  const auto blend = [&](int raw_frames, std::string_view field) {
    return blend_of(raw_frames, stock.features, profile.rule_for(part.slot, action.name, field));
  };
  if (action.def->timing == Timing::course) use.blend_in_frames = blend(raw.blend_in, "blend_in_frames");
  if (action.def->layer != Layer::overwrite) use.blend_out_frames = blend(raw.blend_out, "blend_out_frames");
  draw_params(stock.character, part, action, profile, raw.values, use);
  return use;
}

ClipDesc compose_clip(const RawClip& raw, const Stock& stock) {
  ClipDesc clip;
  clip.start_frame = between(raw.start, 0, 30);
  clip.speed = speed_of(raw.speed, stock.features);
  const bool may_stretch = stock.features.profile().speeds && !stock.features.omits("stretch");
  if (pick(raw.stretch, 5) == 0 && may_stretch)
    clip.duration_frames = between(raw.stretch * 5 % (kLattice + 1), kShortestStretch, kLongestStretch);
  for (const RawAction& action : raw.actions) clip.actions.push_back(compose_action(action, stock));
  return clip;
}

CharacterChoice compose_character(const RawSpec& raw, const std::string& name, const Features& features,
                                  const Library& library) {
  const CharacterDesc& desc = library.characters.at(name);
  CharacterChoice choice;
  choice.name = name;
  const double odds = features.omits("swap") ? 0.0 : features.profile().swaps;
  for (std::size_t i = 0; i < desc.slots.size(); ++i) {
    const SlotDesc& slot = desc.slots[i];
    const int raw_part = raw.parts[i % kRawParts];
    const int keeps = static_cast<int>((1.0 - odds) * kLattice);
    if (slot.parts.size() < 2 || raw_part < keeps || odds == 0.0) continue;
    const std::size_t option = pick(static_cast<int>((raw_part - keeps) / odds), slot.parts.size());
    if (option > 0) choice.parts[slot.name] = slot.parts[option];
  }
  return choice;
}

// Attaches each object with the odds of the profile, at one of the sockets that it is made for.
void compose_attachments(const RawSpec& raw, const Features& features, const Library& library,
                         CharacterChoice& choice) {
  const double odds = features.profile().objects;
  const Result<Character> bare = build_character(choice, library);
  const CharacterDesc& desc = library.characters.at(choice.name);
  for (std::size_t i = 0; bare && i < desc.objects.size() && i < kRawObjects; ++i) {
    const auto object = library.objects.find(desc.objects[i]);
    if (!happens(raw.objects[i], odds) || object == library.objects.end()) continue;
    if (features.omits("object", object->first)) continue;
    std::vector<AttachmentDesc> places;
    for (const Socket& socket : bare->sockets()) {
      const std::size_t slash = socket.name.find('/');
      const std::string local = socket.name.substr(slash + 1);
      const std::vector<std::string>& docks = object->second.docks;
      if (std::find(docks.begin(), docks.end(), local) != docks.end())
        places.push_back({object->first, socket.name.substr(0, slash), local});
    }
    if (!places.empty()) choice.attachments.push_back(places[pick(raw.objects[i] * 3 % (kLattice + 1), places.size())]);
  }
}

SequenceDesc compose_sequence(const std::vector<RawClip>& raw, const Stock& stock) {
  SequenceDesc sequence;
  for (const RawClip& clip : raw)
    if (!stock.parts.empty() && !clip.actions.empty()) sequence.clips.push_back(compose_clip(clip, stock));
  if (!stock.features.profile().overlaps) take_turns(stock.character, sequence);
  return sequence;
}

// Half of the grounds are level; the others a slope, a flight of steps, or a rough field of 7 x 7 heights.
Ground compose_ground(const std::array<int, kRawGround>& raw, const Features& features) {
  constexpr std::string_view kKinds[] = {"slope", "steps", "heights", "plane", "plane", "plane"};
  const double heading_deg = 15.0 * between(raw[1], -12, 12);
  const std::vector<std::string>& allowed = features.profile().grounds;
  const std::size_t kind = pick(raw[0], std::size(kKinds));
  const bool is_allowed = allowed.empty() || std::ranges::find(allowed, kKinds[kind]) != allowed.end();
  if (!is_allowed || features.omits("ground", kKinds[kind])) return PlaneGround{};
  if (kind == 0) return SlopeGround{static_cast<double>(between(raw[2], 1, 25)), heading_deg};
  if (kind == 1)
    return StepsGround{heading_deg, between(raw[2], 4, 40) / 20.0, between(raw[3], 12, 30) / 50.0,
                       between(raw[4], 4, 22) / 100.0, between(raw[5], 1, 8)};
  if (kind != 2) return PlaneGround{};
  HeightGround field;
  field.columns = field.rows = 7;
  field.heights_m.clear();
  for (std::size_t i = 0; i < 49; ++i)  // two of the raw numbers make one height
    field.heights_m.push_back(
        contort::on_lattice(1e-2 * ((raw[2 + i % 7] / 100 + raw[9 + i / 7 % 7] / 100) % 13 - 6), 100.0));
  return field;
}

// Some specs have a wall beside or before the character.
EnvironmentDesc compose_environment(const RawSpec& raw, const Features& features) {
  EnvironmentDesc environment;
  environment.ground = compose_ground(raw.ground, features);
  if (!happens(raw.obstacle, features.profile().obstacles) || features.omits("obstacle")) return environment;
  const double distance_m = contort::on_lattice(0.01 * between(raw.obstacle * 3 % (kLattice + 1), 30, 150), 100.0);
  Box wall;
  wall.center_m = Vec3(raw.obstacle % 2 == 0 ? distance_m : -distance_m, 1.0, 1.0);
  wall.half_m = Vec3(0.1, 1.0, 2.0);
  environment.obstacles = {{"wall", wall}};
  return environment;
}

// One of the sequences of the queue, which then has a name.
SequenceDesc& named_sequence(Spec& spec, int raw) {
  const std::size_t index = pick(raw, spec.sequences.size());
  SequenceDesc& sequence = spec.sequences[index];
  sequence.name = "sequence " + std::to_string(index + 1);
  return sequence;
}

// Where the queue plays this action, each slot once.
std::vector<std::string> slots_playing(std::string_view action, const Spec& spec) {
  std::vector<std::string> slots;
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions)
        if (use.action == action && std::ranges::find(slots, use.slot) == slots.end()) slots.push_back(use.slot);
  return slots;
}

bool plays(std::string_view action, const Spec& spec) { return !slots_playing(action, spec).empty(); }

// Slots whose parts can tell of an event: feet and what aims.
std::vector<std::string> slots_that_tell(Event event, const Character& character, const Spec& spec) {
  if (event == Event::aim_reached) return slots_playing("aim", spec);
  std::vector<std::string> slots;
  if (event == Event::contact && (plays("walk", spec) || plays("run", spec)))
    for (const Leg& leg : find_legs(character))
      slots.push_back(character.parts()[static_cast<std::size_t>(leg.foot_part)].slot);
  return slots;
}

bool waits_for_slot(Event event) { return event == Event::contact || event == Event::aim_reached; }

// As far as can be told before it is played: what nothing brings about, no interrupt should wait for.
bool can_happen(Event event, std::span<const std::string> slots, const Spec& spec) {
  if (waits_for_slot(event)) return !slots.empty();
  if (event == Event::impact) return plays("hit_reaction", spec);
  if (event == Event::near_obstacle) return !spec.environment.obstacles.empty();
  return event != Event::ground_steeper || !std::holds_alternative<PlaneGround>(spec.environment.ground);
}

ConditionDesc compose_condition(const RawInterrupt& raw, const Character& character, Spec& spec) {
  ConditionDesc when;
  constexpr Event kEvents[] = {Event::frame,   Event::frame,          Event::clip_ended,
                               Event::impact,  Event::sequence_ended, Event::ground_steeper,
                               Event::contact, Event::aim_reached,    Event::near_obstacle};
  when.event = kEvents[pick(raw.event, std::size(kEvents))];
  const std::vector<std::string> slots = slots_that_tell(when.event, character, spec);
  if (!can_happen(when.event, slots, spec)) when.event = Event::frame;
  if (when.event == Event::frame) when.frame = between(raw.what, 0, 150);
  if (when.event == Event::near_obstacle) when.distance_m = contort::on_lattice(0.1 * between(raw.what, 2, 20), 10.0);
  if (waits_for_slot(when.event)) when.slot = slots[pick(raw.what, slots.size())];
  if (when.event == Event::sequence_ended) when.name = named_sequence(spec, raw.what).name;
  if (when.event == Event::clip_ended) {
    SequenceDesc& sequence = named_sequence(spec, raw.what);
    const std::size_t index = pick(raw.after, sequence.clips.size());
    when.name = sequence.clips[index].name = sequence.name + ", clip " + std::to_string(index + 1);
  }
  return when;
}

InterruptDesc compose_interrupt(const RawInterrupt& raw, const Stock& stock, Spec& spec) {
  InterruptDesc interrupt;
  interrupt.when = compose_condition(raw, stock.character, spec);
  interrupt.enter = static_cast<Enter>(pick(raw.enter, 4));
  if (interrupt.enter == Enter::after_sequence) interrupt.after = named_sequence(spec, raw.after).name;
  interrupt.resume = pick(raw.resume, 3) > 0;
  interrupt.sequence = compose_sequence(raw.clips, stock);
  return interrupt;
}

}  // namespace

bool is_level(const std::array<int, kRawGround>& ground, const Profile& profile) {
  return std::holds_alternative<PlaneGround>(compose_ground(ground, Features(profile, 0)));
}

Spec compose(const RawSpec& raw, const DrawConfig& config, const Library& library) {
  const Features features(config.profile, raw.omitted);
  const std::string& name = config.characters[pick(raw.character, config.characters.size())];
  Spec spec;
  spec.character = compose_character(raw, name, features, library);
  compose_attachments(raw, features, library, spec.character);
  spec.environment = compose_environment(raw, features);
  spec.hold_frames = between(raw.hold, 0, 10);
  const Result<Character> character = build_character(spec.character, library);
  if (!character) return spec;  // the caller's build says why
  const Stock stock = stock_of(*character, features);
  for (const std::vector<RawClip>& clips : raw.sequences)
    if (SequenceDesc sequence = compose_sequence(clips, stock); !sequence.clips.empty())
      spec.sequences.push_back(std::move(sequence));
  const bool interrupted = happens(raw.interrupted, features.profile().interrupts) && !features.omits("interrupt");
  if (interrupted && !spec.sequences.empty())
    for (const RawInterrupt& interrupt : raw.interrupts)
      spec.interrupts.push_back(compose_interrupt(interrupt, stock, spec));
  spec.dynamics = compose_dynamics(raw.dynamics, features, *character);
  if (spec.dynamics.mode != Mode::kinematic) spec.hold_frames += kTimeToReturn;
  return spec;
}

}  // namespace contort
