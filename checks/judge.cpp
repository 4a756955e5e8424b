#include "checks/judge.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "checks/limits.h"
#include "model/motion/place_frames.h"

namespace contort {

namespace {

void append_findings(const CheckDef& check, const Character& character, const MarginFold& fold,
                     std::vector<Finding>& out) {
  for (const MarginFold::Episode& episode : fold.episodes()) {
    Finding finding;
    finding.check = check.name;
    const Subject subject = check.subject(character, episode.subject);
    finding.subject = subject.name;
    finding.unit = subject.unit;
    finding.first_frame = episode.first, finding.worst_frame = episode.worst, finding.last_frame = episode.last;
    finding.worst_margin = episode.worst_margin;
    finding.depth = std::isnan(episode.worst_margin) ? std::numeric_limits<double>::infinity()
                                                     : -episode.worst_margin / check.scale;
    out.push_back(std::move(finding));
  }
}

// Returns true if the figure tips, lies, or is off the ground although its target stands.
bool has_lost_balance(const Stance& stance) {
  if (stance.footing == Footing::standing) return false;
  return stance.footing != Footing::airborne || stance.planned != 0;
}

// The number of frames if the figure never loses its balance.
int first_without_balance(const Motion& motion) {
  const std::vector<Stance>& stances = motion.response.stances;
  const auto lost = std::find_if(stances.begin(), stances.end(), has_lost_balance);
  return lost == stances.end() ? motion.frame_count : static_cast<int>(lost - stances.begin());
}

}  // namespace

Evaluation Judge::evaluate(const Execution& execution, std::string_view only_check) {
  Evaluation evaluation;
  evaluation.motion_hash = motion_hash(execution.motion);
  evaluation.frame_count = execution.motion.frame_count - execution.motion.first_frame;
  judge({*execution.character, execution.motion, {}, settings_, execution.environment, execution.said(),
         execution.path, execution.foreign ? &*execution.foreign : nullptr, execution.couplings},
        only_check, evaluation);
  if (!settings_.waivers.empty()) set_waived_apart(execution, evaluation);
  return evaluation;
}

// Waivers for a phase need an intent. Without it no frame has a phase, and these waivers hide nothing.
void Judge::set_waived_apart(const Execution& execution, Evaluation& evaluation) const {
  std::vector<Phase> phases;
  if (execution.intent) {
    const std::vector<Phase> of_frames = phases_of(*execution.intent, execution.motion);
    for (const Finding& finding : evaluation.findings)
      phases.push_back(of_frames[static_cast<std::size_t>(finding.worst_frame)]);
  }
  Waived waived = waive(settings_.waivers, evaluation.findings, phases, settings_.today);
  std::vector<Finding> open;
  for (std::size_t f = 0; f < evaluation.findings.size(); ++f)
    if (waived.by[f] < 0)
      open.push_back(std::move(evaluation.findings[f]));
    else
      evaluation.waived.push_back({std::move(evaluation.findings[f]), waived.by[f]});
  evaluation.findings = std::move(open);
  evaluation.waivers = std::move(waived.uses);
}

MarginFold Judge::fold(const CheckDef& check, const CheckInput& input, bool record) const {
  MarginFold margins(check.subject_count(input.character), settings_.merge_gap_frames, check.resolution);
  if (record) margins.record(input.motion.frame_count);
  margins.begin_at(input.motion.first_frame);
  apply_limits(check, input, margins);
  if (reason_not_to_judge(check, input).empty()) check.measure(input, margins);
  return margins;
}

std::vector<Finding> Judge::judge(const Character& character, const Motion& motion, std::string_view only_check,
                                  const Environment& environment, const Intent* intent) {
  Evaluation evaluation;
  judge({character, motion, {}, settings_, environment, intent}, only_check, evaluation);
  return std::move(evaluation.findings);
}

namespace {

// Adds the check to those that judged, or to those that could not.
void add_verdict(const CheckDef& check, std::string_view reason, const MarginFold& margins, Evaluation& out) {
  const int subjects = reason.empty() ? margins.judged_subjects() : 0;
  if (subjects > 0)
    out.judged.push_back({check.name, subjects});
  else
    out.not_judged.push_back({check.name, reason.empty() ? check.nothing : reason});
}

}  // namespace

void Judge::judge(CheckInput input, std::string_view only_check, Evaluation& out) {
  smallest_.clear();
  for (const CheckDef& check : all_checks()) {
    if (!only_check.empty() && check.name != only_check) continue;
    const std::string_view reason = reason_not_to_judge(check, input);
    if (reason.empty() && check.needs_world && input.world.empty()) {
      place_frames(input.character, input.motion, world_);
      input.world = world_;
    }
    const MarginFold margins = fold(check, input, false);
    append_findings(check, input.character, margins, out.findings);
    add_verdict(check, reason, margins, out);
    if (check.needs != Needs::clip) smallest_.push_back({&check, margins.smallest()});
  }
  // Losing the balance is the fault. The movements of the limbs after it only follow from it, and are not judged.
  const int lost = first_without_balance(input.motion);
  std::erase_if(out.findings, [&](const Finding& f) { return f.first_frame >= lost && f.check != "balance"; });
  std::stable_sort(out.findings.begin(), out.findings.end(),
                   [](const Finding& l, const Finding& r) { return l.first_frame < r.first_frame; });
}

namespace {

struct Candidate {
  double nearness = 0.0;  // smallest margin in the check's scale
  std::size_t row = 0;    // index into smallest_margins()
  int subject = 0;
};

// The judged subjects, nearest to their limits first. NaN is nearest of all.
std::vector<Candidate> by_nearness(const std::vector<SmallestMargins>& smallest) {
  std::vector<Candidate> all;
  for (std::size_t row = 0; row < smallest.size(); ++row)
    for (std::size_t s = 0; s < smallest[row].of_subject.size(); ++s) {
      const double margin = smallest[row].of_subject[s];
      if (margin == std::numeric_limits<double>::infinity()) continue;
      const double nearness = std::isnan(margin) ? -std::numeric_limits<double>::infinity() : margin;
      all.push_back({nearness / smallest[row].check->scale, row, static_cast<int>(s)});
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& l, const Candidate& r) { return l.nearness < r.nearness; });
  return all;
}

}  // namespace

