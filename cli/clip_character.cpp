#include "cli/clip_character.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

// Returns the map that `import` wrote beside the character, or "".
Result<std::string> own_map(const std::string& character, const Context& context) {
  std::error_code error;
  for (const std::string& folder : context.sources.libraries)
    if (const std::string path = folder + "/maps/" + character + ".json";
        is_file_name(character) && std::filesystem::exists(path, error)) {
      const Result<Done> inside = check_inside(folder, path);
      return inside ? Result<std::string>(path) : inside.issue();
    }
  return std::string();
}

Result<JointMap> read_map(const std::string& path) {
  if (path.empty()) return JointMap{};
  const Result<std::string> text = read_json_file(path, "a map of joints (JSON)");
  if (!text) return text.issue();
  Result<JointMap> map = parse_joint_map(*text);
  if (!map) return Issue{map.issue().code, map.issue().pointer, path + ": " + map.issue().text};
  return map;
}

Result<Done> check_joints(const ClipCharacter& on) {
  for (const auto& [node, joint] : on.map.joints)
    if (on.character->find_joint(joint) < 0)
      return map_issue(
          node, "unknown_joint",
          "the character " + on.character->name() + " has no joint " + json_fields::quoted(joint));
  for (const auto& [name, value] : on.map.values)
    if (!value.joint.empty() && on.character->find_joint(value.joint) < 0)
      return Issue{"map.unknown_joint", "/values/" + name + "/joint",
                   "the character " + on.character->name() + " has no joint " + json_fields::quoted(value.joint)};
  const auto& [x, y, z, w] = on.map.root_rotation;
  if (std::fabs(x * x + y * y + z * z + w * w - 1.0) > 0.01)
    return Issue{"map.bad_rotation", "/root_rotation", "found a quaternion x y z w whose length is not 1"};
  return Done{};
}

// If a joint misses more of its node's rotation than this, its coordinates may jump although the node does not.
constexpr double kNotFollowed_rad = 30.0 * kRadPerDeg;

bool turns(const Joint& joint) { return joint.kind == JointKind::hinge || joint.kind == JointKind::ball; }

}  // namespace

Issue map_issue(const std::string& node, std::string_view code, std::string text) {
  json_fields::ReadContext context("map");
  context.push("joints");
  context.push(node);
  context.fail(code, std::move(text));
  return context.take_issue();
}

Issue in_map(const std::string& map, const Issue& issue) {
  return issue.code.starts_with("map.") && !map.empty() ? about_file(map, issue) : issue;
}

Result<ClipCharacter> load_clip_character(const std::string& name, const std::string& map, Context& context) {
  ClipCharacter out;
  const Result<std::string> file = map.empty() ? own_map(name, context) : map;
  if (!file) return file.issue();
  Result<JointMap> read = read_map(*file);
  if (!read) return read.issue();
  out.map = std::move(read).value(), out.map_file = *file;
  if (name.empty()) return out;
  const Library* library = context.load_library();
  if (library == nullptr) return Issue{"library.unreadable", "", "the library could not be read"};
  Result<Character> character = build_character({name, {}, {}}, *library);
  if (!character) return character.issue();
  out.character = std::make_shared<const Character>(std::move(character).value());
  if (const Result<Done> known = check_joints(out); !known) return in_map(out.map_file, known.issue());
  return out;
}

std::map<std::string, double> speed_limits_of(const ClipCharacter& on) {
  std::map<std::string, double> limits;
  if (!on.character) return limits;
  for (const Joint& joint : on.character->joints())
    if (turns(joint)) limits[joint.name] = joint.max_speed;
  for (const auto& [node, name] : on.map.joints)
    if (const Joint& joint = on.character->joint(on.character->find_joint(name)); turns(joint))
      limits[node] = joint.max_speed;
  return limits;
}

JudgedElsewhere judged_elsewhere(const ClipCharacter& on, const Conversion& made, const Animation& animation,
                                 const AssetClip& clip) {
  JudgedElsewhere out;
  for (const FollowedNode& f : made.followed) {
    const bool has_channel = std::ranges::any_of(clip.channels, [&](const AssetChannel& channel) {
      return channel.node == f.node && channel.path == ChannelPath::rotation;
    });
    for (int joint = std::max(f.joint, 1); joint < f.joint + f.hinges; ++joint) {
      const std::string& name = on.character->joint(joint).name;
      if (has_channel) out.in_channels.insert(name);
      if (f.missed_rad > kNotFollowed_rad) out.not_followed.insert(name);
    }
  }
  if (animation.take)
    out.in_file = subjects_with_declared_range(animation.take->skeleton, *on.character, on.map.values);
  return out;
}

}  // namespace contort::cli
