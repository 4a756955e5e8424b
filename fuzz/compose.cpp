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
#include "fuzz/figure_extent.h"
#include "fuzz/sensible_pose.h"
#include "model/character/character.h"
#include "model/core/detmath.h"
#include "model/motion/kinematics.h"

namespace contort {

namespace {

constexpr int kTimeToReturn = 50;  // frames in which a simulated figure may return to its target

// The default in six cases of ten, otherwise 0.5, 2, 0.8 or 1.25.
double speed_of(int raw, const Features& features) {
  if (!features.profile().speeds || features.omits("speed")) return 1.0;
  constexpr double kSpeeds[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 2.0, 0.8, 1.25};
  return kSpeeds[pick(raw, std::size(kSpeeds))];
}

// A rule of the profile sets the range. Without a rule, half of the blends keep the default and the others take up to
// 20 frames. A cut is a jump on purpose, so it is drawn only by a rule.
int blend_of(int raw, int preset, const Features& features, const DrawRule* rule) {
  if (rule != nullptr) return between(raw, static_cast<int>(rule->low[0]), static_cast<int>(rule->high[0]));
  const int frames = features.omits("blend") ? 0 : between(raw, -20, 20);
  return frames > 0 ? frames : preset;
}

// The parts that may be moved, and the actions that may move them.
struct Stock {
  using Actions = std::vector<const OfferedAction*>;
  const Character& character;
  const Offers& offers;
  const Features& features;
  PosedFigure& posed;
  std::vector<const Part*> parts;

  Actions actions(const Part& part) const {
    Actions all;
    const auto index = static_cast<std::size_t>(&part - character.parts().data());
    const bool stands = !features.profile().wild_poses && carries_sole(character, static_cast<int>(index));
    for (const OfferedAction& action : offers[index])
      if (!features.profile().never(part.slot, action.name) && !(stands && is_pose(action))) all.push_back(&action);
    all = features.among(all, "action", features.profile().actions,
                         [](const OfferedAction* action) { return std::string_view(action->name); });
    return weighted(all, part);
  }

