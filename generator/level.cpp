#include "generator/level.h"

#include <charconv>

namespace contort {

namespace {

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1) return std::nullopt;
  return value;
}

Result<SequenceDesc> sequence_of(const Spec& spec, int number) {
  const auto queued = static_cast<int>(spec.sequences.size());
  const int all = queued + static_cast<int>(spec.interrupts.size());
  if (number > all)
    return Issue{"level.no_sequence", "", "found sequence " + std::to_string(number) + ", the spec has " +
                                              std::to_string(all)};
  return number <= queued ? spec.sequences[static_cast<std::size_t>(number - 1)]
                          : spec.interrupts[static_cast<std::size_t>(number - 1 - queued)].sequence;
}

Result<Spec> reduced(Spec spec, const Level& level) {
  Result<SequenceDesc> sequence = sequence_of(spec, level.sequence);
  if (!sequence) return sequence.issue();
  spec.sequences = {*sequence};
  spec.interrupts.clear();
  if (level.kind == Level::Kind::sequence) return spec;
  std::vector<ClipDesc>& clips = spec.sequences.front().clips;
  if (level.clip > static_cast<int>(clips.size()))
    return Issue{"level.no_clip", "", "found clip " + std::to_string(level.clip) + ", sequence " +
                                          std::to_string(level.sequence) + " has " + std::to_string(clips.size())};
  clips = {clips[static_cast<std::size_t>(level.clip - 1)]};
  clips.front().start_frame = 0;
  spec.sequences.front().duration_frames = 0;
  return spec;
}

}  // namespace

Result<Level> parse_level(const std::string& text) {
  const Issue bad{"level.bad_name", "",
                  "found \"" + text + "\", allowed are sequence:2, clip:2/1 and part:arm_right"};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return bad;
  const std::string kind = text.substr(0, colon), rest = text.substr(colon + 1);
  Level level;
  if (kind == "part" && !rest.empty()) {
    level.kind = Level::Kind::part, level.slot = rest;
    return level;
  }
  const std::size_t slash = rest.find('/');
  const std::optional<int> sequence = number_of(std::string_view(rest).substr(0, slash));
  if (!sequence) return bad;
  level.sequence = *sequence;
  if (kind == "sequence" && slash == std::string::npos) {
    level.kind = Level::Kind::sequence;
    return level;
  }
  const std::optional<int> clip =
      slash == std::string::npos ? std::nullopt : number_of(std::string_view(rest).substr(slash + 1));
  if (kind != "clip" || !clip) return bad;
  level.kind = Level::Kind::clip, level.clip = *clip;
  return level;
}

Result<Stage> build_stage_at(const Spec& spec, const Library& library, const Level& level) {
  if (level.kind == Level::Kind::whole) return build_stage(spec, library);
  if (level.kind != Level::Kind::part) {
    const Result<Spec> smaller = reduced(spec, level);
    return smaller ? build_stage(*smaller, library) : Result<Stage>(smaller.issue());
  }
  Result<Stage> stage = build_stage(spec, library);
  if (!stage) return stage;
  const int part = stage->character->find_part(level.slot);
  if (part < 0) return Issue{"level.no_part", "", "found \"" + level.slot + "\", which is no slot of the character"};
  const std::size_t parts = stage->character->parts().size();
  Stage alone = std::move(stage).value();
  for (std::size_t i = 0; i < alone.timeline.of_part.size(); ++i)
    if (i % parts != static_cast<std::size_t>(part)) alone.timeline.of_part[i].clear();
  return alone;
}

}  // namespace contort
