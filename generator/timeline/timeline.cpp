#include "generator/timeline/timeline.h"

#include <algorithm>
#include <cmath>

namespace contort {

namespace {

// A stretch of content on the time line: frame = start + content * scale.
struct Stretch {
  double start = 0.0;
  double scale = 1.0;
  double at(double content) const { return start + content * scale; }
};

// How content of a natural length is stretched to a wanted one (0: natural).
double stretch_scale(double natural, int wanted_frames) {
  return wanted_frames > 0 && natural > 0.0 ? wanted_frames / natural : 1.0;
}

double natural_length(const ClipDesc& clip) {
  int length = 0;
  for (const ActionUse& use : clip.actions) length = std::max(length, use.start_frame + use.duration_frames);
  return length;
}

// What a natural length becomes. Not natural * scale: 7 * (29.0 / 7) is more than 29.
double stretched(double natural, int wanted_frames) {
  return wanted_frames > 0 && natural > 0.0 ? wanted_frames : natural;
}

double clip_length(const ClipDesc& clip) { return stretched(natural_length(clip), clip.duration_frames) / clip.speed; }

// The first frame at or after a time. Rounding in the stretches must not cost a frame.
double frame_from(double time) { return std::ceil(time - 1e-6); }

double natural_length(const SequenceDesc& sequence) {
  double length = 0.0;
  for (const ClipDesc& clip : sequence.clips) length = std::max(length, clip.start_frame + clip_length(clip));
  return length;
}

std::string slots_of(const Character& character) {
  std::string text;
  for (const Part& part : character.parts()) text += (text.empty() ? "" : ", ") + part.slot;
  return text;
}

std::string actions_of(const Part& part) {
  std::string text;
  for (const ActionDef& action : all_actions())
    if (action.supports(part)) text += (text.empty() ? "" : ", ") + std::string(action.name);
  return text.empty() ? "none" : text;
}

std::string all_action_names() {
  std::string text;
  for (const ActionDef& action : all_actions()) text += (text.empty() ? "" : ", ") + std::string(action.name);
  return text;
}

class Layout {
 public:
  explicit Layout(const Character& character) : character_(character) { out_.of_part.resize(character.parts().size()); }

  Result<Timeline> lay_out(const std::vector<SequenceDesc>& sequences) {
    double start = 0.0;
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      const double natural = natural_length(sequences[s]);
      const double scale = stretch_scale(natural, sequences[s].duration_frames);
      const Result<Done> done = add_sequence(sequences[s], static_cast<int>(s), {start, scale});
      if (!done) return done.issue();
      start = frame_from(start + stretched(natural, sequences[s].duration_frames));  // sequences change on a frame
      if (start > kMaxFrames)
        return Issue{"spec.too_long", "/sequences/" + std::to_string(s),
                     "the motion is longer than " + std::to_string(kMaxFrames) + " frames"};
    }
    out_.frame_count = static_cast<int>(start);
    return std::move(out_);
  }

 private:
  Result<Done> add_sequence(const SequenceDesc& sequence, int index, const Stretch& stretch) {
    for (std::size_t c = 0; c < sequence.clips.size(); ++c) {
      const ClipDesc& clip = sequence.clips[c];
      const double scale = stretch_scale(natural_length(clip), clip.duration_frames) / clip.speed;
      const Stretch content{stretch.at(clip.start_frame), stretch.scale * scale};
      for (std::size_t a = 0; a < clip.actions.size(); ++a) {
        PlannedAction planned;
        planned.sequence = index, planned.clip = static_cast<int>(c), planned.action = static_cast<int>(a);
        if (Result<Done> done = add_action(clip.actions[a], content, planned); !done) {
          Issue issue = done.issue();
          issue.pointer = "/sequences/" + std::to_string(index) + "/clips/" + std::to_string(c) + "/actions/" +
                          std::to_string(a) + issue.pointer;
          return issue;
        }
      }
    }
    return Done{};
  }

  Result<Done> add_action(const ActionUse& use, const Stretch& content, PlannedAction& planned) {
    planned.def = find_action(use.action);
    if (planned.def == nullptr)
      return Issue{"spec.unknown_action", "/action", "found \"" + use.action + "\", allowed are " + all_action_names()};
    planned.part = character_.find_part(use.slot);
    if (planned.part < 0)
      return Issue{"spec.unknown_slot", "/slot", "found \"" + use.slot + "\", allowed are " + slots_of(character_)};
    const Part& part = character_.parts()[static_cast<std::size_t>(planned.part)];
    if (!planned.def->supports(part))
      return Issue{"spec.unsupported_action", "/action",
                   "part " + part.name + " cannot do \"" + use.action + "\", allowed are " + actions_of(part)};
    Result<std::vector<double>> params = bind_params(*planned.def, character_, part, use.params);
    if (!params) return params.issue();
    planned.params = std::move(params).value();
    planned.start = content.at(use.start_frame);
    planned.end = content.at(static_cast<double>(use.start_frame) + use.duration_frames);
    planned.speed = use.speed;
    planned.first_frame = static_cast<int>(std::min(frame_from(planned.start), 1e9));
    // At least one frame after the start, or an action shorter than the rounding would never reach its target.
    planned.last_frame =
        static_cast<int>(std::min(std::max(frame_from(planned.end), std::floor(planned.start) + 1.0), 1e9));
    out_.of_part[static_cast<std::size_t>(planned.part)].push_back(static_cast<int>(out_.actions.size()));
    out_.actions.push_back(std::move(planned));
    return Done{};
  }

  const Character& character_;
  Timeline out_;
};

}  // namespace

Result<Timeline> lay_out(const std::vector<SequenceDesc>& sequences, const Character& character) {
  return Layout(character).lay_out(sequences);
}

double progress(const PlannedAction& action, int frame) {
  const double period = action.end - action.start;
  if (!(period > 0.0)) return frame > action.start ? 1.0 : 0.0;  // stretched to less than the rounding of its start
  const double u = action.speed * (frame - action.start) / period;
  return std::clamp(u, 0.0, 1.0);
}

double ease(double u) { return u * u * u * (10.0 + u * (6.0 * u - 15.0)); }

}  // namespace contort
