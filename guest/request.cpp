#include "guest/request.h"

#include <algorithm>
#include <cmath>

#include "guest/guest_figure.h"
#include "guest/guest_offers.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"

namespace contort {

namespace {

using json_fields::Json;

int content_frames(const SequenceDesc& sequence) {
  int end = 0;
  for (const ClipDesc& clip : sequence.clips)
    for (const ActionUse& use : clip.actions)
      end = std::max(end, clip.start_frame + use.start_frame + use.duration_frames);
  return end;
}

// An action may be listed several times, for different slots.
const GuestAction* find_action(const GuestManifest& manifest, const ActionUse& use) {
  const GuestAction* named = nullptr;
  for (const GuestAction& action : manifest.actions) {
    if (action.name != use.action) continue;
    if (std::ranges::find(action.slots, use.slot) != action.slots.end()) return &action;
    named = &action;
  }
  return named;
}

// The first feature of the spec that programs do not support.
const char* unsupported(const Spec& spec) {
  if (!spec.interrupts.empty()) return "/interrupts";
  if (!spec.recording.name.empty()) return "/recording";
  if (spec.dynamics != DynamicsDesc{}) return "/dynamics";
  if (spec.environment != EnvironmentDesc{}) return "/environment";
  if (spec.start != StartDesc{}) return "/start";
  if (!spec.character.attachments.empty()) return "/character/attachments";
  if (!spec.only_slot.empty()) return "/only_slot";
  if (spec.only_sequence != 0) return "/only_sequence";
  if (spec.only_clip != 0) return "/only_clip";
  return nullptr;
}

Issue not_offered(const std::string& code, const std::string& at, const std::string& text) {
  return {"guest." + code, at, text};
}

Result<Done> admit_params(const ActionUse& use, const OfferedAction& action, const std::string& at) {
  for (const auto& [name, value] : use.params) {
    const auto def = std::ranges::find(action.params, name, &ParamDef::name);
    const std::string place = at + "/params/" + name;
    if (def == action.params.end())
      return not_offered("unknown_param", place, action.name + " has no parameter \"" + name + "\"");
    if (!allows(*def, value))
      return not_offered("bad_param", place, "the value is not one that the manifest allows for " + name);
  }
  return Done{};
}

Result<Done> admit_use(const ActionUse& use, const Character& character, const Offers& offers, const std::string& at) {
  const int part = character.find_part(use.slot);
  if (part < 0) return not_offered("unknown_slot", at + "/slot", character.name() + " has no slot \"" + use.slot + "\"");
  const OfferedAction* action = find_offer(offers, part, use.action);
  if (action == nullptr)
    return not_offered("unknown_action", at + "/action",
                       "the generator does not offer \"" + use.action + "\" on slot \"" + use.slot + "\"");
  if (use.speed != 1.0) return not_offered("unsupported", at + "/speed", "a use has no speed of its own here");
  const bool is_allowed = action->duration->least <= use.duration_frames && use.duration_frames <= action->duration->most;
  if (!is_allowed)
    return not_offered("bad_duration", at + "/duration_frames",
                       "found " + std::to_string(use.duration_frames) + " frames, allowed are " +
                           std::to_string(action->duration->least) + " to " + std::to_string(action->duration->most));
  return admit_params(use, *action, at);
}

Result<Done> admit_clip(const ClipDesc& clip, const Character& character, const Offers& offers, const std::string& at) {
  if (clip.speed != 1.0) return not_offered("unsupported", at + "/speed", "a clip has no speed of its own here");
  if (clip.duration_frames != 0) return not_offered("unsupported", at + "/duration_frames", "a clip is not stretched");
  for (std::size_t a = 0; a < clip.actions.size(); ++a)
    if (const Result<Done> use = admit_use(clip.actions[a], character, offers, at + "/actions/" + std::to_string(a)); !use)
      return use;
  return Done{};
}

Json json_of(const ParamValue& value, GuestParamType type) {
  if (type == GuestParamType::flag) return std::get<std::string>(value) == "true";
  if (const auto* vector = std::get_if<Vec3>(&value)) return Json::array({vector->x, vector->y, vector->z});
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  if (type == GuestParamType::integer) return static_cast<std::int64_t>(std::llround(std::get<double>(value)));
  return std::get<double>(value);
}

Json params_of(const PlacedUse& placed) {
  Json params = Json::object();
  for (const ParamDef& def : placed.offer->params) {
    const auto given = placed.use->params.find(def.name);
    params[def.name] = json_of(given == placed.use->params.end() ? def.preset : given->second,
                               placed.action->params.at(def.name).type);
  }
  return params;
}

Json json_of(const PlacedUse& placed, const GuestRequest& request, double spec_rate_hz) {
  const double start_s = placed.start_frame / spec_rate_hz;
  return Json{{"action", placed.use->action},
           {"slot", placed.use->slot},
           {"start_frame", static_cast<int>(std::ceil(start_s * request.rate_hz - 1e-9))},
           {"start_s", start_s},
           {"duration_s", placed.use->duration_frames / spec_rate_hz},
           {"blend_in_s", std::max(0, placed.use->blend_in_frames) / spec_rate_hz},
           {"blend_out_s", placed.use->blend_out_frames / spec_rate_hz},
           {"params", params_of(placed)}};
}

Json parts_of(const GuestManifest& manifest, const Spec& spec) {
  Json parts = Json::object();
  const GuestCharacter* character = find_character(manifest, spec.character.name);
  for (const auto& [slot, part] : spec.character.parts)
    if (const std::string asked = part_asked_for(*character, slot, part); !asked.empty()) parts[slot] = asked;
  return parts;
}

}  // namespace

bool allows(const ParamDef& def, const ParamValue& value) {
  if (const auto* word = std::get_if<std::string>(&value))
    return def.type == ParamType::choice && std::ranges::find(def.choices, *word) != def.choices.end();
  if (const auto* number = std::get_if<double>(&value))
    return def.type == ParamType::number && def.low <= *number && *number <= def.high;
  const Vec3& v = std::get<Vec3>(value);
  return def.type == ParamType::vector && glm::all(glm::lessThanEqual(def.box[0], v)) &&
         glm::all(glm::lessThanEqual(v, def.box[1]));
}

std::vector<PlacedUse> placed_uses(const GuestManifest& manifest, const Spec& spec, const Character& character,
                                   const Offers& offers) {
  std::vector<PlacedUse> placed;
  int begin = 0;
  for (std::size_t s = 0; s < spec.sequences.size(); ++s) {
    const SequenceDesc& sequence = spec.sequences[s];
    for (std::size_t c = 0; c < sequence.clips.size(); ++c)
      for (std::size_t a = 0; a < sequence.clips[c].actions.size(); ++a) {
        const ActionUse& use = sequence.clips[c].actions[a];
        placed.push_back({&use, find_action(manifest, use),
                          find_offer(offers, character.find_part(use.slot), use.action), static_cast<int>(s),
                          static_cast<int>(c), static_cast<int>(a), begin + sequence.clips[c].start_frame + use.start_frame});
      }
    begin += content_frames(sequence);
  }
  std::ranges::stable_sort(placed, {}, &PlacedUse::start_frame);
  return placed;
}

int frames_of(const Spec& spec) {
  int frames = 1 + spec.hold_frames;
  for (const SequenceDesc& sequence : spec.sequences) frames += content_frames(sequence);
  return frames;
}

Result<Done> admit_request(const Spec& spec, const Character& character, const Offers& offers) {
  if (const char* at = unsupported(spec))
    return not_offered("unsupported", at, "generators that are programs of their own do not have this");
  for (std::size_t s = 0; s < spec.sequences.size(); ++s) {
    const std::string at = "/sequences/" + std::to_string(s);
    if (spec.sequences[s].duration_frames != 0)
      return not_offered("unsupported", at + "/duration_frames", "a sequence is not stretched");
    for (std::size_t c = 0; c < spec.sequences[s].clips.size(); ++c)
      if (const Result<Done> clip =
              admit_clip(spec.sequences[s].clips[c], character, offers, at + "/clips/" + std::to_string(c));
          !clip)
        return clip;
  }
  if (frames_of(spec) > kMaxFrames)
    return not_offered("too_long", "/sequences", "the motion has more than " + std::to_string(kMaxFrames) + " frames");
  return Done{};
}

std::string print_request(const GuestRequest& request, const GuestManifest& manifest, const Spec& spec) {
  Json timeline = Json::array();
  for (const PlacedUse& placed : request.uses) timeline.push_back(json_of(placed, request, spec.rate_hz));
  const Json line{{"op", "generate"},
                  {"id", request.id},
                  {"character", spec.character.name},
                  {"parts", parts_of(manifest, spec)},
                  {"seed", 0},
                  {"rate_hz", request.rate_hz},
                  {"frames", request.frames},
                  {"timeline", timeline}};
  return line.dump();
}

}  // namespace contort