std::vector<MarginCurve> Judge::curves(const Execution& execution, const Finding& about, std::size_t most) const {
  std::vector<Candidate> chosen = by_nearness(smallest_);
  const auto is_about = [&](const Candidate& c) {
    const CheckDef& check = *smallest_[c.row].check;
    return check.name == about.check && check.subject(*execution.character, c.subject).name == about.subject;
  };
  const auto first = std::ranges::find_if(chosen, is_about);
  if (first != chosen.end()) std::rotate(chosen.begin(), first, first + 1);
  chosen.resize(std::min(chosen.size(), most));
  std::vector<MarginCurve> curves(chosen.size());
  const CheckInput input{*execution.character,  execution.motion, world_, settings_,
                         execution.environment, execution.said(), execution.path};
  for (std::size_t row = 0; row < smallest_.size(); ++row) {
    if (std::ranges::none_of(chosen, [&](const Candidate& c) { return c.row == row; })) continue;
    const CheckDef& check = *smallest_[row].check;
    const MarginFold margins = fold(check, input, true);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i].row != row) continue;
      const std::span<const double> recorded = margins.recorded(chosen[i].subject);
      curves[i] = {&check, check.subject(*execution.character, chosen[i].subject), {recorded.begin(), recorded.end()}};
    }
  }
  return curves;
}

const Finding* deepest(const std::vector<Finding>& findings, const std::string& check, const std::string& subject) {
  const Finding* best = nullptr;
  for (const Finding& finding : findings)
    if (finding.check == check && finding.subject == subject && (best == nullptr || finding.depth > best->depth))
      best = &finding;
  return best;
}

}  // namespace contort
