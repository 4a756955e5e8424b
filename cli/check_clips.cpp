#include "cli/check_clips.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <set>
#include <thread>

#include "checks/judge_clip.h"
#include "checks/waive.h"
#include "cli/accept_list.h"
#include "cli/check_table.h"
#include "cli/clip_character.h"
#include "cli/clip_feet_names.h"
#include "cli/clip_report.h"
#include "cli/clips_page.h"
#include "cli/no_effect.h"
#include "cli/print.h"
#include "cli/similar_names.h"
#include "cli/worst_moment.h"
#include "formats/detect/file_format.h"
#include "guest/finished_file.h"
#include "model/core/files.h"
#include "renders/measured_text.h"

namespace contort::cli {

namespace {

struct Checked {
  std::vector<ClipReport> clips;
  std::vector<Unreadable> unreadable;
  std::vector<Unreadable> skipped;  // files in folders that only look like animations
  std::vector<FileRemark> remarks;
  std::set<std::string> unmatched;  // nodes of the map that no file has
  Touched touched;
  std::vector<WaiverUse> waivers;
  std::size_t waived = 0;
  std::set<int> accepted_by;              // entries of the accept list that accepted a finding
  std::size_t accepted = 0;               // number of accepted findings
  std::vector<AcceptedFinding> findings;  // all findings, for writing an accept list
};

// The inputs that are the same for all files.
struct ClipJudging {
  const ClipCheckOptions& options;
  ClipCharacter on;
  SpeedLimits limits;
  Judge judge;
  AcceptList accept;
};

Result<ClipJudging> judging_of(const ClipCheckOptions& options, Context& context) {
  Result<ClipCharacter> on = load_clip_character(options.character, options.map, context);
  if (!on) return on.issue();
  Result<CheckSettings> settings = context.load_settings();
  if (!settings) return settings.issue();
  CheckSettings unwaived = *settings;  // findings of all sources are waived together
  unwaived.waivers.clear();
  SpeedLimits limits{options.max_speed_deg_s * kRadPerDeg, speed_limits_of(*on), std::move(settings).value()};
  Result<AcceptList> accept = read_accept_list(options.accept_list);
  if (!accept) return accept.issue();
  return ClipJudging{options, std::move(on).value(), std::move(limits), Judge(unwaived), std::move(accept).value()};
}

void forget_matched(const Asset& asset, std::set<std::string>& unmatched) {
  for (const AssetNode& node : asset.nodes) {
    unmatched.erase(node.label);
    unmatched.erase(node.name);
  }
}

// A robot's map names bodies too. Tables have no columns for those, so they are not reported as missing.
void forget_columns(const JointTable& table, const JointMap& map, std::set<std::string>& unmatched) {
  if (!map.values.empty()) unmatched.clear();
  for (const TableColumn& column : table.columns) unmatched.erase(column.name);
}

// Removes the findings that waivers hide.
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

// Removes the findings that are in the accept list.
template <class Item, class FindingOf>
void keep_unknown(const ClipJudging& with, const ClipReport& report, std::vector<Item>& items, FindingOf finding_of,
                  Checked& out) {
  const std::string file = name_in_accept_list(report.file, with.options.files);
  std::erase_if(items, [&](const Item& item) {
    const Finding& finding = finding_of(item);
    AcceptedFinding known{file, report.judged.speeds.clip, finding.check, finding.subject, ""};
    const int index = index_in(with.accept, known);
    if (index >= 0) known.reason = with.accept.accepted[static_cast<std::size_t>(index)].reason;
    out.findings.push_back(std::move(known));
    if (index >= 0) out.accepted_by.insert(index), ++out.accepted;
    return index >= 0;
  });
}

void set_accepted_apart(const ClipJudging& with, ClipReport& report, Checked& out) {
  if (with.options.accept_list.empty() && with.options.write_accept_list.empty()) return;
  const auto itself = [](const Finding& f) -> const Finding& { return f; };
  keep_unknown(
      with, report, report.judged.speeds.findings, [](const ClipFinding& f) -> const Finding& { return f.finding; },
      out);
  keep_unknown(with, report, report.judged.clip_findings, itself, out);
  keep_unknown(with, report, report.judged.motion_findings, itself, out);
  if (report.judged.limits) keep_unknown(with, report, report.judged.limits->findings, itself, out);
}

void set_waived_apart(const CheckSettings& settings, ClipReport& report, Checked& out) {
  keep_open(
      settings, report.judged.speeds.findings, [](const ClipFinding& f) { return f.finding; }, out);
  const auto itself = [](const Finding& f) { return f; };
  keep_open(settings, report.judged.clip_findings, [](const KeyFinding& f) -> const Finding& { return f; }, out);
  keep_open(settings, report.judged.motion_findings, itself, out);
  if (report.judged.limits) keep_open(settings, report.judged.limits->findings, itself, out);
}

void describe_motion_findings(const ClipJudging& with, ClipReport& report) {
  const Character* character = report.made ? report.made->character.get() : nullptr;
  for (const Finding& f : report.judged.motion_findings)
    report.motion_texts.push_back(
        failed_text({f.check, f.subject, f.unit, f.worst_margin}, character, with.limits.settings));
}

Result<Done> judge_on_character(ClipJudging& with, const Animation& animation, const AssetClip& clip,
                                ClipReport& report) {
  if (!with.on.character) return Done{};
  const Asset& asset = animation.asset;
  const Result<Conversion> made =
      convert({asset, clip, with.on.character, with.on.map.joints, with.options.rate_hz.value_or(0.0)});
  if (!made) return made.issue();
  add_motion(with.judge.evaluate(made->execution), judged_elsewhere(with.on, *made, animation, clip), report.judged);
  report.motion = motion_of_clip(asset, clip, *made);
  report.made = made->execution;
  return Done{};
}

Result<ClipReport> check_clip(const std::string& file, const Animation& animation, const AssetClip& clip,
                              ClipJudging& with) {
  if (animation.table)
    return check_table({file, animation, with.on, with.limits, with.options.animation}, with.judge);
  const bool is_loop = std::ranges::any_of(with.options.loops,
                                           [&](const std::string& pattern) { return matches(pattern, clip.label); });
  const std::vector<ClipFoot> feet = with.on.character ? std::vector<ClipFoot>() : feet_by_names(animation.asset);
  const ClipInput in{animation.asset, clip, with.limits.settings, is_loop, with.options.max_gap_m,
                     with.on.character ? nullptr : &feet};
  ClipReport report{file, {}, {}, with.options.animation.rate_hz, 0};
  if (const std::optional<Take>& take = animation.take; take) {
    const Capture capture{take->skeleton, take->motion};
    report.judged = judge_clip(in, with.limits, &capture);
    report.first_frame = take->motion.first_frame;
  } else {
    report.judged = judge_clip(in, with.limits, nullptr);
  }
  if (const Result<Done> moved = judge_on_character(with, animation, clip, report); !moved) return moved.issue();
  return report;
}

// Applies the map and the limits to nodes that have other prefixes in this file. Returns the number of these nodes.
std::size_t take_similar_names(const Asset& asset, ClipJudging& with, std::set<std::string>& unmatched) {
  const std::map<std::string, std::string> similar = similar_names(asset, with.on.map.joints);
  for (const auto& [node, name] : similar) {
    unmatched.erase(name);
    with.on.map.joints[node] = with.on.map.joints[name];
    if (const auto limit = with.limits.of_node.find(name); limit != with.limits.of_node.end())
      with.limits.of_node[node] = limit->second;
  }
  return similar.size();
}

void check_file(const std::string& file, const ClipJudging& for_all, Checked& out) {
  ClipJudging with = for_all;
  const Result<Animation> animation = read_animation(file, with.options.animation);
  if (!animation) return out.unreadable.push_back({file, animation.issue()});
  forget_matched(animation->asset, out.unmatched);
  if (animation->table) forget_columns(*animation->table, with.on.map, out.unmatched);
  const std::size_t similar = take_similar_names(animation->asset, with, out.unmatched);
  note_clips(*animation, out.touched);
  out.touched.has_bvh |= format_of_file(file) == FileFormat::bvh;
  for (const Remark& remark : animation->asset.remarks) out.remarks.push_back({file, remark});
  for (const AssetClip& clip : animation->asset.clips) {
    if (!with.options.clip.empty() && clip.name != with.options.clip && clip.label != with.options.clip) continue;
    Result<ClipReport> checked = check_clip(file, *animation, clip, with);
    if (!checked) return out.unreadable.push_back({file, checked.issue()});
    ClipReport report = std::move(checked).value();
    report.similar_names = similar;
    note_judged(clip, *animation, report.judged, with.on, with.options, with.limits.settings, out.touched);
    set_waived_apart(with.limits.settings, report, out);
    set_accepted_apart(with, report, out);
    describe_motion_findings(with, report);
    if (!with.options.report.empty()) report.worst_pose = worst_pose(with.on, *animation, clip, report);
    report.made.reset();
    out.clips.push_back(std::move(report));
  }
}

template <class T>
void append(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

// Adds the results of one file to those of earlier files.
void add_file(Checked file, Checked& out) {
  append(file.clips, out.clips);
  append(file.unreadable, out.unreadable);
  append(file.findings, out.findings);
  append(file.remarks, out.remarks);
  std::erase_if(out.unmatched, [&](const std::string& node) { return !file.unmatched.contains(node); });
  add_touched(file.touched, out.touched);
  add_uses(file.waivers, out.waivers);
  out.waived += file.waived, out.accepted += file.accepted;
  out.accepted_by.merge(file.accepted_by);
}

// Checks the files in parallel. The result is the same as without threads.
void check_files(const std::vector<std::string>& files, const ClipJudging& with, Checked& out) {
  std::vector<Checked> pieces(files.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < files.size(); i = next++) {
      pieces[i].unmatched = out.unmatched;
      check_file(files[i], with, pieces[i]);
    }
  };
  const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const std::size_t threads = static_cast<std::size_t>(with.options.jobs > 0 ? with.options.jobs : cores);
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(threads, files.size()); ++i) helpers.emplace_back(work);
    work();
  }
  for (Checked& piece : pieces) add_file(std::move(piece), out);
}

