#include "checks/judge_clip.h"

#include <algorithm>
#include <iterator>

#include "checks/clip_faults.h"

namespace contort {

namespace {

constexpr std::string_view kNoCharacter = "no character is given (--character)";
constexpr std::string_view kNotFollowed = "no joint can follow its node";

// The number of subjects that a check judged in a clip, or the reason why it could not.
struct Verdict {
  int subjects = 0;
  std::string_view reason;
};

bool is_speed(std::string_view check) { return check == "angular_velocity" || check == "pop"; }

Verdict in_channels(const CheckDef& check, const ClipEvaluation& clip) {
  if (is_speed(check.name)) return {clip.speeds.channels, "no node turns"};
  if (check.name == "joint_range" && clip.limits && clip.limits->subjects > 0) return {clip.limits->subjects, ""};
  return {0, kNoCharacter};
}

void note_verdict(const CheckDef& check, const Verdict& verdict, ClipEvaluation& out) {
  if (verdict.subjects > 0)
    out.judged.push_back({check.name, verdict.subjects});
  else
    out.not_judged.push_back({check.name, verdict.reason});
}

int subjects_of(const std::vector<JudgedCheck>& judged, std::string_view check) {
  const auto found = std::ranges::find(judged, check, &JudgedCheck::check);
  return found == judged.end() ? 0 : found->subjects;
}

// Returns true if the check judged the clip already. A check that judges both clips and characters' motions then need
// not judge the motion.
bool is_judged_in_clip(std::string_view check, const std::vector<JudgedCheck>& judged) {
  return find_check(check).in_clip != nullptr && subjects_of(judged, check) > 0;
}

// The subjects that this check must skip in the motion.
std::set<std::string> left_to_others(std::string_view check, const JudgedElsewhere& elsewhere) {
  std::set<std::string> joints;
  if (is_speed(check) || check == "angular_acceleration") joints = elsewhere.not_followed;
  if (is_speed(check)) joints.insert(elsewhere.in_channels.begin(), elsewhere.in_channels.end());
  if (check == "joint_range") joints = elsewhere.in_file;
  return joints;
}

std::string_view reason_of(const std::vector<NotJudged>& not_judged, std::string_view check) {
  const auto found = std::ranges::find(not_judged, check, &NotJudged::check);
  return found == not_judged.end() ? std::string_view() : found->reason;
}

}  // namespace

ClipEvaluation judge_clip(const ClipInput& in, const SpeedLimits& limits, const Capture* capture) {
  ClipEvaluation out;
  out.speeds = check_clip_speeds(in.asset, in.clip, limits);
  out.channels = static_cast<int>(std::ranges::count_if(
      in.clip.channels, [](const AssetChannel& channel) { return channel.times_s.size() > 1; }));
  out.not_read = in.clip.not_read;
  out.channel_count = static_cast<int>(in.clip.channels.size());
  for (const auto& [kind, count] : out.not_read) out.channel_count += count;
  for (const AssetFault* fault : faults_of(in.asset, in.clip)) out.channel_count += fault->key < 0 && fault->node >= 0;
  if (capture != nullptr) out.limits = check_dof_limits(capture->skeleton, capture->motion, in.settings);
  for (const CheckDef& check : all_checks()) {
    if (check.in_clip == nullptr) {
      note_verdict(check, in_channels(check, out), out);
      continue;
    }
    ClipCheckResult result = check.in_clip(in);
    note_verdict(check, {result.subjects, result.why_not}, out);
    std::ranges::move(result.findings, std::back_inserter(out.clip_findings));
  }
  return out;
}

void add_motion(const Evaluation& motion, const JudgedElsewhere& elsewhere, ClipEvaluation& into) {
  const ClipEvaluation before = into;
  into.judged.clear(), into.not_judged.clear();
  const auto is_done = [&](std::string_view check) { return is_judged_in_clip(check, before.judged); };
  std::ranges::copy_if(motion.findings, std::back_inserter(into.motion_findings), [&](const Finding& f) {
    return !is_done(f.check) && !left_to_others(f.check, elsewhere).contains(f.subject);
  });
  for (const CheckDef& check : all_checks()) {
    if (is_done(check.name)) {
      note_verdict(check, {subjects_of(before.judged, check.name), ""}, into);
      continue;
    }
    const int left_out = static_cast<int>(left_to_others(check.name, elsewhere).size());
    const int joints = std::max(0, subjects_of(motion.judged, check.name) - left_out);
    const std::string_view in_clip = check.in_clip != nullptr ? reason_of(before.not_judged, check.name) : "";
    const std::string_view reason = in_clip.empty() ? reason_of(motion.not_judged, check.name) : in_clip;
    const int subjects = subjects_of(before.judged, check.name) + joints;
    note_verdict(check, {subjects, reason.empty() ? kNotFollowed : reason}, into);
  }
}

}  // namespace contort
