// Refuses options without an effect, because their users expect one: a pattern, a rule or a rate that applies to no
// file. The error lists the possible values.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "checks/judge_clip.h"
#include "cli/animation.h"
#include "cli/check_clips.h"
#include "cli/clip_character.h"

namespace contort::cli {

// The clips, joints and files on which options had an effect, in all files.
struct Touched {
  std::vector<std::string> clips;  // labels, each once
  bool has_take = false;           // an .amc was read
  bool has_bvh = false;            // a .bvh was read
  bool was_gap_judged = false;
  std::set<std::string> patterns;  // patterns of --loops that matched a clip
  std::set<std::size_t> rules;     // rules of the settings that matched a subject
  std::set<std::string> subjects;  // subjects that rules could name
};

// Adds the items of one file to those of earlier files.
void add_touched(const Touched& file, Touched& out);

void note_clips(const Animation& animation, Touched& touched);

// Notes a clip after it was judged.
void note_judged(const AssetClip& clip, const Animation& animation, const ClipEvaluation& judged,
                 const ClipCharacter& on, const ClipCheckOptions& options, const CheckSettings& settings,
                 Touched& touched);

// The error that --clip names none of these clips. It lists their names, and the one that was probably meant. Code
// check.no_clip.
Issue no_such_clip(const std::string& where, const std::string& clip, const std::vector<std::string>& clips);

// Returns an issue with the code check.no_effect for the first option without an effect.
Result<Done> check_effects(const ClipCheckOptions& options, const std::string& settings_file,
                           const CheckSettings& settings, const Touched& touched);

}  // namespace contort::cli
