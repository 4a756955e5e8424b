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

Spec scoped(Spec spec, const ReplayScope& scope) {
  if (scope.kind == ReplayScope::Kind::part) spec.only_slot = scope.slot;
  if (scope.sequence > 0) spec.only_sequence = scope.sequence, spec.only_clip = scope.clip;
  return spec;
}

}  // namespace contort
