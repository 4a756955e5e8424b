#include "corpus/request.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/core/index.h"
#include "model/motion/kinematics.h"
#include "model/spec/clip.h"

namespace contort {

namespace {

constexpr std::size_t kMostRequests = 256;
constexpr std::string_view kSeconds = ".seconds";

// One use of an action, with the time when it plays.
struct Played {
  const ActionUse* use = nullptr;
  double start_s = 0.0;  // from the start of the queue, or of its interrupt
  double seconds = 0.0;
  int queue = 0;  // 0: the spec's sequences; else an interrupt, counted from 1. Times of two queues cannot be compared.
};

double natural_length(const SequenceDesc& sequence) {
  double length = 0.0;
  for (const ClipDesc& clip : sequence.clips) length = std::max(length, clip.start_frame + clip_length(clip));
  return length;
}

double ratio(double length, double natural) { return natural > 0.0 ? length / natural : 1.0; }

// Adds the uses of a sequence that begins at this frame, and returns its length in frames.
double add_played(const SequenceDesc& sequence, double from_frame, int queue, double rate_hz,
                  std::vector<Played>& out) {
  const double natural = natural_length(sequence);
  const double length = stretched(natural, sequence.duration_frames), scale = ratio(length, natural);
  for (const ClipDesc& clip : sequence.clips) {
    const double inner = scale * ratio(clip_length(clip), natural_length(clip));
    for (const ActionUse& use : clip.actions) {
      const double start = from_frame + scale * clip.start_frame + inner * use.start_frame;
      out.push_back({&use, start / rate_hz, inner * use.duration_frames / rate_hz, queue});
    }
  }
  return length;
}

std::vector<Played> played_in(const Spec& spec) {
  std::vector<Played> all;
  double frame = 0.0;
  for (const SequenceDesc& sequence : spec.sequences) frame += add_played(sequence, frame, 0, spec.rate_hz, all);
  for (std::size_t i = 0; i < spec.interrupts.size(); ++i)
    add_played(spec.interrupts[i].sequence, 0.0, static_cast<int>(i) + 1, spec.rate_hz, all);
  return all;
}

// The distance of a point from the upper joint of a limb at rest, as a fraction of the length of the stretched limb.
double share_of_reach(const Character& character, const ReachChain& limb, const Vec3& point_m) {
  std::vector<Rigid> world(character.joints().size());
  forward_kinematics(character, character.rest_root(), character.rest_coords(), world);
  const Vec3 upper_m = world[at(limb.upper)].p_m, middle_m = world[at(limb.middle)].p_m;
  const Vec3 tip_m = world_from_socket(character, world, limb.tip).p_m;
  return length(point_m - upper_m) / (length(middle_m - upper_m) + length(tip_m - middle_m));
}

class Writer {
 public:
  Writer(const Character& character, const Offers& offers, SpecRequest& out)
      : character_(character), offers_(offers), out_(out) {}

  void number(std::string name, double value, bool is_mirrored = false) {
    out_.values.push_back({std::move(name), value, {}, is_mirrored});
  }
  void word(std::string name, std::string value) { out_.values.push_back({std::move(name), 0.0, std::move(value)}); }

  void action(const Played& played) {
    const ActionUse& use = *played.use;
    const std::string prefix = use.action + ".";
    number(prefix + "seconds", played.seconds);
    word(prefix + "slot", use.slot);
    number(prefix + "blend_in_frames", use.blend_in_frames);
    number(prefix + "blend_out_frames", use.blend_out_frames);
    number(prefix + "speed", use.speed);
    const int index = character_.find_part(use.slot);
    if (index < 0) return;
    const Part& part = character_.parts()[at(index)];
    word(prefix + "part", part.name);
    if (const OfferedAction* offer = find_offer(offers_, index, use.action))
      for (const ParamDef& def : offer->params) param(prefix, def, use, part);
  }

 private:
  void param(const std::string& prefix, const ParamDef& def, const ActionUse& use, const Part& part) {
    const auto given = use.params.find(def.name);
    if (given == use.params.end() && def.optional) return;
    const ParamValue& value = given != use.params.end() ? given->second : def.preset;
    const std::string name = prefix + def.name;
    if (const double* scalar = std::get_if<double>(&value))
      number(name, *scalar, def.mirrored == Mirrored::opposite);
    else if (const Vec3* vector = std::get_if<Vec3>(&value))
      for (int i = 0; i < 3; ++i)
        number(name + "." + "xyz"[i], (*vector)[i],
               (def.mirrored == Mirrored::point && i == 0) || (def.mirrored == Mirrored::rotation && i > 0));
    else
      word(name, std::get<std::string>(value));
    const Vec3* const target_m = std::get_if<Vec3>(&value);
    if (target_m != nullptr && def.domain == Domain::within_reach && !part.reach.empty())
      number(name + ".of_reach", share_of_reach(character_, part.reach.front(), *target_m));
  }

