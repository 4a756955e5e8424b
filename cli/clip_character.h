// The character on which clips are judged, and the map from nodes of a file to its joints.
#pragma once

#include <memory>
#include <string>

#include "checks/clip_speed.h"
#include "checks/joint_map.h"
#include "checks/judge_clip.h"
#include "cli/animation.h"
#include "cli/commands.h"
#include "guest/finished_file.h"
#include "model/character/character.h"

namespace contort::cli {

struct ClipCharacter {
  std::shared_ptr<const Character> character;  // null: clips are judged without one
  JointMap map;
  std::string map_file;  // "" if the character has no map
};

// Loads a character; `name` is "" for none. If `map` is "", the map is used that `import` wrote beside the character,
// if there is one. Codes of build_character and parse_joint_map, and map.unknown_joint.
Result<ClipCharacter> load_clip_character(const std::string& name, const std::string& map, Context& context);

// Speed limits of nodes that have the name of a joint that turns, or are mapped to one.
std::map<std::string, double> speed_limits_of(const ClipCharacter& on);

// The joints that are judged elsewhere. Joints that share a node's rotation are treated alike.
JudgedElsewhere judged_elsewhere(const ClipCharacter& on, const Conversion& made, const Animation& animation,
                                 const AssetClip& clip);

// Makes an issue about a node of the map.
Issue map_issue(const std::string& node, std::string_view code, std::string text);

// Adds the map's file to an issue about the map.
Issue in_map(const std::string& map, const Issue& issue);

}  // namespace contort::cli
