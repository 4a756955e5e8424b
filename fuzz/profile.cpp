#include "fuzz/profile.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fuzz/profile_files.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "model/core/nearest.h"

namespace contort {

namespace {

const json_fields::Rule kNames{.max_count = 1000};
const json_fields::Rule kOdds{.low = 0, .high = 1};
const json_fields::Rule kActionFrames{.low = 1, .high = 600};

}  // namespace

template <class V>
void fields(V& v, const DrawRule*) {
  v.field("slots", &DrawRule::slots, kNames, "Slots to which the rule applies; empty: all.");
  v.field("actions", &DrawRule::actions, kNames, "Actions to which the rule applies; empty: all.");
  v.field("never", &DrawRule::never, {}, "Whether these actions are never drawn.");
  v.field("param", &DrawRule::param, {.may_be_empty = true},
          "A number or vector among the parameters, blend_in_frames or blend_out_frames: drawn from low to high only.");
  v.field("low", &DrawRule::low, {.low = -1000, .high = 1000, .max_count = 3},
          "Least value: one number, or three for a vector; one number counts for all three.");
  v.field("high", &DrawRule::high, {.low = -1000, .high = 1000, .max_count = 3}, "Greatest value, given like `low`.");
  v.field("weight", &DrawRule::weight, {.low = 0, .high = 100},
          "Factor by which these actions are drawn more often than others of their slot; 0: not set.");
}

template <class V>
void fields(V& v, const Profile*) {
  using json_fields::Text;
  v.constant("format", "contort.profile/1");
  v.field("name", &Profile::name, {.required = true}, "Name for reports.");
  v.field("about", &Profile::about, {.text = Text::prose, .may_be_empty = true},
          "Purpose of the profile, in one sentence.");
  v.field("base", &Profile::base, {.may_be_empty = true},
          "Built-in profile that gives the fields which the file leaves out; its rules come before those of the file.");
  v.field("characters", &Profile::characters, kNames, "Characters that are drawn; empty: all.");
  v.field("slots", &Profile::slots, kNames, "Slots whose parts move by themselves; empty: all.");
  v.field("actions", &Profile::actions, kNames, "Actions that are drawn; empty: all.");
  v.field("grounds", &Profile::grounds, kNames,
          "Kinds of ground that are drawn: plane, slope, steps, heights; empty: all.");
  v.field("swaps", &Profile::swaps, kOdds, "Probability that a slot gets another part than its default.");
  v.field("objects", &Profile::objects, kOdds, "Probability that an object is carried.");
  v.field("interrupts", &Profile::interrupts, kOdds, "Probability of interrupts.");
  v.field("obstacles", &Profile::obstacles, kOdds, "Probability of an obstacle.");
  v.field("tracking", &Profile::tracking, kOdds, "Probability of the mode tracking.");
  v.field("dynamic", &Profile::dynamic, kOdds, "Probability of the mode dynamic.");
  v.field("impacts", &Profile::impacts, {.low = 0, .high = 2}, "Greatest number of blows in a dynamic spec.");
  v.field("speeds", &Profile::speeds, {}, "Whether actions and clips are played at other speeds, or stretched.");
  v.field("overlaps", &Profile::overlaps, {},
          "Whether an action may take over a part that another one of its sequence still moves.");
  v.field("shortest_frames", &Profile::shortest_frames, kActionFrames, "Shortest duration of an action.");
  v.field("longest_frames", &Profile::longest_frames, kActionFrames, "Longest duration of an action.");
  v.field("wild_poses", &Profile::wild_poses, {},
          "Whether poses are drawn for legs and feet, and poses that put bodies into each other, the ground or a "
          "wall.");
  v.field("wild_loads", &Profile::wild_loads, {},
          "Whether loads are drawn that are too heavy for the joints that carry them, or for the mode tracking.");
  v.field("range", &Profile::range, {.low = 0.01, .high = 1},
          "Poses are drawn from this middle share of every joint's range.");
  v.field("rules", &Profile::rules, {.max_count = 1000}, "Rules that narrow the draws of some actions and slots.");
  v.field("staged", &Profile::staged, {},
          "Actions are tried alone first, then pairs and crowds of those that are clean; false: everything at once.");
  v.field("guided", &Profile::guided, kOdds,
          "Without stages: share of the cases that mutate an earlier case near a limit; the first 4,096 cases have "
          "fewer.");
  v.field("uniform", &Profile::uniform, kOdds,
          "Without stages: share of the other cases that are drawn uniformly; the rest is crowded, with corner values, "
          "features left out, both or neither.");
  v.field("cases", &Profile::cases, {.low = 0, .high = 0x1p53},
          "Number of cases of a run if the command line gives none; 0: not set.");
  v.field("time", &Profile::time, {.may_be_empty = true},
          "Duration of a run if the command line gives none: 45s, 10m, 2h.");
}

bool DrawRule::speaks_of(std::string_view slot, std::string_view action) const {
  const auto has = [](const std::vector<std::string>& names, std::string_view name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
  };
  return has(slots, slot) && has(actions, action);
}

bool Profile::never(std::string_view slot, std::string_view action) const {
  return std::ranges::any_of(rules, [&](const DrawRule& r) { return r.never && r.speaks_of(slot, action); });
}

int Profile::weight(std::string_view slot, std::string_view action) const {
  int last = 1;
  for (const DrawRule& rule : rules)
    if (rule.weight > 0 && rule.speaks_of(slot, action)) last = rule.weight;
  return last;
}

const DrawRule* Profile::rule_for(std::string_view slot, std::string_view action, std::string_view param) const {
  const DrawRule* last = nullptr;
  for (const DrawRule& rule : rules)
    if (rule.param == param && rule.speaks_of(slot, action)) last = &rule;
  return last;
}

namespace {

Result<Done> check_rule(const DrawRule& rule, const std::string& pointer) {
  if (int{rule.never} + int{rule.weight > 0} + int{!rule.param.empty()} != 1)
    return Issue{"profile.bad_rule", pointer, "a rule says never, or a weight, or the range of a param: one of these"};
  if (rule.param.empty()) return Done{};
  const auto is_count = [](std::size_t count) { return count == 1 || count == 3; };
  if (!is_count(rule.low.size()) || rule.low.size() != rule.high.size())
    return Issue{"profile.bad_rule", pointer + "/low", "low and high are one number each, or three each"};
  for (std::size_t i = 0; i < rule.low.size(); ++i)
    if (rule.low[i] > rule.high[i])
      return Issue{"profile.no_range", pointer + "/high/" + std::to_string(i), "high is less than low"};
  return Done{};
}

Result<Done> check(const Profile& profile) {
  if (profile.longest_frames < profile.shortest_frames)
    return Issue{"profile.no_range", "/longest_frames", "the longest action is shorter than the shortest"};
  if (profile.tracking + profile.dynamic > 1.0)
    return Issue{"profile.no_odds", "/dynamic", "the odds of tracking and dynamic add up to more than 1"};
  for (std::size_t i = 0; i < profile.rules.size(); ++i)
    if (const Result<Done> good = check_rule(profile.rules[i], "/rules/" + std::to_string(i)); !good) return good;
  return Done{};
}

Result<Profile> read_profile(std::string_view json, Profile base = {}) {
  return json_fields::read_document<Profile>(json, "profile", std::move(base));
}

const StockFile* built_in_file(const std::string& name) {
  const auto file = std::ranges::find(profile_files(), name + ".json", &StockFile::name);
  return file == profile_files().end() ? nullptr : &*file;
}

Issue unknown_profile(const std::string& name, const std::string& pointer) {
  std::string names;
  for (const StockFile& file : profile_files())
    names += (names.empty() ? "" : ", ") + std::string(file.name.substr(0, file.name.rfind('.')));
  return {"profile.unknown", pointer,
          "no profile is called " + json_fields::quoted(name) + "; there are " + names +
              (pointer.empty() ? ", and files" : "") + did_you_mean(name, names)};
}

Result<Profile> read_over_base(const std::string& name, std::string_view json) {
  const StockFile* file = built_in_file(name);
  if (file == nullptr) return unknown_profile(name, "/base");
  Profile base = parse_profile(file->text).value();
  const std::vector<DrawRule> first = std::exchange(base.rules, {});
  base.about.clear();
  Result<Profile> read = read_profile(json, std::move(base));
  if (!read) return read;
  Profile profile = std::move(read).value();
  profile.rules.insert(profile.rules.begin(), first.begin(), first.end());
  profile.base.clear();
  return profile;
}

}  // namespace

Result<Profile> parse_profile(std::string_view json) {
  Result<Profile> profile = read_profile(json);
  if (profile && !profile->base.empty()) profile = read_over_base(profile->base, json);
  if (profile)
    if (const Result<Done> good = check(*profile); !good) return good.issue();
  return profile;
}

std::span<const Profile> built_in_profiles() {
  static const std::vector<Profile> profiles = [] {
    std::vector<Profile> all;
    for (const StockFile& file : profile_files()) {
      Result<Profile> profile = parse_profile(file.text);
      if (!profile) throw std::logic_error(std::string(file.name) + ": " + to_line(profile.issue()));
      all.push_back(std::move(profile).value());
    }
    return all;
  }();
  return profiles;
}

std::string print_profile(const Profile& profile) { return json_fields::write_pretty(profile); }
std::string profile_schema() { return json_fields::write_schema<Profile>("Contort fuzzing profile"); }

Result<Profile> load_profile(const std::string& name_or_path) {
  for (const Profile& profile : built_in_profiles())
    if (profile.name == name_or_path) return profile;
  if (name_or_path.find_first_of("./") == std::string::npos) return unknown_profile(name_or_path, "");
  const Result<std::string> text = read_json_file(name_or_path, "a fuzzing profile (JSON)");
  if (!text) return text.issue();
  Result<Profile> profile = parse_profile(*text);
  if (profile) return profile;
  Issue issue = profile.issue();
  issue.text = name_or_path + ": " + issue.text;
  return issue;
}

}  // namespace contort
