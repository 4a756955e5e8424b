// The character that clips are judged on, and which node of a file is which of its joints.
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

// `name` "" for none; `map` "" for the map that `import` left beside the character, if there is one. Codes of
// build_character and parse_joint_map, and map.unknown_joint.
Result<ClipCharacter> load_clip_character(const std::string& name, const std::string& map, Context& context);

// Limits of nodes with the name of a joint that turns, or that are mapped to one.
std::map<std::string, double> speed_limits_of(const ClipCharacter& on);

// A joint goes with those that share its node's turn.
JudgedElsewhere judged_elsewhere(const ClipCharacter& on, const Conversion& made, const Animation& animation,
                                 const AssetClip& clip);

// An issue about a node of the map.
Issue map_issue(const std::string& node, std::string_view code, std::string text);

// Names the map's file in an issue that is about the map.
Issue in_map(const std::string& map, const Issue& issue);

}  // namespace contort::cli
