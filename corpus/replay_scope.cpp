#include "corpus/replay_scope.h"

#include <charconv>
#include <optional>

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

Result<Spec> reduced(Spec spec, const ReplayScope& scope) {
  Result<SequenceDesc> sequence = sequence_of(spec, scope.sequence);
  if (!sequence) return sequence.issue();
  spec.sequences = {*sequence};
  spec.interrupts.clear();
  if (scope.kind == ReplayScope::Kind::sequence) return spec;
  std::vector<ClipDesc>& clips = spec.sequences.front().clips;
  if (scope.clip > static_cast<int>(clips.size()))
    return Issue{"level.no_clip", "", "found clip " + std::to_string(scope.clip) + ", sequence " +
                                          std::to_string(scope.sequence) + " has " + std::to_string(clips.size())};
  clips = {clips[static_cast<std::size_t>(scope.clip - 1)]};
  clips.front().start_frame = 0;
  spec.sequences.front().duration_frames = 0;
  return spec;
}

}  // namespace

Result<ReplayScope> parse_scope(const std::string& text) {
  const Issue bad{"level.bad_name", "",
                  "found \"" + text + "\", allowed are sequence:2, clip:2/1 and part:arm_right"};
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return bad;
  const std::string kind = text.substr(0, colon), rest = text.substr(colon + 1);
  ReplayScope scope;
  if (kind == "part" && !rest.empty()) {
    scope.kind = ReplayScope::Kind::part, scope.slot = rest;
    return scope;
  }
  const std::size_t slash = rest.find('/');
  const std::optional<int> sequence = number_of(std::string_view(rest).substr(0, slash));
  if (!sequence) return bad;
  scope.sequence = *sequence;
  if (kind == "sequence" && slash == std::string::npos) {
    scope.kind = ReplayScope::Kind::sequence;
    return scope;
  }
  const std::optional<int> clip =
      slash == std::string::npos ? std::nullopt : number_of(std::string_view(rest).substr(slash + 1));
  if (kind != "clip" || !clip) return bad;
  scope.kind = ReplayScope::Kind::clip, scope.clip = *clip;
  return scope;
}

Result<Spec> scoped(const Spec& spec, const ReplayScope& scope) {
  if (scope.kind == ReplayScope::Kind::whole) return spec;
  if (scope.kind != ReplayScope::Kind::part) return reduced(spec, scope);
  Spec alone = spec;
  alone.only_slot = scope.slot;
  return alone;
}

}  // namespace contort