// Returns the counts for the last line, if there are waivers or an accept list.
std::string waived_count(const CheckSettings& settings, const ClipCheckOptions& options, const Checked& checked) {
  return (settings.waivers.empty() ? "" : " waived=" + std::to_string(checked.waived)) +
         (options.accept_list.empty() ? "" : " accepted=" + std::to_string(checked.accepted));
}

// Returns true if a part of the input could not be judged.
bool is_incomplete(const ClipCheckOptions& options, const Checked& checked) {
  return !checked.unreadable.empty() && (!options.allow_unreadable || checked.clips.empty());
}

std::string count_unreadable(const Checked& checked, std::size_t files) {
  return std::to_string(checked.unreadable.size()) + " of " + std::to_string(files) + " files cannot be read";
}

// Prints entries of the accept list that no finding matches: they are repaired, or are mistakes.
void print_waivers(const CheckSettings& settings, const AcceptList& accept, const Checked& checked) {
  for (const std::string& line : waiver_lines(settings, checked.waivers)) std::printf("%s\n", line.c_str());
  for (std::size_t i = 0; i < accept.accepted.size(); ++i)
    if (!checked.accepted_by.contains(static_cast<int>(i)))
      std::printf("accepted, and not found: %s\n", printable(accepted_text(accept.accepted[i])).c_str());
}

