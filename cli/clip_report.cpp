#include "cli/clip_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "checks/pop.h"
#include "cli/columns_report.h"
#include "cli/judged_text.h"
#include "cli/left_out_report.h"
#include "cli/print.h"
#include "model/core/index.h"
#include "model/core/json_fields.h"
#include "renders/wording.h"

namespace contort::cli {

namespace {

using json_fields::Json;

std::size_t findings_of(const ClipReport& clip) {
  const ClipEvaluation& judged = clip.judged;
  return judged.speeds.findings.size() + (judged.limits ? judged.limits->findings.size() : 0) +
         judged.clip_findings.size() + judged.motion_findings.size();
}

double worst_depth(const ClipReport& clip) {
  const std::optional<DofLimits>& limits = clip.judged.limits;
  const double fast = -clip.judged.speeds.least_margin_rad_s / find_check("angular_velocity").scale;
  double worst = limits ? std::max(fast, limits->worst_depth) : fast;
  for (const Finding& finding : clip.judged.clip_findings) worst = std::max(worst, finding.depth);
  for (const Finding& finding : clip.judged.motion_findings) worst = std::max(worst, finding.depth);
  return worst;
}

const Finding* deepest_of(const DofLimits& limits) {
  const auto worst = std::max_element(limits.findings.begin(), limits.findings.end(),
                                      [](const Finding& l, const Finding& r) { return l.depth < r.depth; });
  return worst == limits.findings.end() ? nullptr : &*worst;
}

double time_s(const ClipReport& clip, int frame) { return (frame - clip.first_frame) / clip.rate_hz; }

// The excess over the limit as text, with angles in degrees.
std::string excess_text(const Finding& finding, int digits_of_lengths = 1) {
  const bool is_angle = finding.unit == "rad";
  if (is_angle) return decimal(-finding.worst_margin * kDegPerRad, 1) + " deg";
  return decimal(-finding.worst_margin, digits_of_lengths) + " " + finding.unit;
}

std::string peak_text(const ClipSpeeds& clip) {
  const std::string where = clip.peak_node.empty() ? "(nothing turns)" : printable(clip.peak_node);
  return "peak " + decimal(clip.peak_rad_s * kDegPerRad, 1) + " deg/s at " + where + ", " + decimal(clip.peak_t0_s, 3) +
         "-" + decimal(clip.peak_t1_s, 3) + " s";
}

// Text such as "863 of 19208 samples out of range, worst 29.7 deg at lwrist ry max, frame 191".
std::string limits_text(const DofLimits& limits) {
  std::string text =
      std::to_string(limits.out_of_range) + " of " + std::to_string(limits.samples) + " samples out of range";
  if (const Finding* worst = deepest_of(limits))
    text += ", worst " + excess_text(*worst) + " at " + printable(worst->subject) + ", frame " +
            std::to_string(worst->worst_frame);
  return text;
}

void print_limit_findings(const ClipReport& clip) {
  for (const Finding& f : clip.judged.limits->findings)
    std::printf("  joint_range  %s  %s out of range  frames %d-%d, worst %d (%s s)\n", printable(f.subject).c_str(),
                excess_text(f).c_str(), f.first_frame, f.last_frame, f.worst_frame,
                decimal(time_s(clip, f.worst_frame), 3).c_str());
}

Json speed_json(const ClipFinding& f) {
  return {{"check", f.finding.check},
          {"subject", f.finding.subject},
          {"unit", f.finding.unit},
          {"worst_margin", f.finding.worst_margin},
          {"depth", f.finding.depth},
          {"speed_deg_s", f.worst_speed_rad_s * kDegPerRad},
          {"first_interval", f.finding.first_frame},
          {"worst_interval", f.finding.worst_frame},
          {"last_interval", f.finding.last_frame},
          {"t0_s", f.worst_t0_s},
          {"t1_s", f.worst_t1_s}};
}

Json limit_json(const ClipReport& clip, const Finding& f) {
  return {{"check", f.check},
          {"subject", f.subject},
          {"unit", f.unit},
          {"worst_margin", f.worst_margin},
          {"depth", f.depth},
          {"first_frame", f.first_frame},
          {"worst_frame", f.worst_frame},
          {"last_frame", f.last_frame},
          {"worst_time_s", time_s(clip, f.worst_frame)}};
}

Json key_json(const KeyFinding& f) {
  return {{"check", f.check},
          {"subject", f.subject},
          {"unit", f.unit},
          {"worst_margin", f.worst_margin},
          {"depth", f.depth},
          {"first_key", f.first_frame},
          {"worst_key", f.worst_frame},
          {"last_key", f.last_frame},
          {"t0_s", f.t0_s},
          {"t1_s", f.t1_s},
          {"what", f.what}};
}

Json motion_json(const ClipMotion& motion, const Finding& f) {
  const bool finite = std::isfinite(f.worst_margin);
  return {{"check", f.check},
          {"subject", f.subject},
          {"unit", f.unit},
          {"worst_margin", finite ? Json(f.worst_margin) : Json()},
          {"depth", finite ? Json(f.depth) : Json()},
          {"first_frame", f.first_frame},
          {"worst_frame", f.worst_frame},
          {"last_frame", f.last_frame},
          {"worst_time_s", motion.time_s(f.worst_frame)}};
}

const char* path_name(RootPath path) {
  return path == RootPath::told ? "told" : path == RootPath::on_the_spot ? "on_the_spot" : "unknown";
}

Json conversion_json(const ClipMotion& motion) {
  if (motion.columns > 0) return Json::parse(columns_json(motion));
  Json left_out = Json::array();
  for (const LeftOut& l : motion.left_out)
    left_out.push_back({{"joint", l.joint},
                        {"node", l.node},
                        {"turn_deg", l.turn_rad * kDegPerRad},
                        {"turn_time_s", l.turn_s},
                        {"offset_m", l.offset_m},
                        {"offset_time_s", l.offset_s}});
  return {{"rate_hz", motion.rate_hz},      {"frames", motion.frames},
          {"joints", motion.joints},        {"joint_count", motion.joint_count},
          {"root_path", path_name(motion.path)}, {"left_out", left_out},
          {"stray_nodes", motion.stray_nodes}, {"joints_at_rest", motion.joints_at_rest}};
}

Json findings_of_clip(const ClipReport& clip) {
  Json findings = Json::array();
  for (const ClipFinding& f : clip.judged.speeds.findings) findings.push_back(speed_json(f));
  if (clip.judged.limits)
    for (const Finding& f : clip.judged.limits->findings) findings.push_back(limit_json(clip, f));
  for (const KeyFinding& f : clip.judged.clip_findings) findings.push_back(key_json(f));
  if (clip.motion)
    for (const Finding& f : clip.judged.motion_findings) findings.push_back(motion_json(*clip.motion, f));
  return findings;
}

Json clip_json(const ClipReport& clip) {
  const ClipSpeeds& speeds = clip.judged.speeds;
  Json out = {{"clip", speeds.clip},
              {"peak_joint", speeds.peak_node},
              {"peak_deg_s", speeds.peak_rad_s * kDegPerRad},
              {"peak_t0_s", speeds.peak_t0_s},
              {"peak_t1_s", speeds.peak_t1_s},
              {"least_margin_deg_s", speeds.least_margin_rad_s * kDegPerRad},
              {"channels", clip.judged.channels},
              {"channel_count", clip.judged.channel_count},
              {"not_read", clip.judged.not_read},
              {"judged", Json::parse(judged_json(clip.judged.judged))},
              {"not_judged", Json::parse(not_judged_json(clip.judged.not_judged))},
              {"findings", findings_of_clip(clip)}};
  if (clip.judged.limits) {
    out["samples"] = clip.judged.limits->samples;
    out["samples_out_of_range"] = clip.judged.limits->out_of_range;
  }
  if (clip.motion) out["conversion"] = conversion_json(*clip.motion);
  if (clip.similar_names > 0) out["similar_names"] = clip.similar_names;
  return out;
}

void print_tree(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace

std::size_t count_findings(const std::vector<ClipReport>& clips) {
  std::size_t count = 0;
  for (const ClipReport& clip : clips) count += findings_of(clip);
  return count;
}

bool is_worse(const ClipReport& a, const ClipReport& b) {
  const double depth_a = worst_depth(a);
  const double depth_b = worst_depth(b);
  return depth_a != depth_b ? depth_a > depth_b : a.judged.speeds.peak_rad_s > b.judged.speeds.peak_rad_s;
}

namespace {

// The angle of a pop as text: ", 90.5 deg in one step".
std::string step_text(const ClipFinding& f) {
  if (f.finding.check != "pop" || !std::isfinite(f.worst_speed_rad_s)) return "";
  return ", " + decimal(f.worst_speed_rad_s * (f.worst_t1_s - f.worst_t0_s) * kDegPerRad, 1) + " deg in one step";
}

void print_speed_findings(const ClipSpeeds& speeds) {
  for (const ClipFinding& f : speeds.findings)
    std::printf("  %s  %s  %s deg/s, allowed %s  at %s-%s s%s\n", f.finding.check.c_str(),
                printable(f.finding.subject).c_str(), decimal(f.worst_speed_rad_s * kDegPerRad, 1).c_str(),
                decimal((f.worst_speed_rad_s + f.finding.worst_margin) * kDegPerRad, 1).c_str(),
                decimal(f.worst_t0_s, 3).c_str(), decimal(f.worst_t1_s, 3).c_str(), step_text(f).c_str());
  const auto is_pop = [](const ClipFinding& f) { return f.finding.check == "pop"; };
  if (std::ranges::any_of(speeds.findings, is_pop))
    std::printf("  A pop may be as fast as its limit, or 4 times as fast as the motion around it; a step that stands "
                "alone may be at most %g deg, or %g deg if the joint stays there.\n",
                kBlip_rad * kDegPerRad, kJump_rad * kDegPerRad);
}

// Text such as "0.500 s", or "0.467-0.500 s" for a step.
std::string when_text(const KeyFinding& f) {
  return (f.t0_s < f.t1_s ? decimal(f.t0_s, 3) + "-" : "") + decimal(f.t1_s, 3) + " s";
}

void print_key_findings(const std::vector<KeyFinding>& findings) {
  for (const KeyFinding& f : findings) {
    const std::string keys = "  keys " + std::to_string(f.first_frame) + "-" + std::to_string(f.last_frame) +
                             ", worst " + std::to_string(f.worst_frame) + " (" + when_text(f) + ")";
    std::printf("  %s  %s  %s%s\n", f.check.c_str(), printable(f.subject).c_str(),
                (f.what.empty() ? excess_text(f, 3) + " beyond what is allowed" : printable(f.what)).c_str(),
                f.first_frame < 0 ? "" : keys.c_str());
  }
}

void print_motion_findings(const ClipReport& clip) {
  for (std::size_t i = 0; i < clip.judged.motion_findings.size(); ++i) {
    const Finding& f = clip.judged.motion_findings[i];
    std::printf("  %s  %s  %s  frames %d-%d, worst %d (%s s)\n", f.check.c_str(), printable(f.subject).c_str(),
                clip.motion_texts[i].c_str(), f.first_frame, f.last_frame, f.worst_frame,
                decimal(clip.motion->time_s(f.worst_frame), 3).c_str());
  }
}

}  // namespace

ClipMotion motion_of_clip(const Asset& asset, const AssetClip& clip, const Conversion& made) {
  const Motion& motion = made.execution.motion;
  const Character& character = *made.execution.character;
  ClipMotion out{motion.rate_hz, clip.first_s, motion.frame_count, 0, static_cast<int>(character.joints().size()),
                 made.execution.path, {}, {}, {}};
  const auto time_of = [&](int frame) { return clip.first_s + frame / motion.rate_hz; };
  for (const FollowedNode& f : made.followed) {
    out.joints += f.hinges;
    if (f.missed_rad > 0.0 || f.moved_m > 0.0)
      out.left_out.push_back({character.joint(f.joint).name, asset.nodes[at(f.node)].label, f.missed_rad,
                              time_of(f.missed_frame), f.moved_m, time_of(f.moved_frame)});
  }
  for (const int node : made.stray_nodes) out.stray_nodes.push_back(asset.nodes[at(node)].label);
  for (const int joint : made.joints_at_rest) out.joints_at_rest.push_back(character.joint(joint).name);
  return out;
}

void print_clip(const ClipReport& clip) {
  std::printf("clip %s: %s\n", printable(clip.judged.speeds.clip).c_str(), peak_text(clip.judged.speeds).c_str());
  if (clip.motion && clip.motion->columns == 0) print_large_turns(*clip.motion);
  print_speed_findings(clip.judged.speeds);
  print_key_findings(clip.judged.clip_findings);
  print_motion_findings(clip);
  if (clip.judged.limits) {
    std::printf("  declared limits: %s\n", limits_text(*clip.judged.limits).c_str());
    print_limit_findings(clip);
  }
  if (clip.similar_names > 0)
    std::printf("  %zu nodes are those of the map with another prefix\n", clip.similar_names);
  if (clip.motion) print_conversion(*clip.motion);
}

void print_clip_line(const ClipReport& clip) {
  const ClipSpeeds& speeds = clip.judged.speeds;
  const auto is_pop = [](const ClipFinding& f) { return f.finding.check == "pop"; };
  const auto pops = std::ranges::count_if(speeds.findings, is_pop) +
                    std::ranges::count(clip.judged.motion_findings, "pop", &Finding::check);
  std::printf("%s: clip %s: findings %zu, pops %zu, %s%s%s\n", printable(clip.file).c_str(),
              printable(speeds.clip).c_str(), findings_of(clip), static_cast<std::size_t>(pops),
              peak_text(speeds).c_str(),
              clip.judged.limits ? ("; " + limits_text(*clip.judged.limits)).c_str() : "",
              clip.motion ? left_out_text(*clip.motion).c_str() : "");
}

void print_judged(const std::vector<ClipReport>& clips) {
  JudgedSummary summary;
  for (const ClipReport& clip : clips) {
    summary.add(clip.judged.judged, clip.judged.not_judged);
    if (clip.judged.channels > summary.channels || summary.channel_count == 0)
      summary.channels = clip.judged.channels, summary.channel_count = clip.judged.channel_count;
    for (const auto& [kind, count] : clip.judged.not_read) summary.not_read[kind] += count;
    if (!clip.motion) continue;
    summary.frames += clip.motion->frames;
    summary.joints = std::max(summary.joints, clip.motion->joints), summary.joint_count = clip.motion->joint_count;
  }
  for (const std::string& line : judged_lines(summary)) std::printf("%s\n", line.c_str());
}

void print_result(std::size_t findings, std::size_t clips, const std::string& missing, const std::string& more) {
  std::string verdict = findings == 0 ? "OK: nothing found." : "FAILED: limits are violated.";
  if (!missing.empty()) verdict = (findings == 0 ? "FAILED: " : "FAILED: limits are violated, and ") + missing + ".";
  std::printf("%s\n", verdict.c_str());
  std::printf("RESULT findings=%zu clips=%zu%s\n", findings, clips, more.c_str());
}

namespace {

Json unreadable_json(const std::vector<Unreadable>& files) {
  Json out = Json::array();
  for (const auto& [file, issue] : files)
    out.push_back({{"file", file}, {"code", issue.code}, {"pointer", issue.pointer}, {"text", issue.text}});
  return out;
}

Json remarks_json(const std::vector<FileRemark>& remarks) {
  Json out = Json::array();
  for (const auto& [file, remark] : remarks)
    out.push_back({{"file", file}, {"code", remark.code}, {"text", remark.text}});
  return out;
}

}  // namespace

void print_json(const std::string& file, const std::vector<ClipReport>& clips, const std::vector<FileRemark>& remarks,
                const std::string& waivers) {
  Json list = Json::array();
  for (const ClipReport& clip : clips) list.push_back(clip_json(clip));
  print_tree({{"file", file}, {"clips", list}, {"remarks", remarks_json(remarks)}, {"waivers", Json::parse(waivers)}});
}

void print_json(const ManyFiles& files, const std::string& waivers) {
  Json list = Json::array();
  for (const ClipReport& clip : files.clips) {
    Json one = clip_json(clip);
    one["file"] = clip.file;
    list.push_back(std::move(one));
  }
  print_tree({{"clips", list},
              {"unreadable", unreadable_json(files.unreadable)},
              {"skipped", unreadable_json(files.skipped)},
              {"remarks", remarks_json(files.remarks)},
              {"waivers", Json::parse(waivers)}});
}

}  // namespace contort::cli
