// The cause of a failure. People read causes, while buckets are tracked. docs/reference/causes.md describes the
// experiments that find it (fuzz/culprits.h).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "checks/check.h"
#include "model/spec/spec.h"

namespace contort {

// The version of the rules that find causes and make their ids.
inline constexpr int kCauseScheme = 1;

enum class CauseScope : std::uint8_t {
  alone,    // one action fails by itself
  company,  // several actions fail only together
  setting,  // fails without any action, or because of an impact or a load on a simulated figure
};
std::span<const std::string_view> cause_scope_names();  // in the order of the enum

struct Cause {
  int scheme = 0;  // kCauseScheme of the rules that found it; 0: not found yet
  CauseScope scope = CauseScope::alone;
  std::vector<std::string> names{};  // alone: the culprit; company: the actions, sorted; setting: surroundings, sorted
  std::vector<std::string> also{};   // alone: other actions that fail by themselves, too; setting: actions; sorted
  bool is_simulated = false;       // the minimal spec needs dynamics
  bool operator==(const Cause&) const = default;
};

// Returns one spec for each action, in the order of the spec's text: the action with the sequence and clip that hold
// it, without other actions.
struct LoneAction {
  std::string action;
  SequenceDesc sequence;
};
std::vector<LoneAction> lone_actions_of(const Spec& spec);

// The surroundings that a spec has and that could make a figure without actions fail, sorted: "ground", "impact",
// "load", "obstacle", "recording", "swap"; "pose" if it has none.
std::vector<std::string> surroundings_of(const Spec& spec);

// Returns the cause that follows from the minimal spec alone, without experiments.
Cause cause_without_experiments(const Spec& minimal);

// The id of a cause: 12 hex digits, a hash over scheme, scope, names, kind and whether it needs dynamics.
std::string cause_id(const Cause& cause, CheckKind kind);

// The limbs of a check's subject, without sides, sorted: "arm_left/hand ~ leg_right/thigh" gives "arm" and "leg".
std::vector<std::string> limbs_of(std::string_view subject);

// Returns a failure in words for people: "Left hand goes through right thigh".
std::string failure_in_words(std::string_view check, std::string_view subject);

// The same with its cause: "Left hand goes through right thigh during aim".
std::string cause_headline(const Cause& cause, std::string_view check, std::string_view subject);

// The same for failures of one check in several places, of which the first ones are named: "Pan and tilt turn too fast
// during track". `subjects` has at least one. The environment of a spec tells a slope from other uneven ground; nullptr
// if it is unknown.
std::string cause_headline(const Cause& cause, std::string_view check, std::span<const std::string> subjects,
                           const EnvironmentDesc* environment);

}  // namespace contort
