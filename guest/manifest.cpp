#include "guest/manifest.h"

#include <algorithm>

#include "guest/manifest_check.h"
#include "guest/model_joints.h"
#include "model/core/hash.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

using json_fields::Rule;
using json_fields::Text;

constexpr std::string_view kAxes[] = {"+x", "-x", "+y", "-y", "+z", "-z"};
constexpr std::string_view kHands[] = {"right", "left"};
constexpr std::string_view kGuestJointTypes[] = {"ball", "hinge", "fixed"};
constexpr std::string_view kGuestShapes[] = {"capsule", "box"};
constexpr std::string_view kGuestParamTypes[] = {"number", "integer", "flag", "choice", "vec3"};
constexpr std::string_view kOtherSides[] = {"by_type", "same", "opposite"};
constexpr std::string_view kLayers[] = {"overwrite", "ik", "additive"};
constexpr std::string_view kEffects[] = {"continuous", "cut", "rest", "equals", "none"};
constexpr std::string_view kChannelTypes[] = {"number", "flag", "text"};
constexpr std::string_view kFormats[] = {"f32", "f64"};
constexpr std::string_view kDeterminisms[] = {"exact", "history", "noisy"};

const Rule kGuestLabel{.text = Text::label, .required = true};
const Rule kGuestText{.text = Text::prose, .may_be_empty = true};
const Rule kGuestName{.required = true};
const Rule kGuestLength{.low = -1e6, .high = 1e6};
const Rule kGuestSeconds{.low = 0.0, .high = 60.0};

}  // namespace

namespace json_fields {

template <class Many>
struct Codec<std::variant<double, Many>> {
  static void read(const Json& in, const Rule& r, std::variant<double, Many>& out, ReadContext& c) {
    if (in.is_array())
      Codec<Many>::read(in, r, out.template emplace<Many>(), c);
    else
      Codec<double>::read(in, r, out.template emplace<double>(), c);
  }
  static Json write(const std::variant<double, Many>& v, const Rule& r) {
    return std::visit([&](const auto& x) { return Codec<std::decay_t<decltype(x)>>::write(x, r); }, v);
  }
  static Json schema(const Rule& r) {
    return {{"anyOf", Json::array({Codec<double>::schema(r), Codec<Many>::schema(r)})}};
  }
};

template <>
struct Codec<GuestValue> {
  static void read(const Json& in, const Rule& r, GuestValue& out, ReadContext& c) {
    if (in.is_boolean())
      out = in.get<bool>();
    else if (in.is_number())
      Codec<double>::read(in, {.low = -1e9, .high = 1e9}, out.emplace<double>(), c);
    else if (in.is_array())
      Codec<Vec3>::read(in, {.low = -1e9, .high = 1e9}, out.emplace<Vec3>(), c);
    else
      Codec<std::string>::read(in, r, out.emplace<std::string>(), c);
  }
  static Json write(const GuestValue& v, const Rule& r) {
    return std::visit([&](const auto& x) { return Codec<std::decay_t<decltype(x)>>::write(x, r); }, v);
  }
  static Json schema(const Rule& r) {
    return {{"anyOf", Json::array({Codec<double>::schema({}), Codec<Vec3>::schema({}), Codec<bool>::schema({}),
                                   Codec<std::string>::schema(r)})}};
  }
};

}  // namespace json_fields

template <class V>
void fields(V& v, const GuestConvention*) {
  v.field("up", &GuestConvention::up, {.names = kAxes}, "Axis that points up.");
  v.field("forward", &GuestConvention::forward, {.names = kAxes}, "Axis that figures face.");
  v.field("unit_m", &GuestConvention::unit_m, {.low = 1e-6, .high = 1e6}, "Metres of one unit of length.");
  v.field("handed", &GuestConvention::handed, {.names = kHands}, "Handedness of the coordinate system.");
}

template <class V>
void fields(V& v, const GuestFollow*) {
  v.field("joint", &GuestFollow::joint, kGuestLabel, "The hinge that leads.");
  v.field("multiplier", &GuestFollow::multiplier, {.low = -1000, .high = 1000}, "Of the leader's angle.");
  v.field("offset_deg", &GuestFollow::offset_deg, {.low = -3600, .high = 3600}, "Angle that is added.");
}