  const Character& character_;
  const Offers& offers_;
  SpecRequest& out_;
};

void add_impact(const Spec& spec, Writer& out) {
  const ImpactDesc* strongest = nullptr;
  for (const ImpactDesc& impact : spec.dynamics.impacts)
    if (strongest == nullptr || length(impact.impulse_N_s) > length(strongest->impulse_N_s)) strongest = &impact;
  if (strongest == nullptr) return;
  out.number("impact.impulse_N_s", length(strongest->impulse_N_s));
  for (int i = 0; i < 3; ++i) out.number(std::string("impact.impulse_N_s.") + "xyz"[i], strongest->impulse_N_s[i]);
  out.number("impact.at_s", strongest->frame / spec.rate_hz);
  out.word("impact.slot", strongest->slot);
}

void add_load(const Spec& spec, Writer& out) {
  const LoadDesc* heaviest = nullptr;
  for (const LoadDesc& load : spec.dynamics.loads)
    if (heaviest == nullptr || load.mass_kg > heaviest->mass_kg) heaviest = &load;
  if (heaviest == nullptr) return;
  out.number("load.mass_kg", heaviest->mass_kg);
  out.word("load.slot", heaviest->slot);
}

void add_ground(const Spec& spec, Writer& out) {
  if (std::holds_alternative<PlaneGround>(spec.environment.ground)) return;
  out.number("uneven_ground", 1.0);
  if (const auto* slope = std::get_if<SlopeGround>(&spec.environment.ground)) {
    out.number("slope_deg", slope->slope_deg);
    out.number("slope_heading_deg", slope->heading_deg + spec.environment.heading_deg - spec.start.heading_deg);
  }
  if (const auto* steps = std::get_if<StepsGround>(&spec.environment.ground)) {
    out.number("step_m", steps->height_m);
    out.number("tread_m", steps->depth_m);
  }
}

void add_surroundings(const Spec& spec, Writer& out) {
  if (spec.dynamics.mode != Mode::kinematic) out.number("simulated", 1.0);
  if (!spec.environment.obstacles.empty())
    out.number("obstacles", static_cast<double>(spec.environment.obstacles.size()));
  if (!spec.character.parts.empty() || !spec.character.attachments.empty()) out.number("swapped", 1.0);
  out.number("start.ahead_m", spec.start.ahead_m);
  out.number("start.lower_m", spec.start.lower_m);
  add_impact(spec, out), add_load(spec, out), add_ground(spec, out);
}

void add_gap(const std::vector<const Played*>& chosen, Writer& out) {
  if (chosen.size() != 2 || chosen[0]->queue != chosen[1]->queue) return;
  const auto [earlier, later] = std::minmax(chosen[0], chosen[1], [](const Played* a, const Played* b) {
    return a->start_s < b->start_s;
  });
  out.number("gap_seconds", later->start_s - earlier->start_s - earlier->seconds);
}

using Combination = std::vector<const Played*>;

// All combinations of one use for each name.
std::vector<Combination> combinations_of(const std::vector<Played>& all, const std::vector<std::string>& names) {
  std::vector<Combination> chosen = {{}};
  for (const std::string& name : names) {
    std::vector<Combination> longer;
    for (const Combination& so_far : chosen)
      for (const Played& played : all)
        if (played.use->action == name && longer.size() < kMostRequests) {
          longer.push_back(so_far);
          longer.back().push_back(&played);
        }
    chosen = std::move(longer);
  }
  return chosen;
}

// The first use of each action that the spec has.
std::vector<Combination> first_uses(const std::vector<Played>& all) {
  Combination first;
  for (const Played& played : all)
    if (std::ranges::none_of(first, [&](const Played* other) { return other->use->action == played.use->action; }))
      first.push_back(&played);
  return {first};
}

std::vector<std::string> actions_of(const std::vector<std::string>& needs) {
  std::vector<std::string> actions;
  for (const std::string& name : needs)
    if (name.ends_with(kSeconds)) actions.push_back(name.substr(0, name.size() - kSeconds.size()));
  return actions;
}

bool has_all(const SpecRequest& request, const std::vector<std::string>& needs) {
  return std::ranges::all_of(needs, [&](const std::string& name) {
    return std::ranges::find(request.values, name, &RequestValue::name) != request.values.end();
  });
}

}  // namespace

std::vector<std::string> needs_of(const Cause& cause) {
  static const std::map<std::string, std::string> kOfSettings = {{"ground", "uneven_ground"},
                                                                 {"impact", "impact.impulse_N_s"},
                                                                 {"load", "load.mass_kg"},
                                                                 {"obstacle", "obstacles"},
                                                                 {"swap", "swapped"}};
  std::vector<std::string> needs;
  for (const std::string& name : cause.names) {
    const auto of_setting = kOfSettings.find(name);
    if (cause.scope != CauseScope::setting) needs.push_back(name + std::string(kSeconds));
    if (cause.scope == CauseScope::setting && of_setting != kOfSettings.end()) needs.push_back(of_setting->second);
  }
  if (cause.is_simulated) needs.emplace_back("simulated");
  return needs;
}

std::vector<SpecRequest> requests_of(const Spec& spec, const std::vector<std::string>& needs,
                                     const Character& character, const Offers& offers) {
  const std::vector<Played> all = played_in(spec);
  const std::vector<std::string> actions = actions_of(needs);
  std::vector<SpecRequest> requests;
  for (const Combination& chosen : actions.empty() ? first_uses(all) : combinations_of(all, actions)) {
    SpecRequest request{spec.character.name, {}};
    Writer writer(character, offers, request);
    for (const Played* played : chosen) writer.action(*played);
    add_gap(chosen, writer);
    add_surroundings(spec, writer);
    if (has_all(request, needs)) requests.push_back(std::move(request));
  }
  return requests;
}

std::vector<known::Value> known_values(const SpecRequest& request) {
  std::vector<known::Value> values;
  for (const RequestValue& value : request.values) values.push_back({value.name, value.number, value.word});
  return values;
}

}  // namespace contort
