#include "cli/check_clips.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "checks/clip_speed.h"
#include "checks/dof_limits.h"
#include "checks/joint_map.h"
#include "checks/loop_seam.h"
#include "checks/part_gap.h"
#include "checks/waive.h"
#include "cli/clip_report.h"
#include "cli/print.h"
#include "model/character/character.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

struct Checked {
  std::vector<ClipReport> clips;
  std::vector<Unreadable> unreadable;
  std::set<std::string> unmatched;  // nodes of the map that were in no file
  std::vector<WaiverUse> waivers;
  std::size_t waived = 0;
};

Issue map_issue(const std::string& node, std::string_view code, std::string text) {
  json_fields::ReadContext context("map");
  context.push("joints");
  context.push(node);
  context.fail(code, std::move(text));
  return context.take_issue();
}

// The map that `import` left beside the character, or "".
Result<std::string> own_map(const std::string& character, const Context& context) {
  std::error_code error;
  for (const std::string& folder : context.library_folders)
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

// Joints of the character that turn, by name.
Result<SpeedLimits> limits_of(const ClipCheckOptions& options, const JointMap& map, Context& context) {
  SpeedLimits limits{options.max_speed_deg_s * kRadPerDeg, {}, {}};
  Result<CheckSettings> settings = context.load_settings();
  if (!settings) return settings.issue();
  limits.settings = std::move(settings).value();
  if (options.character.empty()) return limits;
  const Library* library = context.load_library();
  if (library == nullptr) return Issue{"library.unreadable", "", "the library could not be read"};
  const Result<Character> character = build_character({options.character, {}, {}}, *library);
  if (!character) return character.issue();
  for (const Joint& joint : character->joints())
    if (joint.kind == JointKind::hinge || joint.kind == JointKind::ball) limits.of_node[joint.name] = joint.max_speed;
  std::map<std::string, double> mapped;
  for (const auto& [node, joint] : map.joints) {
    const auto found = limits.of_node.find(joint);
    if (found == limits.of_node.end())
      return map_issue(
          node, "unknown_joint",
          "the character " + options.character + " has no joint " + json_fields::quoted(joint) + " that turns");
    mapped[node] = found->second;
  }
  for (const auto& [node, limit] : mapped) limits.of_node[node] = limit;
  return limits;
}

void forget_matched(const Asset& asset, std::set<std::string>& unmatched) {
  for (const AssetNode& node : asset.nodes) {
    unmatched.erase(node.label);
    unmatched.erase(node.name);
  }
}

// Leaves those findings that no waiver hides.
template <class Item, class FindingOf>
void keep_open(const CheckSettings& settings, std::vector<Item>& items, FindingOf finding_of, Checked& out) {
  std::vector<Finding> findings;
  for (const Item& item : items) findings.push_back(finding_of(item));
  const Waived waived = waive(settings.waivers, findings, {}, settings.today);
  std::size_t i = 0;
  std::erase_if(items, [&](const Item&) { return waived.by[i++] >= 0; });
  out.waived += i - items.size();
  add_uses(waived.uses, out.waivers);
}

void set_waived_apart(const CheckSettings& settings, ClipReport& report, Checked& out) {
  keep_open(
      settings, report.speeds.findings, [](const ClipFinding& f) { return f.finding; }, out);
  for (std::vector<Finding>* found : {&report.seams, &report.gaps})
    keep_open(
        settings, *found, [](const Finding& f) { return f; }, out);
  if (report.limits)
    keep_open(
        settings, report.limits->findings, [](const Finding& f) { return f; }, out);
}

const AssetClip& clip_of(const Asset& asset, const std::string& label) {
  return *std::ranges::find_if(asset.clips, [&](const AssetClip& clip) { return clip.label == label; });
}

void check_file(const std::string& file, const ClipCheckOptions& options, const SpeedLimits& limits, Checked& out) {
  const Result<Animation> animation = read_animation(file, options.animation);
  if (!animation) return out.unreadable.push_back({file, animation.issue()});
  forget_matched(animation->asset, out.unmatched);
  for (ClipSpeeds& speeds : check_clip_speeds(animation->asset, limits, options.clip)) {
    const AssetClip& clip = clip_of(animation->asset, speeds.clip);
    ClipReport report{file, std::move(speeds), {}, {}, {}, options.animation.rate_hz, 0};
    if (!options.loops.empty() && matches(options.loops, clip.label))
      report.seams = check_loop_seam(animation->asset, clip, limits.settings);
    if (options.max_gap_m) report.gaps = check_part_gap(animation->asset, clip, *options.max_gap_m, limits.settings);
    if (const std::optional<Take>& take = animation->take; take) {
      report.limits = check_dof_limits(take->skeleton, take->motion, limits.settings);
      report.first_frame = take->motion.first_frame;
    }
    set_waived_apart(limits.settings, report, out);
    out.clips.push_back(std::move(report));
  }
}

// For the last line, where there are waivers at all.
std::string waived_count(const CheckSettings& settings, const Checked& checked) {
  return settings.waivers.empty() ? "" : " waived=" + std::to_string(checked.waived);
}

// Whether nothing can be said of all that was to be checked.
bool is_incomplete(const ClipCheckOptions& options, const Checked& checked) {
  return !checked.unreadable.empty() && (!options.allow_unreadable || checked.clips.empty());
}

std::string count_unreadable(const Checked& checked, std::size_t files) {
  return std::to_string(checked.unreadable.size()) + " of " + std::to_string(files) + " files cannot be read";
}

void print_waivers(const CheckSettings& settings, const Checked& checked) {
  for (const std::string& line : waiver_lines(settings, checked.waivers)) std::printf("%s\n", line.c_str());
}

void print_one(const ClipCheckOptions& options, const CheckSettings& settings, const Checked& checked) {
  if (options.json) return print_json(options.files.front(), checked.clips, waivers_json(settings, checked.waivers));
  for (const ClipReport& clip : checked.clips) print_clip(clip);
  print_waivers(settings, checked);
  print_result(count_findings(checked.clips), checked.clips.size(), "", waived_count(settings, checked));
}

void print_all(const ClipCheckOptions& options, const CheckSettings& settings, const Checked& checked,
               std::size_t files) {
  if (options.json) return print_json(checked.clips, checked.unreadable, waivers_json(settings, checked.waivers));
  for (const ClipReport& clip : checked.clips) print_clip_line(clip);
  for (const auto& [file, issue] : checked.unreadable)
    std::printf("%s: unreadable: %s\n", printable(file).c_str(), printable(to_line(issue)).c_str());
  print_waivers(settings, checked);
  const std::string missing = is_incomplete(options, checked) ? count_unreadable(checked, files) : "";
  print_result(count_findings(checked.clips), checked.clips.size(), missing,
               waived_count(settings, checked) + " files=" + std::to_string(files) +
                   " unreadable=" + std::to_string(checked.unreadable.size()));
}

// What stops the command before anything is printed: nothing to judge, or a map that does not fit.
Result<Done> judge_input(const ClipCheckOptions& options, const Checked& checked) {
  if (!options.all_clips && !checked.unreadable.empty())
    return about_file(checked.unreadable.front().file, checked.unreadable.front().issue);
  if (!checked.unmatched.empty() && !checked.clips.empty())
    return map_issue(*checked.unmatched.begin(), "unknown_node", "no file has a node of this name");
  if (!checked.clips.empty() || !checked.unreadable.empty()) return Done{};
  const std::string where = options.files.size() == 1 ? options.files.front() : "none of the files";
  return Issue{"check.no_clip", "",
               where + (options.clip.empty() ? " holds no animation" : " holds no clip \"" + options.clip + "\"")};
}

// Names the file of the map in an issue that is about the map.
Issue in_map(const std::string& map, const Issue& issue) {
  return issue.code.starts_with("map.") && !map.empty() ? about_file(map, issue) : issue;
}

void print_pace(std::size_t clips, std::chrono::steady_clock::time_point start) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::fprintf(stderr, "%zu clips in %.2f s: %.1f clips per second\n", clips, seconds,
               static_cast<double>(clips) / std::max(seconds, 1e-9));
}

}  // namespace