template <class V>
void fields(V& v, const GuestJoint*) {
  v.field("name", &GuestJoint::name, kGuestLabel, "Name, unique in the character.");
  v.field("parent", &GuestJoint::parent, {.text = Text::label, .may_be_empty = true},
          "An earlier joint; empty for the first one, which is the root.");
  v.field("slot", &GuestJoint::slot, {.may_be_empty = true}, "Slot of the figure; empty: the slot of the parent.");
  v.field("position", &GuestJoint::position, kGuestLength, "Position at rest, in the frame of the parent.");
  v.field("rotation", &GuestJoint::rotation, {.low = -1.001, .high = 1.001},
          "Rotation at rest relative to the parent, quaternion x y z w.");
  v.field("type", &GuestJoint::type, {.names = kGuestJointTypes}, "Kind of joint.");
  v.field("axis", &GuestJoint::axis, {.low = -1.001, .high = 1.001},
          "Axis of the hinge, or of a ball's twist, in the joint's own frame.");
  v.field("low_deg", &GuestJoint::low_deg, {.low = -360, .high = 360}, "Lower end of the range; 0 is rest.");
  v.field("high_deg", &GuestJoint::high_deg, {.low = -360, .high = 360}, "Upper end.");
  v.field("swing_deg", &GuestJoint::swing_deg, {.low = 0.1, .high = 180},
          "Greatest swing of a ball: one angle, or one about swing_axis and one at a right angle to it.");
  v.field("swing_axis", &GuestJoint::swing_axis, {.low = -1.001, .high = 1.001},
          "For a ball: unit axis at a right angle to its axis, in the joint's own frame.");
  v.field("swing_center_deg", &GuestJoint::swing_center_deg, {.low = -360, .high = 360},
          "For a ball: rotation vector to the middle of its swing.");
  v.field("max_speed_deg_s", &GuestJoint::max_speed_deg_s, {.low = 1, .high = 1e5}, "Greatest angular speed.");
  v.field("body", &GuestJoint::body, {.text = Text::label, .may_be_empty = true},
          "Name of the body that moves with the joint; empty: the name of the joint.");
  v.field("follows", &GuestJoint::follows, {},
          "For a hinge: its angle is multiplier * the angle of another hinge + offset_deg, both against rest.");
}

template <class V>
void fields(V& v, const GuestCollider*) {
  v.field("name", &GuestCollider::name, kGuestLabel, "Name, unique in the character.");
  v.field("joint", &GuestCollider::joint, kGuestLabel, "The joint that moves it.");
  v.field("type", &GuestCollider::type, {.names = kGuestShapes}, "Shape.");
  v.field("from", &GuestCollider::from, kGuestLength, "For a capsule: one end, in the frame of the joint.");
  v.field("to", &GuestCollider::to, kGuestLength, "For a capsule: the other end.");
  v.field("radius", &GuestCollider::radius, {.low = 1e-6, .high = 1e6}, "For a capsule: radius.");
  v.field("center", &GuestCollider::center, kGuestLength, "For a box: its middle, in the frame of the joint.");
  v.field("half", &GuestCollider::half, {.low = 1e-6, .high = 1e6}, "For a box: half of each side.");
  v.field("rotation", &GuestCollider::rotation, {.low = -1.001, .high = 1.001},
          "For a box: quaternion x y z w in the frame of the joint.");
}

