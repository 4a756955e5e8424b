// The manifest of a generator that is a program of its own (contort.generator/1, docs/reference/guests.md), as plain
// values. Positions, axes and rotations are in the generator's own convention.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/core/math.h"
#include "model/core/result.h"
#include "model/motion/intent.h"

namespace contort {

enum class Determinism { exact, history, noisy };
enum class FrameFormat { f32, f64 };
enum class Axis { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };
enum class Hand { right, left };

struct GuestConvention {
  Axis up = Axis::plus_y;
  Axis forward = Axis::plus_z;
  double unit_m = 1.0;  // metres of one unit of length, > 0
  Hand handed = Hand::right;
  bool operator==(const GuestConvention&) const = default;
};

// A single number applies to all components.
using NumberOrTwo = std::variant<double, std::array<double, 2>>;
using NumberOrThree = std::variant<double, Vec3>;

enum class GuestJointType { ball, hinge, fixed };

// The coupling of a hinge to another one: its angle from rest is multiplier * the leader's angle from rest + offset.
struct GuestFollow {
  std::string joint{};  // the leader
  double multiplier = 1.0;
  double offset_deg = 0.0;
  bool operator==(const GuestFollow&) const = default;
};

struct GuestJoint {
  std::string name;
  std::string parent;  // "" for the first joint, which is the root
  std::string slot;    // "": that of the parent
  Vec3 position{0.0};  // in the frame of the parent
  std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};  // x y z w
  GuestJointType type = GuestJointType::ball;
  Vec3 axis{0.0, 1.0, 0.0};
  double low_deg = -180.0;
  double high_deg = 180.0;
  NumberOrTwo swing_deg = 180.0;  // about swing_axis, and at a right angle to it and to the axis
  std::optional<Vec3> swing_axis{};
  Vec3 swing_center_deg{0.0};  // rotation vector: the middle of the swing relative to rest
  double max_speed_deg_s = 720.0;
  std::string body{};  // name of the body that moves with the joint; "": the joint's name
  std::optional<GuestFollow> follows{};
  bool operator==(const GuestJoint&) const = default;
};

enum class GuestShape { capsule, box };

struct GuestCollider {
  std::string name;
  std::string joint;
  GuestShape type = GuestShape::capsule;
  Vec3 from{0.0};  // end of a capsule; if both ends are equal, it is a sphere
  Vec3 to{0.0};
  double radius = 0.05;
  Vec3 center{0.0};  // centre of a box
  Vec3 half{0.05};
  std::array<double, 4> rotation{0.0, 0.0, 0.0, 1.0};  // x y z w
  bool operator==(const GuestCollider&) const = default;
};

struct GuestCharacter {
  std::string name;
  std::vector<GuestJoint> joints;
  std::vector<GuestCollider> colliders;
  std::map<std::string, std::vector<std::string>> parts;  // by slot, the first is the default
  std::vector<std::array<std::string, 2>> may_touch{};    // names of colliders
  // Pairs of left and right joints. All other joints are in the middle.
  std::map<std::string, std::string> mirror{};
  std::string model{};  // file with joints and colliders; "": the manifest has them all
  bool operator==(const GuestCharacter&) const = default;
};

enum class GuestParamType { number, integer, flag, choice, vec3 };

// The value of a parameter for the other side of the figure: the same or the opposite one (a vec3 is reflected).
enum class OtherSide { by_type, same, opposite };

using GuestValue = std::variant<double, Vec3, std::string, bool>;

struct GuestParam {
  GuestParamType type = GuestParamType::number;
  NumberOrThree low = 0.0;
  NumberOrThree high = 1.0;
  std::optional<GuestValue> preset;  // "default"
  std::vector<std::string> choices;
  std::vector<GuestValue> special;
  OtherSide mirror = OtherSide::by_type;  // vec3: opposite; all others: same
  std::string help;
  bool operator==(const GuestParam&) const = default;
};

enum class Effect { continuous, cut, rest, equals, none };

struct GuestGoal {
  std::string param;  // a vec3, in world coordinates
  std::string tip;    // a joint
  double within = 0.001;
  bool operator==(const GuestGoal&) const = default;
};

struct GuestAction {
  std::string name;
  std::string help;
  std::vector<std::string> slots;  // empty: the root's slot
  Layer layer = Layer::overwrite;
  std::array<double, 2> duration_s{0.1, 1.5};
  std::array<double, 2> blend_in_s{0.0, 0.0};
  std::array<double, 2> blend_out_s{0.0, 0.0};
  Effect effect = Effect::continuous;
  std::map<std::string, GuestParam> params;
  std::optional<GuestGoal> goal;
  std::optional<double> returns_s{};  // from this time after its end on, the motion equals one without the action
  std::string mirror{};               // the mirrored action, such as "wave_right" for "wave_left"; "": the action
                                      // itself
  bool travels = false;               // while it is in force the root may jump, as in a loop of a walk
  bool operator==(const GuestAction&) const = default;
};

enum class ChannelType { number, flag, text };

struct GuestChannel {
  std::string name;
  ChannelType type = ChannelType::number;
  std::string contact{};  // for a flag: the joint that stands still in the world while the flag is set
  bool operator==(const GuestChannel&) const = default;
};

struct GuestManifest {
  int contort = 0;  // 1
  std::string name;
  std::string build;
  std::string token;
  double rate_hz = 60.0;
  FrameFormat frames = FrameFormat::f64;
  Determinism determinism = Determinism::exact;
  GuestConvention convention;
  std::vector<GuestCharacter> characters;
  std::vector<GuestAction> actions;
  std::vector<GuestChannel> channels;
  std::vector<std::string> relations;  // names from kRelations
  bool operator==(const GuestManifest&) const = default;

  bool declares(std::string_view relation) const;
};

inline constexpr std::string_view kRelations[] = {"history", "rate", "gain", "mirror"};

// Reads a character's model file. Positions, axes and rotations are those of the file, which must be in the manifest's
// convention.
using ModelReader = std::function<Result<GuestCharacter>(const std::string& path)>;

// Checks the text, the limits of each field, and that names refer to existing items. A character with a model gets all
// joints of the model, or only those that it lists; the fields that it gives for a joint replace those of the model. It
// gets the model's colliders unless it lists its own. Codes json.* and generator.*, generator.no_models if no reader is
// given, and the codes of the reader.
Result<GuestManifest> parse_manifest(std::string_view json, const ModelReader& models = {});
std::string print_manifest(const GuestManifest& manifest);  // one line
std::string manifest_schema();

// Hash of the canonical text without build, token and names of models: 16 hex digits. Another hash means another
// generator.
std::string manifest_hash(const GuestManifest& manifest);

}  // namespace contort
