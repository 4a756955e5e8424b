#include "cli/clip_report.h"

#include <algorithm>
#include <cstdio>

#include "checks/check.h"
#include "cli/print.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

std::size_t findings_of(const ClipReport& clip) {
  return clip.speeds.findings.size() + (clip.limits ? clip.limits->findings.size() : 0) + clip.seams.size() +
         clip.gaps.size();
}

double worst_depth(const ClipReport& clip) {
  const double fast = -clip.speeds.least_margin_rad_s / find_check("angular_velocity").scale;
  double worst = clip.limits ? std::max(fast, clip.limits->worst_depth) : fast;
  for (const std::vector<Finding>* found : {&clip.seams, &clip.gaps})
    for (const Finding& finding : *found) worst = std::max(worst, finding.depth);
  return worst;
}

const Finding* deepest_of(const DofLimits& limits) {
  const auto worst = std::max_element(limits.findings.begin(), limits.findings.end(),
                                      [](const Finding& l, const Finding& r) { return l.depth < r.depth; });
  return worst == limits.findings.end() ? nullptr : &*worst;
}

double time_s(const ClipReport& clip, int frame) { return (frame - clip.first_frame) / clip.rate_hz; }

// Angles for people.
std::string margin_text(const Finding& finding) {
  const bool is_angle = finding.unit == "rad";
  return decimal(-finding.worst_margin * (is_angle ? kDegPerRad : 1.0), 1) + " " + (is_angle ? "deg" : finding.unit);
}

std::string peak_text(const ClipSpeeds& clip) {
  const std::string where = clip.peak_node.empty() ? "(nothing turns)" : printable(clip.peak_node);
  return "peak " + decimal(clip.peak_rad_s * kDegPerRad, 1) + " deg/s at " + where + ", " + decimal(clip.peak_t0_s, 3) +
         "-" + decimal(clip.peak_t1_s, 3) + " s";
}

// "863 of 19208 samples out of range, worst 29.7 deg at lwrist ry max, frame 191"
std::string limits_text(const DofLimits& limits) {
  std::string text =
      std::to_string(limits.out_of_range) + " of " + std::to_string(limits.samples) + " samples out of range";
  if (const Finding* worst = deepest_of(limits))
    text += ", worst " + margin_text(*worst) + " at " + printable(worst->subject) + ", frame " +
            std::to_string(worst->worst_frame);
  return text;
}

