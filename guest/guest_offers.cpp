#include "guest/guest_offers.h"

#include <algorithm>
#include <cmath>

#include "guest/manifest_check.h"

namespace contort {

namespace {

constexpr double kLeastSteps = 500.0;  // least number of steps in a number's range

ParamValue value_of(const GuestValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return std::string(*flag ? "true" : "false");
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
  return std::get<double>(value);
}

// The least power of ten that gives at least kLeastSteps steps in the range.
double steps_for(double range) {
  double steps = 1.0;
  while (range > 0.0 && range * steps < kLeastSteps && steps < 1e9) steps *= 10.0;
  return steps;
}

ParamValue preset_of(const GuestParam& param) {
  if (param.preset) return value_of(*param.preset);
  if (param.type == GuestParamType::flag) return std::string("false");
  if (param.type == GuestParamType::choice) return param.choices.front();
  const Vec3 nearest = glm::clamp(Vec3(0.0), as_three(param.low), as_three(param.high));
  if (param.type == GuestParamType::vec3) return nearest;
  return nearest.x;
}

void add_once(std::vector<ParamValue>& values, const ParamValue& value) {
  if (std::ranges::find(values, value) == values.end()) values.push_back(value);
}

// The values that the manifest lists, and values at which programs often fail: the ends, zero, the default.
std::vector<ParamValue> special_values(const GuestParam& param, const ParamDef& def) {
  std::vector<ParamValue> values;
  for (const GuestValue& value : param.special) add_once(values, value_of(value));
  for (const std::string& choice : def.choices) add_once(values, choice);
  const Vec3 low = as_three(param.low), high = as_three(param.high);
  const Vec3 zero = glm::clamp(Vec3(0.0), low, high);
  for (const Vec3& corner : {low, high, zero}) {
    if (def.type == ParamType::vector) add_once(values, corner);
    if (def.type == ParamType::number) add_once(values, corner.x);
  }
  add_once(values, def.preset);
  return values;
}

ParamDef param_def(const std::string& name, const GuestParam& param) {
  ParamDef def;
  def.name = name;
  def.help = param.help;
  def.preset = preset_of(param);
  const bool is_word = param.type == GuestParamType::choice || param.type == GuestParamType::flag;
  def.type = is_word ? ParamType::choice : param.type == GuestParamType::vec3 ? ParamType::vector : ParamType::number;
  if (param.type == GuestParamType::flag) def.choices = {"false", "true"};
  if (param.type == GuestParamType::choice) def.choices = param.choices;
  const Vec3 low = as_three(param.low), high = as_three(param.high);
  if (!is_word) {
    def.low = std::min({low.x, low.y, low.z}), def.high = std::max({high.x, high.y, high.z});
    def.steps = param.type == GuestParamType::integer ? 1.0 : steps_for(def.high - def.low);
  }
  if (def.type == ParamType::vector) def.box = {low, high};
  def.special = special_values(param, def);
  return def;
}

}  // namespace

OfferedAction offer_of(const GuestManifest& manifest, const GuestAction& action, int part) {
  OfferedAction out;
  out.name = action.name;
  out.help = action.help;
  out.layer = action.layer;
  if (action.goal) out.promise = Promise::arrives;
  for (const auto& [name, param] : action.params) out.params.push_back(param_def(name, param));
  out.moves = {part};
  out.duration = frames_of(action.duration_s, manifest.rate_hz);
  out.blend_in = frames_of(action.blend_in_s, manifest.rate_hz);
  out.blend_out = frames_of(action.blend_out_s, manifest.rate_hz);
  return out;
}

FrameRange frames_of(const std::array<double, 2>& seconds, double rate_hz) {
  const auto frames = [&](double s) { return static_cast<int>(std::lround(s * rate_hz)); };
  return {frames(seconds[0]), frames(seconds[1])};
}

Offers offers_of(const GuestManifest& manifest, const Character& character) {
  Offers offers(character.parts().size());
  for (std::size_t p = 0; p < offers.size(); ++p)
    for (const GuestAction& action : manifest.actions) {
      const bool is_listed = std::ranges::find(action.slots, character.parts()[p].slot) != action.slots.end();
      if (is_listed || (action.slots.empty() && p == 0))
        offers[p].push_back(offer_of(manifest, action, static_cast<int>(p)));
    }
  return offers;
}

}  // namespace contort
