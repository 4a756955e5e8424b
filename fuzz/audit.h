// The audit plays every action alone, over all the parameter values that it declares, on a figure that stands at rest.
// It counts for each action the clean motions, and the requests that the generator could not meet.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "corpus/evaluator.h"
#include "corpus/refusals.h"
#include "model/generator.h"
#include "model/spec/spec.h"

namespace contort {

struct AuditOptions {
  std::vector<std::string> characters;  // names in the library; empty: all
  std::vector<std::string> actions;     // empty: all
  std::vector<std::string> slots;       // empty: all
  int draws = 1000;                     // draws for each row, at least 1
  std::int64_t seed = 1;
  int jobs = 1;
  Mode dynamics = Mode::kinematic;  // how the motions are controlled
};

// A row: one action of one part on its character, with an object if the action needs one.
struct AuditRow {
  CharacterChoice character;
  std::string slot;
  std::string part;
  std::string action;
  std::string point;  // the point that the action aims or holds, such as "muzzle"; "" for actions without one
  int draws = 0;
  int clean = 0;                        // motions without a finding
  int unmet = 0;                        // motions with a request that was not met, clean or not
  std::map<std::string, int> findings;  // by check: number of motions in which it found something
  Spec worst;                          // the spec of the deepest finding; if all motions are clean, of the first unmet
                                       // request
  double depth = 0.0;                  // depth of the deepest finding in the scale of its check; 0 if all motions are
                                       // clean
  int still = 0;                       // motions in which nothing moved although no request was unmet
  std::map<std::string, int> reasons{};  // number of motions by the reason of an unmet request: shortfall_name(), or
                                         // "pose"
  Mode dynamics = Mode::kinematic;
  // The next fields are for generators that are programs of their own. If such a program ends, that is a finding of the
  // check crash, timeout or memory.
  std::map<std::string, std::string> endings{};  // by check: a sentence about the first ending
  bool worst_ends = false;                       // `worst` ends the program: it has no motion
  int refused = 0;                               // motions that it refused: neither clean nor failing
  RefusalCounts refusals{};                      // its reasons
  bool is_cut = false;                           // too many motions were late, so there are fewer draws
  bool operator==(const AuditRow&) const = default;
};

// After this many late motions of a row, no further motions of it are drawn.
inline constexpr int kMostTimeouts = 8;

// The rows that the options ask for, without results. Codes audit.unknown_character, audit.unknown_action,
// audit.unknown_slot, audit.nothing_matches and those of build_character.
Result<std::vector<AuditRow>> audit_rows(const AuditOptions& options, Generator& generator);

// Returns draw `index` of a row: one clip with one action. One number in four is at an end of its range or at its
// preset.
Spec audit_spec(const AuditRow& row, Generator& generator, std::int64_t seed, int index);

// Draws and judges. The result does not depend on options.jobs. `progress` is called with the number of finished rows.
// If a program under test ends, is late or refuses a motion, only that motion is lost. If an author's pose is itself
// out of range or in collision, that counts as an unmet request.
Result<Done> audit(const AuditOptions& options, const CheckSettings& settings, Generator& generator,
                   std::vector<AuditRow>& rows, const std::function<void(int)>& progress);

}  // namespace contort
