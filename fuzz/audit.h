// The audit: every action alone, over all the parameter values that it declares, on a figure that stands at rest. It
// says for each action how many of its motions are clean, and how many requests the generator could not meet.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "corpus/evaluator.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

struct AuditOptions {
  std::vector<std::string> characters;  // names in the library; empty: all
  std::vector<std::string> actions;     // empty: all
  std::vector<std::string> slots;       // empty: all
  int draws = 1000;                     // of each row, at least 1
  std::int64_t seed = 1;
  int jobs = 1;
  Mode dynamics = Mode::kinematic;  // how the motions are controlled
};

// One action of one part, as it is on its character, with an object where the action needs one.
struct AuditRow {
  CharacterChoice character;
  std::string slot;
  std::string part;
  std::string action;
  std::string point;  // the one that the action aims or holds, as "muzzle"; "" for actions without one
  int draws = 0;
  int clean = 0;                        // without a finding
  int unmet = 0;                        // with a request that was not met, clean or not
  std::map<std::string, int> findings;  // by check: the motions that have one
  Spec worst;                          // the deepest finding; where all are clean, the first unmet request
  double depth = 0.0;                  // of the deepest finding, in the scale of its check; 0 where all are clean
  int still = 0;                       // in which nothing moved, and no request was unmet
  std::map<std::string, int> reasons{};  // of unmet requests, as shortfall_name() has them, or "pose": motions with one
  Mode dynamics = Mode::kinematic;
  bool operator==(const AuditRow&) const = default;
};

// The rows that the options ask for, without results. Codes audit.unknown_character, audit.unknown_action,
// audit.unknown_slot, audit.nothing_matches and those of build_character.
Result<std::vector<AuditRow>> audit_rows(const AuditOptions& options, Generator& generator);

// Draw `index` of a row: one clip with one action. One number in four is at an end of its range or at its preset.
Spec audit_spec(const AuditRow& row, Generator& generator, std::int64_t seed, int index);

// Draws and judges. The result depends on options.jobs in nothing but time. `progress` is called with the rows done.
// Out of range or in collision by itself, a pose that an author gives counts as an unmet request.
Result<Done> audit(const AuditOptions& options, const CheckSettings& settings, Generator& generator,
                   std::vector<AuditRow>& rows, const std::function<void(int)>& progress);

}  // namespace contort
