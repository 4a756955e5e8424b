#include "cli/no_effect.h"

#include <algorithm>

#include "model/core/files.h"
#include "model/core/json_value_fields.h"
#include "model/core/nearest.h"

namespace contort::cli {

namespace {

constexpr std::size_t kMostNamed = 12;  // greatest number of names in a message

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > kMostNamed) text += " and " + std::to_string(names.size() - kMostNamed) + " more";
  return text;
}

// Returns text such as "; did you mean "walk"?". Stars are removed before comparing with names.
std::string meant_text(std::string pattern, const std::vector<std::string>& names) {
  std::erase(pattern, '*');
  const std::string meant = nearest(pattern, names);
  return meant.empty() ? "" : "; did you mean " + json_fields::quoted(meant) + "?";
}

// Returns text such as "there are walk, run; did you mean …?".
std::string there_are(const std::string& pattern, const std::vector<std::string>& names) {
  return names.empty() ? "there are none" : "there are " + listed(names) + meant_text(pattern, names);
}

bool was_judged(const ClipEvaluation& judged, std::string_view check) {
  return std::ranges::find(judged.judged, check, &JudgedCheck::check) != judged.judged.end();
}

// All possible subjects of the check's findings in this clip.
std::vector<std::string> subjects_in(const CheckDef& check, const AssetClip& clip, const Animation& animation,
                                     const ClipCharacter& on) {
  std::vector<std::string> names;
  const bool is_of_channels = check.in_clip != nullptr || check.name == "angular_velocity" || check.name == "pop";
  if (is_of_channels)
    for (const AssetChannel& channel : clip.channels)
      names.push_back(animation.asset.nodes[static_cast<std::size_t>(channel.node)].label);
  if (check.in_clip != nullptr) names.push_back("figure");
  if (on.character)
    for (int i = 0; i < check.subject_count(*on.character); ++i) names.push_back(check.subject(*on.character, i).name);
  if (animation.take && check.name == "joint_range")
    for (const std::string& name : dof_subjects(animation.take->skeleton)) names.push_back(name);
  return names;
}

Issue no_effect(const std::string& what) { return {"check.no_effect", "", what}; }

Result<Done> check_rules(const std::string& file, const CheckSettings& settings, const Touched& touched) {
  for (std::size_t i = 0; i < settings.limits.size(); ++i) {
    const LimitRule& rule = settings.limits[i];
    if (!rule.phase.empty() || touched.rules.contains(i)) continue;  // clips have no phases
    const std::vector<std::string> subjects(touched.subjects.begin(), touched.subjects.end());
    return about_file(file, {"check.no_effect", "/limits/" + std::to_string(i),
                             "no subject of " + rule.check + " that was judged is " +
                                 json_fields::quoted(rule.subject) + "; " + there_are(rule.subject, subjects)});
  }
  return Done{};
}

}  // namespace

void add_touched(const Touched& file, Touched& out) {
  for (const std::string& clip : file.clips)
    if (std::ranges::find(out.clips, clip) == out.clips.end()) out.clips.push_back(clip);
  out.has_take |= file.has_take, out.has_bvh |= file.has_bvh;
  out.was_gap_judged |= file.was_gap_judged;
  out.patterns.insert(file.patterns.begin(), file.patterns.end());
  out.rules.insert(file.rules.begin(), file.rules.end());
  out.subjects.insert(file.subjects.begin(), file.subjects.end());
}

void note_clips(const Animation& animation, Touched& touched) {
  touched.has_take |= animation.take.has_value();
  for (const AssetClip& clip : animation.asset.clips)
    if (std::ranges::find(touched.clips, clip.label) == touched.clips.end()) touched.clips.push_back(clip.label);
}

void note_judged(const AssetClip& clip, const Animation& animation, const ClipEvaluation& judged,
                 const ClipCharacter& on, const ClipCheckOptions& options, const CheckSettings& settings,
                 Touched& touched) {
  for (const std::string& pattern : options.loops)
    if (matches(pattern, clip.label)) touched.patterns.insert(pattern);
  touched.was_gap_judged |= was_judged(judged, "part_gap");
  for (std::size_t i = 0; i < settings.limits.size(); ++i) {
    const LimitRule& rule = settings.limits[i];
    if (touched.rules.contains(i) || !was_judged(judged, rule.check)) continue;
    for (const std::string& subject : subjects_in(find_check(rule.check), clip, animation, on)) {
      if (matches(rule.subject, subject)) touched.rules.insert(i);
      touched.subjects.insert(subject);
    }
  }
}

Issue no_such_clip(const std::string& where, const std::string& clip, const std::vector<std::string>& clips) {
  return {"check.no_clip", "",
          where + " holds no clip " + json_fields::quoted(clip) + "; " + there_are(clip, clips)};
}

Result<Done> check_effects(const ClipCheckOptions& options, const std::string& settings_file,
                           const CheckSettings& settings, const Touched& touched) {
  for (const std::string& pattern : options.loops)
    if (!touched.patterns.contains(pattern))
      return no_effect("--loops " + json_fields::quoted(pattern) + " matches no clip; " +
                       there_are(pattern, touched.clips));
  if (!options.animation.skeleton.empty() && !touched.has_take)
    return no_effect("--skeleton is for an .amc, and none was checked");
  if (options.rate_hz && options.character.empty() && !touched.has_take && !touched.has_bvh)
    return no_effect(
        "--rate-hz sets the rate of an .amc or .bvh, and of motions of a --character; there is none, and other files say "
        "their own times");
  if (options.max_gap_m && !touched.was_gap_judged)
    return no_effect("--max-gap-m found no joint to judge: no joint hangs below a root's own");
  return check_rules(settings_file, settings, touched);
}

}  // namespace contort::cli