void check_clips(const ClipCheckOptions& options, Context& context) {
  const auto start = std::chrono::steady_clock::now();
  const Result<std::string> map_file = options.map.empty() ? own_map(options.character, context) : options.map;
  if (!map_file) return context.fail(map_file.issue());
  const std::string& map_path = *map_file;
  const Result<JointMap> map = read_map(map_path);
  if (!map) return context.fail(map.issue());
  const Result<SpeedLimits> limits = limits_of(options, *map, context);
  if (!limits) return context.fail(in_map(map_path, limits.issue()));
  Checked checked;
  const std::vector<std::string> files =
      options.all_clips ? expand_animations(options.files, checked.unreadable) : options.files;
  const std::size_t count = files.size() + checked.unreadable.size();
  if (!options.map.empty())  // an own map may say more than the file has
    for (const auto& entry : map->joints) checked.unmatched.insert(entry.first);
  for (const std::string& file : files) check_file(file, options, *limits, checked);
  if (const Result<Done> fit = judge_input(options, checked); !fit) return context.fail(in_map(map_path, fit.issue()));
  context.exit_code = count_findings(checked.clips) > 0 ? kFindings : checked.clips.empty() ? kBadInput : kClean;
  if (!options.all_clips) return print_one(options, limits->settings, checked);
  std::stable_sort(checked.clips.begin(), checked.clips.end(), is_worse);
  print_all(options, limits->settings, checked, count);
  if (is_incomplete(options, checked))
    context.fail({"check.unreadable", "",
                  count_unreadable(checked, count) + ": the list says why; --allow-unreadable lets the others decide"});
  print_pace(checked.clips.size(), start);
}

}  // namespace contort::cli