Result<Done> write_accepted(const ClipCheckOptions& options, const Checked& checked) {
  if (options.write_accept_list.empty()) return Done{};
  AcceptList list;
  for (const AcceptedFinding& finding : checked.findings)
    if (index_in(list, finding) < 0) list.accepted.push_back(finding);
  return write_file(options.write_accept_list, print_accept_list(list));
}

void print_one(const ClipJudging& with, const Checked& checked) {
  const ClipCheckOptions& options = with.options;
  const CheckSettings& settings = with.limits.settings;
  if (options.json)
    return print_json(options.files.front(), checked.clips, checked.remarks, waivers_json(settings, checked.waivers));
  for (const ClipReport& clip : checked.clips) print_clip(clip);
  for (const FileRemark& about : checked.remarks) std::printf("remark: %s\n", printable(about.remark.text).c_str());
  print_waivers(settings, with.accept, checked);
  print_judged(checked.clips);
  print_result(count_findings(checked.clips), checked.clips.size(), "", waived_count(settings, options, checked));
}

// Prints only some names, because folders may have thousands of files that are no animations.
void print_skipped(const std::vector<Unreadable>& skipped) {
  constexpr std::size_t kMostLines = 20;
  for (std::size_t i = 0; i < std::min(skipped.size(), kMostLines); ++i)
    std::printf("skipped: %s\n", printable(skipped[i].issue.text).c_str());
  if (skipped.size() > kMostLines)
    std::printf("skipped: %zu more files (--json lists them)\n", skipped.size() - kMostLines);
}

void print_all(const ClipJudging& with, const Checked& checked, std::size_t files) {
  const ClipCheckOptions& options = with.options;
  const CheckSettings& settings = with.limits.settings;
  if (options.json)
    return print_json({checked.clips, checked.unreadable, checked.skipped, checked.remarks},
                      waivers_json(settings, checked.waivers));
  for (const ClipReport& clip : checked.clips) print_clip_line(clip);
  for (const auto& [file, issue] : checked.unreadable)
    std::printf("%s: unreadable: %s\n", printable(file).c_str(), printable(to_line(issue)).c_str());
  print_skipped(checked.skipped);
  for (const FileRemark& about : checked.remarks)
    std::printf("%s: remark: %s\n", printable(about.file).c_str(), printable(about.remark.text).c_str());
  print_waivers(settings, with.accept, checked);
  print_judged(checked.clips);
  const std::string missing = is_incomplete(options, checked) ? count_unreadable(checked, files) : "";
  print_result(count_findings(checked.clips), checked.clips.size(), missing,
               waived_count(settings, options, checked) + " files=" + std::to_string(files) +
                   " unreadable=" + std::to_string(checked.unreadable.size()) +
                   (checked.skipped.empty() ? "" : " skipped=" + std::to_string(checked.skipped.size())));
}