  // Repeats each action as often as the profile's weight.
  Actions weighted(const Actions& all, const Part& part) const {
    Actions often;
    for (const OfferedAction* action : all)
      often.insert(often.end(), static_cast<std::size_t>(features.profile().weight(part.slot, action->name)), action);
    return often;
  }
};

Stock stock_of(const Character& character, const Offers& offers, const Features& features, PosedFigure& posed) {
  Stock all{character, offers, features, posed, {}};
  for (const Part& part : character.parts())
    if (!all.actions(part).empty()) all.parts.push_back(&part);
  all.parts = features.among(all.parts, "slot", features.profile().slots,
                             [](const Part* part) { return std::string_view(part->slot); });
  return all;
}

ActionUse compose_action(const RawAction& raw, const Stock& stock) {
  const Part& part = *stock.parts[pick(raw.slot, stock.parts.size())];
  const Stock::Actions actions = stock.actions(part);
  const OfferedAction& action = *actions[pick(raw.action, actions.size())];
  ActionUse use;
  use.action = action.name;
  use.slot = part.slot;
  use.start_frame = between(raw.start, 0, 40);
  const Profile& profile = stock.features.profile();
  const FrameRange duration = action.duration.value_or(FrameRange{profile.shortest_frames, profile.longest_frames});
  use.duration_frames = between(raw.duration, duration.least, duration.most);
  use.speed = speed_of(raw.speed, stock.features);
  const auto draw_blend = [&](int raw_frames, std::string_view field, int& frames) {
    frames = blend_of(raw_frames, frames, stock.features, profile.rule_for(part.slot, action.name, field));
  };
  if (action.blend_in)
    use.blend_in_frames = between(raw.blend_in, action.blend_in->least, action.blend_in->most);
  else if (action.timing == Timing::course)
    draw_blend(raw.blend_in, "blend_in_frames", use.blend_in_frames);
  if (action.blend_out)
    use.blend_out_frames = between(raw.blend_out, action.blend_out->least, action.blend_out->most);
  else if (action.layer != Layer::overwrite)
    draw_blend(raw.blend_out, "blend_out_frames", use.blend_out_frames);
  draw_params(stock.character, part, action, profile, raw.values, use);
  if (is_sensible_in(profile, part, action)) stock.posed.add_sensible(part, action.params, use);
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
  if (!stock.features.profile().overlaps) take_turns(stock.character, stock.offers, sequence);
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

// Adds a wall beside the character, 2 to 120 cm from it.
void add_wall(int raw, const Character& character, EnvironmentDesc& environment) {
  const double side = raw % 2 == 0 ? 1.0 : -1.0;
  const double distance_m = extent_m(character, side) + 0.1 + 0.01 * between(raw * 3 % (kLattice + 1), 2, 120);
  Box wall;
  wall.center_m = Vec3(side * contort::on_lattice(distance_m, 100.0), 1.0, 1.0);
  wall.half_m = Vec3(0.1, 1.0, 2.0);
  environment.obstacles = {{"wall", wall}};
}

EnvironmentDesc compose_environment(const RawSpec& raw, const Features& features, const Capabilities& can,
                                    const Character& character) {
  EnvironmentDesc environment;
  if (can.grounds) environment.ground = compose_ground(raw.ground, features);
  if (can.obstacles && happens(raw.obstacle, features.profile().obstacles) && !features.omits("obstacle"))
    add_wall(raw.obstacle, character, environment);
  return environment;
}

// Chooses one of the sequences of the queue and gives it a name.
SequenceDesc& named_sequence(Spec& spec, int raw) {
  const std::size_t index = pick(raw, spec.sequences.size());
  SequenceDesc& sequence = spec.sequences[index];
  sequence.name = "sequence " + std::to_string(index + 1);
  return sequence;
}

// Slots whose parts can cause an event while the queue plays, each once.
std::vector<std::string> slots_that_tell(Event event, const Stock& stock, const Spec& spec) {
  std::vector<std::string> slots;
  const auto add = [&](int part) {
    const std::string& slot = stock.character.parts()[static_cast<std::size_t>(part)].slot;
    if (std::ranges::find(slots, slot) == slots.end()) slots.push_back(slot);
  };
  for (const SequenceDesc& sequence : spec.sequences)
    for (const ClipDesc& clip : sequence.clips)
      for (const ActionUse& use : clip.actions)
        for (const EventSource& source :
             find_offer(stock.offers, stock.character.find_part(use.slot), use.action)->tells)
          if (source.event == event) add(source.part);
  return slots;
}

bool waits_for_slot(Event event) { return event == Event::contact || event == Event::aim_reached; }

// Returns false if the spec cannot cause the event, as far as is known before playing: no interrupt should wait for it.
bool can_happen(Event event, std::span<const std::string> slots, const Spec& spec) {
  if (waits_for_slot(event) || event == Event::impact) return !slots.empty();
  if (event == Event::near_obstacle) return !spec.environment.obstacles.empty();
  return event != Event::ground_steeper || !std::holds_alternative<PlaneGround>(spec.environment.ground);
}

ConditionDesc compose_condition(const RawInterrupt& raw, const Stock& stock, Spec& spec) {
  ConditionDesc when;
  constexpr Event kEvents[] = {Event::frame,   Event::frame,          Event::clip_ended,
                               Event::impact,  Event::sequence_ended, Event::ground_steeper,
                               Event::contact, Event::aim_reached,    Event::near_obstacle};
  when.event = kEvents[pick(raw.event, std::size(kEvents))];
  const std::vector<std::string> slots = slots_that_tell(when.event, stock, spec);
  if (!can_happen(when.event, slots, spec)) when.event = Event::frame;
  if (when.event == Event::frame) when.frame = between(raw.what, 0, 150);
  if (when.event == Event::near_obstacle) when.distance_m = contort::on_lattice(0.1 * between(raw.what, 6, 20), 10.0);
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
  interrupt.when = compose_condition(raw, stock, spec);
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

Spec compose(const RawSpec& raw, const DrawConfig& config, Generator& generator) {
  const Manifest& manifest = generator.manifest();
  Profile without_speeds;
  const bool leaves_out_speeds = config.profile.speeds && !manifest.can.speeds;
  if (leaves_out_speeds) without_speeds = config.profile, without_speeds.speeds = false;
  const Features features(leaves_out_speeds ? without_speeds : config.profile, raw.omitted);
  const std::string& name = config.characters[pick(raw.character, config.characters.size())];
  Spec spec;
  spec.character = compose_character(raw, name, features, *manifest.library);
  compose_attachments(raw, features, *manifest.library, spec.character);
  spec.rate_hz = manifest.rate_hz;
  spec.hold_frames = between(raw.hold, 0, 10);
  const Result<Character> character = build_character(spec.character, *manifest.library);
  if (!character) return spec;  // the caller's build gives the reason
  spec.environment = compose_environment(raw, features, manifest.can, *character);
  const Environment beside = beside_rest(spec.environment);
  PosedFigure posed(*character, beside);
  const Stock stock = stock_of(*character, generator.offers(*character), features, posed);
  for (const std::vector<RawClip>& clips : raw.sequences)
    if (SequenceDesc sequence = compose_sequence(clips, stock); !sequence.clips.empty())
      spec.sequences.push_back(std::move(sequence));
  const bool interrupted = happens(raw.interrupted, features.profile().interrupts) && !features.omits("interrupt");
  if (interrupted && manifest.can.interrupts && !spec.sequences.empty())
    for (const RawInterrupt& interrupt : raw.interrupts)
      spec.interrupts.push_back(compose_interrupt(interrupt, stock, spec));
  if (manifest.can.dynamics) spec.dynamics = compose_dynamics(raw.dynamics, features, *character);
  if (spec.dynamics.mode != Mode::kinematic) spec.hold_frames += kTimeToReturn;
  return spec;
}

}  // namespace contort
