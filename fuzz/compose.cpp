#include "fuzz/compose.h"

#include <algorithm>
#include <cmath>

#include "fuzz/compose_dynamics.h"
#include "fuzz/features.h"
#include "generator/actions/action.h"
#include "generator/character/character.h"
#include "generator/core/detmath.h"
#include "generator/motion/kinematics.h"
#include "generator/motion/legs.h"

namespace contort {

namespace {

constexpr int kTimeToReturn = 50;  // frames in which a figure may come back to its target

// Mostly the default, else one of a few: 0.5, 2, 0.8, 1.25.
double speed_of(int raw, const Features& features) {
  if (!features.profile().speeds || features.omits("speed")) return 1.0;
  constexpr double kSpeeds[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.5, 2.0, 0.8, 1.25};
  return kSpeeds[pick(raw, std::size(kSpeeds))];
}

// Half of the blends are at once; the others take up to 20 frames.
int blend_of(int raw, const Features& features) {
  return features.omits("blend") ? 0 : std::max(0, between(raw, -20, 20));
}

// On the lattice, and never beyond the ends.
double within(double value, double steps_per_unit, double low, double high) {
  const double rounded = contort::on_lattice(value, steps_per_unit);
  if (rounded < low) return std::ceil(low * steps_per_unit) / steps_per_unit + 0.0;
  if (rounded > high) return std::floor(high * steps_per_unit) / steps_per_unit + 0.0;
  return rounded;
}

Vec3 on_lattice(const Vec3& v, double steps_per_unit) {
  Vec3 out;
  for (int i = 0; i < 3; ++i) out[i] = contort::on_lattice(v[i], steps_per_unit);
  return out;
}

// Reads the raw values of one action one after another; wraps around where a part has more joints than there are
// values.
class Values {
 public:
  Values(const std::array<int, kRawValues>& raw, double range) : raw_(raw), range_(range) {}
  double next() { return fraction(raw_[used_++ % kRawValues]); }
  // A place in a joint's range, within the share of it that the profile allows.
  double next_in_range() { return range_ == 1.0 ? next() : 0.5 + range_ * (next() - 0.5); }
  double range() const { return range_; }

 private:
  const std::array<int, kRawValues>& raw_;
  double range_;
  std::size_t used_ = 0;
};

// A rotation within the ball joint's cone and twist, as a rotation vector in whole degrees. Rounding may carry it half
// a degree over, so the draw stays 2 % inside.
Vec3 draw_ball_deg(const Joint& joint, Values& values) {
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double radius = 0.98 * values.range() * std::sqrt(values.next());  // even over the ellipse
  const Vec3 other = glm::cross(joint.axis, joint.swing_axis);
  const Vec3 swing =
      radius * (joint.swing_a_rad * around.cos * joint.swing_axis + joint.swing_b_rad * around.sin * other);
  const double twist = 0.98 * (joint.low + (joint.high - joint.low) * values.next_in_range());
  const Quat q = joint.swing_center * from_rotation_vector(swing) * axis_angle(joint.axis, twist);
  return on_lattice(to_rotation_vector(q) * kDegPerRad, 1.0);
}

ParamValue draw_joint(const Joint& joint, Values& values) {
  if (joint.kind == JointKind::ball) return draw_ball_deg(joint, values);
  const double value = joint.low + (joint.high - joint.low) * values.next_in_range();
  if (joint.kind == JointKind::prismatic) return within(value, 100.0, joint.low, joint.high);
  return within(value * kDegPerRad, 1.0, joint.low * kDegPerRad, joint.high * kDegPerRad);
}

double length(const Vec3& v) { return std::sqrt(glm::dot(v, v)); }

// A point around the chain's upper joint at rest, between 0.3 and 1.1 of the stretched chain away, in centimetres.
Vec3 draw_reach_point(const Character& character, const ReachChain& chain, Values& values) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const Vec3 upper = world[static_cast<std::size_t>(chain.upper)].p_m;
  const Vec3 middle = world[static_cast<std::size_t>(chain.middle)].p_m;
  const Vec3 tip = world_from_socket(character, world, chain.tip).p_m;
  const double distance = (length(middle - upper) + length(tip - middle)) * (0.3 + 0.8 * values.next());
  const double height = 2.0 * values.next() - 1.0;  // even over the sphere
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double across = std::sqrt(1.0 - height * height);
  return on_lattice(upper + distance * Vec3(across * around.sin, height, across * around.cos), 100.0);
}

// A point 0.3 to 5 m away, between the ground and 2.5 m, in centimetres.
ParamValue draw_around(Values& values) {
  const det::SinCos around = det::sincos(2.0 * kPi * values.next());
  const double distance_m = 0.3 + 4.7 * values.next();
  return on_lattice(Vec3(distance_m * around.sin, 2.5 * values.next(), distance_m * around.cos), 100.0);
}

ParamValue draw_uniform(const ParamDef& def, Values& values) {
  const double steps = steps_per_unit(def.name);
  const auto one = [&] { return within(def.low + (def.high - def.low) * values.next(), steps, def.low, def.high); };
  if (def.type == ParamType::number) return one();
  const double x = one(), y = one(), z = one();
  return Vec3(x, y, z);
}

ParamValue draw_param(const Character& character, const Part& part, std::size_t index, const ParamDef& def,
                      Values& values) {
  if (def.type == ParamType::choice) return def.choices[values.next() < 0.5 ? 0 : def.choices.size() - 1];
  if (def.type == ParamType::object_point || def.type == ParamType::own_point) {
    const std::vector<std::string> names =
        def.type == ParamType::own_point ? own_points(character, part) : object_points(character, part);
    return names[std::min(names.size() - 1, static_cast<std::size_t>(values.next() * static_cast<double>(names.size())))];
  }
  switch (def.domain) {
    case Domain::joint_range:
      return draw_joint(character.joints()[static_cast<std::size_t>(part.first_joint) + index], values);
    case Domain::within_reach:  // large figures reach farther than a spec may say
      return glm::clamp(draw_reach_point(character, part.reach.front(), values), Vec3(def.low), Vec3(def.high));
    case Domain::around: return draw_around(values);
    case Domain::uniform: break;
  }
  return draw_uniform(def, values);
}

void draw_params(const Character& character, const Part& part, const Action& action, Values values, ActionUse& use) {
  const std::vector<ParamDef> defs = params_of(action, character, part);
  for (std::size_t i = 0; i < defs.size(); ++i) {
    // What makes an action of a file that action is changed in one of four.
    if (action.desc != nullptr && action.desc->params.contains(defs[i].name) && values.next() < 0.75) continue;
    if (defs[i].optional && values.next() < 0.4) continue;
    use.params[defs[i].name] = draw_param(character, part, i, defs[i], values);
  }
}

// What may be moved, and by what.
struct Stock {
  const Character& character;
  const Features& features;
  std::vector<const Part*> parts;