// Returns mistakes that stop the command before anything is printed: nothing to judge, or a map that does not fit.
Result<Done> judge_input(const ClipCheckOptions& options, const Checked& checked) {
  const auto matches_nothing = [](const Unreadable& file) { return file.issue.code == "check.nothing_matches"; };
  const bool was_read = !checked.clips.empty() || std::ranges::any_of(checked.unreadable, matches_nothing);
  if (!checked.unmatched.empty() && was_read)
    return map_issue(*checked.unmatched.begin(), "unknown_node", "no file has a node of this name");
  if (!options.all_clips && !checked.unreadable.empty())
    return about_file(checked.unreadable.front().file, checked.unreadable.front().issue);
  if (!checked.clips.empty() || !checked.unreadable.empty()) return Done{};
  const std::string where = options.files.size() == 1 ? options.files.front() : "none of the files";
  if (!options.clip.empty() && !checked.touched.clips.empty())
    return no_such_clip(where, options.clip, checked.touched.clips);
  const std::string skipped =
      checked.skipped.empty() ? "" : "; skipped were " + std::to_string(checked.skipped.size()) + " other files, as " +
                                         checked.skipped.front().issue.text;
  return Issue{"check.no_clip", "", where + " holds no animation" + skipped};
}

// Does the same for options and rules without effect, and for clips of which nothing was judged.
Result<Done> judge_effects(const ClipCheckOptions& options, const std::string& settings_file,
                           const CheckSettings& settings, const Checked& checked) {
  if (checked.clips.empty()) return Done{};
  if (const Result<Done> effects = check_effects(options, settings_file, settings, checked.touched); !effects)
    return effects;
  const auto is_judged = [](const ClipReport& clip) {
    return clip.judged.channels > 0 || !clip.judged.clip_findings.empty();
  };
  if (std::ranges::any_of(checked.clips, is_judged)) return Done{};
  return Issue{"check.nothing_judged", "",
               options.files.front() + ": nothing could be judged: no joint that is read has two keys or more"};
}

void print_pace(std::size_t clips, std::chrono::steady_clock::time_point start) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::fprintf(stderr, "%zu clips in %.2f s: %.1f clips per second\n", clips, seconds,
               static_cast<double>(clips) / std::max(seconds, 1e-9));
}

}  // namespace

void check_clips(const ClipCheckOptions& options, Context& context) {
  const auto start = std::chrono::steady_clock::now();
  Result<ClipJudging> judging = judging_of(options, context);
  if (!judging) return context.fail(judging.issue());
  const ClipJudging with = std::move(judging).value();
  if (const Result<Done> own = check_clips_page(options.report); !own) return context.fail(own.issue());
  Checked checked;
  std::vector<std::string> files = options.files;
  if (options.all_clips) {
    Expanded expanded = expand_animations(options.files, !options.character.empty());
    files = std::move(expanded.files);
    checked.unreadable = std::move(expanded.unreadable), checked.skipped = std::move(expanded.skipped);
  }
  const std::size_t count = files.size() + checked.unreadable.size();
  if (!options.map.empty())  // a user's map may have more nodes than the file
    for (const auto& entry : with.on.map.joints) checked.unmatched.insert(entry.first);
  check_files(files, with, checked);
  if (const Result<Done> fit = judge_input(options, checked); !fit)
    return context.fail(in_map(with.on.map_file, fit.issue()));
  if (const Result<Done> effects = judge_effects(options, context.settings_file, with.limits.settings, checked);
      !effects)
    return context.fail(effects.issue());
  if (const Result<Done> written = write_accepted(options, checked); !written) return context.fail(written.issue());
  context.exit_code = count_findings(checked.clips) > 0 ? kFindings : checked.clips.empty() ? kBadInput : kClean;
  std::stable_sort(checked.clips.begin(), options.all_clips ? checked.clips.end() : checked.clips.begin(), is_worse);
  if (const Result<Done> written =
          write_clips_page({options, checked.clips, checked.unreadable}, context);
      !written)
    context.fail(written.issue(), kInternal);
  if (!options.all_clips) return print_one(with, checked);
  print_all(with, checked, count);
  if (is_incomplete(options, checked))
    context.fail({"check.unreadable", "",
                  count_unreadable(checked, count) + ": see the list; with --allow-unreadable the others decide"});
  print_pace(checked.clips.size(), start);
}

}  // namespace contort::cli
