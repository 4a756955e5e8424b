// The choices that a fuzzing run draws from: characters, slots, actions, grounds, odds and ranges. A JSON file,
// contort.profile/1, or one of the built-in ones.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/generator.h"
#include "model/core/result.h"

namespace contort {

// Narrows the draws of some actions of some slots. If several rules apply, the last one counts.
struct DrawRule {
  std::vector<std::string> slots;    // empty: all
  std::vector<std::string> actions;  // empty: all
  bool never = false;                // these actions are not drawn for these slots
  std::string param;                 // a parameter of these actions ("speed_m_s"), or blend_in_frames or
                                     // blend_out_frames; empty: none
  std::vector<double> low;           // lowest values of the parameter, in its unit: one number, or three for a vector;
                                     // values beyond the range that an action declares are left out
  std::vector<double> high;
  int weight = 0;  // how often the actions are drawn, compared with 1 for other actions; 0: not set by this rule
  bool operator==(const DrawRule&) const = default;

  bool speaks_of(std::string_view slot, std::string_view action) const;
};

struct Profile {
  std::string name = "all";
  std::string about;                    // one sentence
  std::string base;                     // the built-in profile that a file extends; empty after reading
  std::vector<std::string> characters;  // names in the library; empty: all
  std::vector<std::string> slots;       // names of slots; empty: all
  std::vector<std::string> actions;     // empty: all
  std::vector<std::string> grounds;     // plane, slope, steps, heights; empty: all
  double swaps = 0.5;                   // odds that a slot gets a part other than its own
  double objects = 1.0 / 3.0;           // odds that an object is carried
  double interrupts = 1.0 / 3.0;
  double obstacles = 1.0 / 3.0;
  double tracking = 1.0 / 32.0;  // odds of the mode tracking; a simulated frame takes as long as three kinematic ones
  double dynamic = 1.0 / 32.0;
  int impacts = 2;                // greatest number of impacts in a dynamic spec
  bool speeds = true;             // clips and actions at other speeds, stretched clips
  bool overlaps = true;           // an action may take over a part that another one of its sequence still moves
  int shortest_frames = 6;        // shortest length of an action
  int longest_frames = 90;        // longest length of an action
  bool wild_poses = false;        // also draws poses of parts that stand on the ground, and poses in which bodies
                                  // collide
  bool wild_loads = false;        // also draws loads that are too heavy for the joints that carry them
  double range = 1.0;             // the middle fraction of every joint's range from which poses are drawn, (0, 1]
  std::vector<DrawRule> rules{};
  bool staged = true;             // draws single actions, then pairs and crowds of clean ones (fuzz/stages.h); false:
                                  // all at once
  // For runs that are not staged (fuzz/lineage.h). With guided 0 and uniform 1 there is no search.
  double guided = 0.5;    // fraction of cases, after the first few thousand, that are mutations of near misses
  double uniform = 0.02;  // fraction of the others that are drawn evenly
  std::int64_t cases = 0;         // cases of a run, unless the command line sets them; 0: not set
  std::string time;               // time of a run, unless the command line sets it: "45s", "10m", "2h"; "": not set
  bool operator==(const Profile&) const = default;

  bool never(std::string_view slot, std::string_view action) const;
  // Returns the weight of an action on a slot: that of the last rule about it, or 1.
  int weight(std::string_view slot, std::string_view action) const;
  // The last rule for this parameter, or null.
  const DrawRule* rule_for(std::string_view slot, std::string_view action, std::string_view param) const;
};

std::span<const Profile> built_in_profiles();

// A built-in profile by name, or a file. Codes profile.* and json.*.
Result<Profile> load_profile(const std::string& name_or_path);
// If the text names a base, fields that the text leaves out have the base's values, and its own rules come last.
Result<Profile> parse_profile(std::string_view json);
std::string print_profile(const Profile& profile);
std::string profile_schema();

// Refuses a profile that would test nothing and so look clean: names that the library does not have, a character that
// no action moves (profile.nothing_moves), rules for parameters that are not numbers or vectors, and ranges that a
// parameter does not have (profile.bad_rule, .no_range). `characters` are those that will be drawn.
Result<Done> validate(const Profile& profile, const std::vector<std::string>& characters, Generator& generator);

}  // namespace contort
