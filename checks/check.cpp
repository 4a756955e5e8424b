#include "checks/check.h"

#include <algorithm>

#include "checks/clip_check.h"
#include "model/core/assert.h"

namespace contort {

#define X(name, kind, scale, resolution, needs_world, needs, nothing, help) \
  int name##_subject_count(const Character&);                         \
  Subject name##_subject(const Character&, int);                      \
  void name##_measure(const CheckInput&, MarginFold&);
#define CLIP(name, kind, scale, help) ClipCheckResult name##_in_clip(const ClipInput&);
#define BOTH(name, kind, scale, resolution, needs_world, needs, nothing, help) \
  X(name, kind, scale, resolution, needs_world, needs, nothing, help)          \
  CLIP(name, kind, scale, help)
#include "checks/check_list.inc"
#undef X
#undef CLIP
#undef BOTH

namespace {

constexpr std::string_view kNoIntent = "nothing says what the motion was meant to do (no intent)";
constexpr std::string_view kNoRoot = "nothing says where the root goes";

int no_subjects(const Character&) { return 0; }
Subject no_subject(const Character&, int) { return {}; }
void measure_nothing(const CheckInput&, MarginFold&) {}

}  // namespace

std::span<const CheckDef> all_checks() {
  static const CheckDef checks[] = {
#define X(name, kind, scale, resolution, needs_world, needs, nothing, help)                                        \
  {#name,   CheckKind::kind, scale, resolution,           needs_world,    Needs::needs, \
   nothing, help,            name##_subject_count, name##_subject, name##_measure},
#define CLIP(name, kind, scale, help)                                                         \
  {#name, CheckKind::kind, scale, 0.0, false, Needs::clip, "", \
   help,  no_subjects, no_subject, measure_nothing, name##_in_clip},
#define BOTH(name, kind, scale, resolution, needs_world, needs, nothing, help)                                     \
  {#name,   CheckKind::kind, scale, resolution,           needs_world,    Needs::needs, \
   nothing, help,            name##_subject_count, name##_subject, name##_measure, name##_in_clip},
#include "checks/check_list.inc"
#undef X
#undef CLIP
#undef BOTH
  };
  return checks;
}

std::span<const std::string_view> check_kind_names() {
  static constexpr std::string_view kNames[] = {"broken", "speed",    "range", "contact", "ground",
                                                "obstacle", "goal", "queue", "dynamics"};
  return kNames;
}

CheckKind kind_of_check(std::string_view check) {
  const auto def = std::ranges::find(all_checks(), check, &CheckDef::name);
  return def == all_checks().end() ? CheckKind::broken : def->kind;
}

std::string_view reason_not_to_judge(const CheckDef& check, const CheckInput& input) {
  const bool has_response = input.motion.response.dof_count > 0;
  switch (check.needs) {
    case Needs::motion: return {};
    case Needs::height: return input.path != RootPath::unknown ? std::string_view() : kNoRoot;
    case Needs::path:
      if (input.path == RootPath::unknown) return kNoRoot;
      return input.path == RootPath::told ? "" : "the figure walks on the spot: an engine would move it";
    case Needs::intent: return input.intent != nullptr ? std::string_view() : kNoIntent;
    case Needs::kinematic_intent:
      if (input.intent == nullptr) return kNoIntent;
      return has_response ? "dynamics moves the figure, so that tracking_error judges" : "";
    case Needs::response: return has_response ? "" : "the motion has no dynamics";
    case Needs::clip: return "the motion is not a clip of an animation file";
    case Needs::couplings: return input.couplings.empty() ? "no joint has to follow another one" : "";
    case Needs::foreign: return input.foreign != nullptr ? "" : "the generator is not a program of its own";
  }
  return {};
}

const CheckDef& find_check(std::string_view name) {
  const std::span<const CheckDef> checks = all_checks();
  const auto found = std::find_if(checks.begin(), checks.end(), [name](const CheckDef& c) { return c.name == name; });
  CONTORT_ASSERT(found != checks.end());
  return *found;
}

}  // namespace contort