template <class V>
void fields(V& v, const GuestCharacter*) {
  v.field("name", &GuestCharacter::name, kGuestName, "Unique name.");
  v.field("model", &GuestCharacter::model, kGuestText, "Model file that has the joints and colliders.");
  v.field("joints", &GuestCharacter::joints, {.max_count = 1000},
          "Joints, parents first; required without a model. With a model, they select its joints by name.");
  v.field("colliders", &GuestCharacter::colliders, {.max_count = 1000}, "Shapes that must not overlap.");
  v.field("may_touch", &GuestCharacter::may_touch, {.max_count = 100'000, .text = Text::label},
          "Pairs of colliders that may overlap.");
  v.field("parts", &GuestCharacter::parts, {.max_count = 64}, "For a slot, names of the parts that can be there.");
  v.field("mirror", &GuestCharacter::mirror, {.max_count = 1000, .text = Text::label, .key_text = Text::label},
          "For a joint of one side, the joint of the other side.");
}

template <class V>
void fields(V& v, const GuestParam*) {
  v.field("type", &GuestParam::type, {.names = kGuestParamTypes}, "Type of the value.");
  v.field("low", &GuestParam::low, {.low = -1e9, .high = 1e9}, "Least value.");
  v.field("high", &GuestParam::high, {.low = -1e9, .high = 1e9}, "Greatest value.");
  v.field("default", &GuestParam::preset, {.text = Text::label}, "Value that is used if a spec gives none.");
  v.field("choices", &GuestParam::choices, {.max_count = 256}, "For a choice: words of a-z, 0-9 and _.");
  v.field("special", &GuestParam::special, {.max_count = 64, .text = Text::label},
          "Values that are drawn more often than others.");
  v.field("mirror", &GuestParam::mirror, {.names = kOtherSides},
          "The value on the other side of the figure: same, or opposite; a vec3 is then reflected.");
  v.field("help", &GuestParam::help, kGuestText, "One sentence.");
}

template <class V>
void fields(V& v, const GuestGoal*) {
  v.field("param", &GuestGoal::param, kGuestName, "A parameter of type vec3: a point in the world.");
  v.field("tip", &GuestGoal::tip, kGuestLabel, "The joint that shall be there at the end of the action.");
  v.field("within", &GuestGoal::within, {.low = 1e-9, .high = 1e6}, "The distance that is allowed.");
}

template <class V>
void fields(V& v, const GuestAction*) {
  v.field("name", &GuestAction::name, kGuestName, "Unique name.");
  v.field("help", &GuestAction::help, kGuestText, "One sentence.");
  v.field("slots", &GuestAction::slots, {.max_count = 64}, "Slots on which the action can be requested.");
  v.field("layer", &GuestAction::layer, {.names = kLayers}, "Order of evaluation.");
  v.field("duration_s", &GuestAction::duration_s, kGuestSeconds, "Shortest and longest duration.");
  v.field("blend_in_s", &GuestAction::blend_in_s, kGuestSeconds, "Shortest and longest fade in.");
  v.field("blend_out_s", &GuestAction::blend_out_s, kGuestSeconds, "Shortest and longest fade out.");
  v.field("effect", &GuestAction::effect, {.names = kEffects}, "Effect that the action may have on the pose.");
  v.field("params", &GuestAction::params, {.max_count = 64}, "Parameters by name.");
  v.field("goal", &GuestAction::goal, {}, "A point that a joint reaches.");
  v.field("returns_s", &GuestAction::returns_s, {.low = 0.0, .high = 60.0},
          "Time after the end of the action from which the motion is as if the action had not been requested.");
  v.field("mirror", &GuestAction::mirror, {.may_be_empty = true}, "The action of the other side; empty: itself.");
  v.field("travels", &GuestAction::travels, {}, "While it is in force the root may jump, though the pose may not.");
}

template <class V>
void fields(V& v, const GuestChannel*) {
  v.field("name", &GuestChannel::name, kGuestLabel, "Unique name.");
  v.field("type", &GuestChannel::type, {.names = kChannelTypes}, "Type of its values.");
  v.field("contact", &GuestChannel::contact, {.text = Text::label, .may_be_empty = true},
          "For a flag: the joint that stands still in the world while the flag is set.");
}

template <class V>
void fields(V& v, const GuestManifest*) {
  v.field("contort", &GuestManifest::contort, {.low = 1, .high = 1, .required = true}, "Version of the protocol.");
  v.field("name", &GuestManifest::name, kGuestLabel, "Name of the generator.");
  v.field("build", &GuestManifest::build, {.text = Text::label, .may_be_empty = true}, "Build of the generator.");
  v.field("token", &GuestManifest::token, {.text = Text::label, .may_be_empty = true},
          "Over TCP: the value of CONTORT_TOKEN.");
  v.field("rate_hz", &GuestManifest::rate_hz, {.low = 1, .high = 1000}, "Rate of motions.");
  v.field("frames", &GuestManifest::frames, {.names = kFormats}, "Numbers of frames.");
  v.field("determinism", &GuestManifest::determinism, {.names = kDeterminisms}, "Degree to which motions repeat.");
  v.field("convention", &GuestManifest::convention, {}, "Axes and units.");
  v.field("characters", &GuestManifest::characters, {.max_count = 64, .required = true},
          "Characters; there is at least one.");
  v.field("actions", &GuestManifest::actions, {.max_count = 256, .required = true}, "Actions; there is at least one.");
  v.field("channels", &GuestManifest::channels, {.max_count = 64}, "Values per frame.");
  v.field("relations", &GuestManifest::relations, {.max_count = 4}, "Relations between motions that hold.");
}

bool GuestManifest::declares(std::string_view relation) const {
  return std::ranges::find(relations, relation) != relations.end();
}

namespace {

using json_fields::Json;

// The names of the joints that a character lists; "" for invalid entries, which the strict reader reports.
std::vector<std::string> names_in(const Json& joints) {
  std::vector<std::string> names;
  for (const Json& joint : joints) {
    const bool is_named = joint.is_object() && joint.contains("name") && joint["name"].is_string();
    names.push_back(is_named ? joint["name"].get<std::string>() : "");
  }
  return names;
}

template <class T>
Json listed(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(json_fields::Codec<T>::write(item, {}));
  return list;
}

// Adds the model's data to the character. Fields that the manifest gives itself stay.
void fill_character(const GuestCharacter& model, Json& character) {
  Json joints = listed(model.joints);
  if (const auto own = character.find("joints"); own != character.end())
    for (std::size_t j = 0; j < own->size(); ++j)
      if ((*own)[j].is_object()) joints[j].update((*own)[j]);
  character["joints"] = std::move(joints);
  if (character.contains("colliders")) return;
  character["colliders"] = listed(model.colliders);
  if (!character.contains("may_touch")) character["may_touch"] = listed(model.may_touch);
}

Result<Done> fill_from_model(const std::string& at, const ModelReader& models, Json& character) {
  const auto path = character.find("model");
  if (path == character.end() || !path->is_string() || path->get<std::string>().empty()) return Done{};
  if (!models) return Issue{"generator.no_models", at + "/model", "found a model, but no model files are read here"};
  const Result<GuestCharacter> read = models(path->get<std::string>());
  if (!read) return Issue{read.issue().code, at + "/model", read.issue().text};
  const auto own = character.find("joints");
  if (own == character.end() || !own->is_array() || own->empty()) {
    character.erase("joints");
    return fill_character(*read, character), Done{};
  }
  const Result<GuestCharacter> chosen = with_joints(*read, names_in(*own));
  if (!chosen) return Issue{chosen.issue().code, at + chosen.issue().pointer, chosen.issue().text};
  return fill_character(*chosen, character), Done{};
}

Result<Json> filled_from_models(Json manifest, const ModelReader& models) {
  if (!manifest.is_object() || !manifest.contains("characters") || !manifest["characters"].is_array()) return manifest;
  Json& characters = manifest["characters"];
  for (std::size_t c = 0; c < characters.size(); ++c) {
    if (!characters[c].is_object()) continue;
    const Result<Done> filled = fill_from_model("/characters/" + std::to_string(c), models, characters[c]);
    if (!filled) return filled.issue();
  }
  return manifest;
}

}  // namespace

Result<GuestManifest> parse_manifest(std::string_view json, const ModelReader& models) {
  Result<Json> tree = json_fields::parse_document(json);
  if (!tree) return tree.issue();
  const Result<Json> filled = filled_from_models(std::move(tree).value(), models);
  if (!filled) return filled.issue();
  Result<GuestManifest> manifest = json_fields::read_tree<GuestManifest>(*filled, "generator");
  if (!manifest) return manifest;
  if (const Result<Done> sound = check_manifest(*manifest); !sound) return sound.issue();
  return manifest;
}

std::string manifest_schema() { return json_fields::write_schema<GuestManifest>("contort.generator/1: manifest"); }

std::string print_manifest(const GuestManifest& manifest) { return json_fields::write_canonical(manifest); }

std::string manifest_hash(const GuestManifest& manifest) {
  GuestManifest same = manifest;
  same.build.clear(), same.token.clear();
  for (GuestCharacter& character : same.characters) character.model.clear();
  return content_id(json_fields::write_pretty(same)).substr(0, 16);
}

}  // namespace contort
