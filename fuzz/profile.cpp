#include "fuzz/profile.h"

#include <algorithm>
#include <set>

#include "generator/actions/action.h"
#include "generator/core/files.h"
#include "generator/core/json_fields.h"

namespace contort {

namespace {

const json_fields::Rule kNames{.max_count = 1000};
const json_fields::Rule kOdds{.low = 0, .high = 1};
const json_fields::Rule kActionFrames{.low = 1, .high = 600};

std::vector<Profile> make_built_in() {
  Profile nightly;
  nightly.name = "nightly";
  nightly.about = "Everything, for an hour.";
  nightly.time = "1h";
  Profile pr;
  pr.name = "pr";
  pr.about = "Everything, for as long as a pull request may wait.";
  pr.time = "5m";
  Profile smoke;
  smoke.name = "smoke";
  smoke.about = "Does it run at all? 256 cases.";
  smoke.cases = 256;
  Profile tame;
  tame.name = "tame";
  tame.about = "The human, on level ground, slowly and well within its ranges: what is found here is a fault.";
  tame.characters = {"human"};
  tame.grounds = {"plane"};
  tame.swaps = tame.objects = tame.interrupts = tame.obstacles = tame.tracking = tame.dynamic = 0.0;
  tame.impacts = 0;
  tame.speeds = false;
  tame.shortest_frames = 60;
  tame.longest_frames = 120;
  tame.range = 0.5;
  return {nightly, pr, smoke, tame};
}

}  // namespace

template <class V>
void fields(V& v, const Profile*) {
  using json_fields::Text;
  v.constant("format", "contort.profile/1");
  v.field("name", &Profile::name, {.required = true}, "For reports.");
  v.field("about", &Profile::about, {.text = Text::prose, .may_be_empty = true}, "What it is for, in a sentence.");
  v.field("characters", &Profile::characters, kNames, "Characters that are drawn; empty: all.");
  v.field("slots", &Profile::slots, kNames, "Slots whose parts move by themselves; empty: all.");
  v.field("actions", &Profile::actions, kNames, "Actions that are drawn; empty: all.");
  v.field("grounds", &Profile::grounds, kNames, "plane, slope, steps, heights; empty: all.");
  v.field("swaps", &Profile::swaps, kOdds, "Odds that a slot gets another part than its own.");
  v.field("objects", &Profile::objects, kOdds, "Odds that an object is carried.");
  v.field("interrupts", &Profile::interrupts, kOdds, "Odds of interrupts.");
  v.field("obstacles", &Profile::obstacles, kOdds, "Odds of an obstacle.");
  v.field("tracking", &Profile::tracking, kOdds, "Odds of the mode tracking.");
  v.field("dynamic", &Profile::dynamic, kOdds, "Odds of the mode dynamic.");
  v.field("impacts", &Profile::impacts, {.low = 0, .high = 2}, "Blows in a dynamic spec, at most.");
  v.field("speeds", &Profile::speeds, {}, "Whether actions and clips are played at other speeds, or stretched.");
  v.field("shortest_frames", &Profile::shortest_frames, kActionFrames, "Shortest action.");
  v.field("longest_frames", &Profile::longest_frames, kActionFrames, "Longest action.");
  v.field("range", &Profile::range, {.low = 0.01, .high = 1},
          "Poses are drawn from this middle share of every joint's range.");
  v.field("guided", &Profile::guided, kOdds, "Share of the cases that are mutations of one that came near a limit.");
  v.field("uniform", &Profile::uniform, kOdds,
          "Share of the others that are drawn evenly; the rest has corner values, features left out, both or neither.");
  v.field("cases", &Profile::cases, {.low = 0, .high = 0x1p53}, "Of a run, unless the command line says; 0: no opinion.");
  v.field("time", &Profile::time, {.may_be_empty = true}, "The same as a time: 45s, 10m, 2h.");
}

std::span<const Profile> built_in_profiles() {
  static const std::vector<Profile> profiles = make_built_in();
  return profiles;
}

Result<Profile> parse_profile(std::string_view json) {
  Result<Profile> profile = json_fields::read_document<Profile>(json, "profile");
  if (profile && profile->longest_frames < profile->shortest_frames)
    return Issue{"profile.no_range", "/longest_frames", "the longest action is shorter than the shortest"};
  if (profile && profile->tracking + profile->dynamic > 1.0)
    return Issue{"profile.no_odds", "/dynamic", "the odds of tracking and dynamic add up to more than 1"};
  return profile;
}

std::string print_profile(const Profile& profile) { return json_fields::write_pretty(profile); }
std::string profile_schema() { return json_fields::write_schema<Profile>("Contort fuzzing profile"); }

Result<Profile> load_profile(const std::string& name_or_path) {
  for (const Profile& profile : built_in_profiles())
    if (profile.name == name_or_path) return profile;
  if (name_or_path.find_first_of("./") == std::string::npos)
    return Issue{"profile.unknown", "",
                 "no profile is called \"" + name_or_path + "\"; there are nightly, pr, smoke, tame, and files"};
  const Result<std::string> text = read_regular_file(name_or_path, json_fields::kMaxDocumentBytes);
  if (!text) return text.issue();
  Result<Profile> profile = parse_profile(*text);
  if (profile) return profile;
  Issue issue = profile.issue();
  issue.text = name_or_path + ": " + issue.text;
  return issue;
}

namespace {

Result<Done> check_known(const std::vector<std::string>& names, const std::set<std::string>& known,
                         const std::string& field) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!known.contains(names[i]))
      return Issue{"profile.unknown_name", "/" + field + "/" + std::to_string(i),
                   json_fields::quoted(names[i]) + " is none of the library's " + field};
  return Done{};
}

}  // namespace

Result<Done> validate(const Profile& profile, const Library& library) {
  std::set<std::string> characters, slots, actions;
  for (const auto& [name, desc] : library.characters) {
    characters.insert(name);
    for (const SlotDesc& slot : desc.slots) slots.insert(slot.name);
  }
  for (const ActionDef& action : all_actions()) actions.insert(std::string(action.name));
  for (const ActionDesc& action : library.actions) actions.insert(action.name);
  for (const auto& [names, known, field] :
       {std::tuple(&profile.characters, &characters, "characters"), std::tuple(&profile.slots, &slots, "slots"),
        std::tuple(&profile.actions, &actions, "actions")})
    if (const Result<Done> all = check_known(*names, *known, field); !all) return all;
  return check_known(profile.grounds, {"plane", "slope", "steps", "heights"}, "grounds");
}

}  // namespace contort