  std::vector<Action> actions(const Part& part) const {
    return features.among(actions_of(character, part), "action", features.profile().actions,
                          [](const Action& action) { return std::string_view(action.name); });
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
  if (action.def->timing == Timing::course) use.blend_in_frames = blend_of(raw.blend_in, stock.features);
  if (action.def->layer != Layer::overwrite) use.blend_out_frames = blend_of(raw.blend_out, stock.features);
  draw_params(stock.character, part, action, Values(raw.values, profile.range), use);
  return use;
}

ClipDesc compose_clip(const RawClip& raw, const Stock& stock) {
  ClipDesc clip;
  clip.start_frame = between(raw.start, 0, 30);
  clip.speed = speed_of(raw.speed, stock.features);
  const bool may_stretch = stock.features.profile().speeds && !stock.features.omits("stretch");
  if (pick(raw.stretch, 5) == 0 && may_stretch)
    clip.duration_frames = between(raw.stretch * 5 % (kLattice + 1), 20, 120);
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
    field.heights_m.push_back(contort::on_lattice(
        1e-2 * ((raw[2 + i % 7] / 100 + raw[9 + i / 7 % 7] / 100) % 13 - 6), 100.0));
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

// Slots whose parts can tell of an event: feet and what aims.
std::vector<std::string> slots_that_tell(Event event, const Character& character) {
  std::vector<std::string> slots;
  if (event == Event::contact)
    for (const Leg& leg : find_legs(character))
      slots.push_back(character.parts()[static_cast<std::size_t>(leg.foot_part)].slot);
  if (event == Event::aim_reached)
    for (const Part& part : character.parts())
      if (find_action(character, part, "aim")) slots.push_back(part.slot);
  return slots;
}

ConditionDesc compose_condition(const RawInterrupt& raw, const Character& character, Spec& spec) {
  ConditionDesc when;
  constexpr Event kEvents[] = {Event::frame,   Event::frame,          Event::clip_ended,
                               Event::impact,  Event::sequence_ended, Event::ground_steeper,
                               Event::contact, Event::aim_reached,    Event::near_obstacle};
  when.event = kEvents[pick(raw.event, std::size(kEvents))];
  const std::vector<std::string> slots = slots_that_tell(when.event, character);
  const bool waits_for_slot = when.event == Event::contact || when.event == Event::aim_reached;
  const bool cannot_happen = (waits_for_slot && slots.empty()) ||
                             (when.event == Event::near_obstacle && spec.environment.obstacles.empty());
  if (cannot_happen) when.event = Event::frame;
  if (when.event == Event::frame) when.frame = between(raw.what, 0, 150);
  if (when.event == Event::near_obstacle) when.distance_m = contort::on_lattice(0.1 * between(raw.what, 2, 20), 10.0);
  if (waits_for_slot && !cannot_happen) when.slot = slots[pick(raw.what, slots.size())];
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