void print_limit_findings(const ClipReport& clip) {
  for (const Finding& f : clip.limits->findings)
    std::printf("  joint_range  %s  %s out of range  frames %d-%d, worst %d (%s s)\n", printable(f.subject).c_str(),
                margin_text(f).c_str(), f.first_frame, f.last_frame, f.worst_frame,
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

Json seam_json(const Finding& f) {
  return {{"check", f.check}, {"subject", f.subject},     {"unit", f.unit}, {"worst_margin", f.worst_margin},
          {"depth", f.depth}, {"last_key", f.worst_frame}};
}

Json gap_json(const Finding& f) {
  return {{"check", f.check},
          {"subject", f.subject},
          {"unit", f.unit},
          {"worst_margin", f.worst_margin},
          {"depth", f.depth},
          {"first_key", f.first_frame},
          {"worst_key", f.worst_frame},
          {"last_key", f.last_frame}};
}

Json clip_json(const ClipReport& clip) {
  Json findings = Json::array();
  for (const ClipFinding& f : clip.speeds.findings) findings.push_back(speed_json(f));
  Json out = {{"clip", clip.speeds.clip},
              {"peak_joint", clip.speeds.peak_node},
              {"peak_deg_s", clip.speeds.peak_rad_s * kDegPerRad},
              {"peak_t0_s", clip.speeds.peak_t0_s},
              {"peak_t1_s", clip.speeds.peak_t1_s},
              {"least_margin_deg_s", clip.speeds.least_margin_rad_s * kDegPerRad}};
  if (clip.limits) {
    for (const Finding& f : clip.limits->findings) findings.push_back(limit_json(clip, f));
    out["samples"] = clip.limits->samples;
    out["samples_out_of_range"] = clip.limits->out_of_range;
  }
  for (const Finding& f : clip.seams) findings.push_back(seam_json(f));
  for (const Finding& f : clip.gaps) findings.push_back(gap_json(f));
  out["findings"] = findings;
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
  return depth_a != depth_b ? depth_a > depth_b : a.speeds.peak_rad_s > b.speeds.peak_rad_s;
}

void print_clip(const ClipReport& clip) {
  std::printf("clip %s: %s\n", printable(clip.speeds.clip).c_str(), peak_text(clip.speeds).c_str());
  for (const ClipFinding& f : clip.speeds.findings)
    std::printf("  %s  %s  %s deg/s, allowed %s  at %s-%s s\n", f.finding.check.c_str(),
                printable(f.finding.subject).c_str(), decimal(f.worst_speed_rad_s * kDegPerRad, 1).c_str(),
                decimal((f.worst_speed_rad_s + f.finding.worst_margin) * kDegPerRad, 1).c_str(),
                decimal(f.worst_t0_s, 3).c_str(), decimal(f.worst_t1_s, 3).c_str());
  for (const Finding& f : clip.seams)
    std::printf("  loop_seam  %s  %s wider than allowed between its last key and its first\n",
                printable(f.subject).c_str(), margin_text(f).c_str());
  for (const Finding& f : clip.gaps)
    std::printf("  part_gap  %s  %s m farther from its place than allowed  keys %d-%d, worst %d\n",
                printable(f.subject).c_str(), decimal(-f.worst_margin, 3).c_str(), f.first_frame, f.last_frame,
                f.worst_frame);
  if (!clip.limits) return;
  std::printf("  declared limits: %s\n", limits_text(*clip.limits).c_str());
  print_limit_findings(clip);
}

void print_clip_line(const ClipReport& clip) {
  const std::size_t pops =
      static_cast<std::size_t>(std::count_if(clip.speeds.findings.begin(), clip.speeds.findings.end(),
                                             [](const ClipFinding& f) { return f.finding.check == "pop"; }));
  std::printf("%s: clip %s: findings %zu, pops %zu, %s%s%s\n", printable(clip.file).c_str(),
              printable(clip.speeds.clip).c_str(), findings_of(clip), pops, peak_text(clip.speeds).c_str(),
              clip.limits ? "; " : "", clip.limits ? limits_text(*clip.limits).c_str() : "");
}

void print_result(std::size_t findings, std::size_t clips, const std::string& missing, const std::string& more) {
  std::string verdict = findings == 0 ? "OK: nothing found." : "FAILED: limits are violated.";
  if (!missing.empty()) verdict = (findings == 0 ? "FAILED: " : "FAILED: limits are violated, and ") + missing + ".";
  std::printf("%s\n", verdict.c_str());
  std::printf("RESULT findings=%zu clips=%zu%s\n", findings, clips, more.c_str());
}

void print_json(const std::string& file, const std::vector<ClipReport>& clips, const std::string& waivers) {
  Json list = Json::array();
  for (const ClipReport& clip : clips) list.push_back(clip_json(clip));
  print_tree({{"file", file}, {"clips", list}, {"waivers", Json::parse(waivers)}});
}

void print_json(const std::vector<ClipReport>& clips, const std::vector<Unreadable>& unreadable,
                const std::string& waivers) {
  Json list = Json::array();
  for (const ClipReport& clip : clips) {
    Json one = clip_json(clip);
    one["file"] = clip.file;
    list.push_back(std::move(one));
  }
  Json refused = Json::array();
  for (const auto& [file, issue] : unreadable)
    refused.push_back({{"file", file}, {"code", issue.code}, {"pointer", issue.pointer}, {"text", issue.text}});
  print_tree({{"clips", list}, {"unreadable", refused}, {"waivers", Json::parse(waivers)}});
}

}  // namespace contort::cli
