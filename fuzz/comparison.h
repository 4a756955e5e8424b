// The difference between what two builds show for one spec (docs/reference/against.md, "Definitions").
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "checks/family.h"
#include "corpus/measurement.h"

namespace contort {

// The change of one family from the base to this build.
enum class Change { broke, worse, mended };

// The base's result for a failure of this build, from the clearest regression to the least clear one.
enum class BaseShows { passes_check, passes, milder };
std::string_view base_shows_name(BaseShows shows);  // "passes_check"

struct CompareRules {
  double tolerance = 0.1;           // smallest depth of a failure that counts if only one build shows it, in the
                                    // check's scale; >= 0
  std::vector<std::string> checks;  // checks that both builds have; families of other checks are not compared
};

struct Comparison {
  std::string refusal;                       // the reason why the base has no measurement; the other fields are then
                                             // unused
  bool moved = false;                        // the motions differ
  int first_difference = -1;                 // the first frame that differs; -1: none, or the base sent no trace
  std::string base_hash;                     // hash of the base's motion
  std::vector<Family> broke, worse, mended;  // each sorted
  bool operator==(const Comparison&) const = default;
};

// Depths of a family in this build and in the base: >= 0, infinite for a margin that is not finite, empty if it passes.
std::optional<Change> change_between(std::optional<double> depth, std::optional<double> base_depth, double tolerance);

// The depth of a family in a measurement; empty if it passes. Waived failures count only `with_waived`.
std::optional<double> depth_in(const Measurement& measured, const std::string& check, const std::string& subject,
                               bool with_waived);

// Compares two measurements of the same spec by the same checks.
Comparison compare(const std::string& character, const Measurement& ours, const Measurement& base,
                   const CompareRules& rules);

// The result of the base for a failure that broke or got worse; empty if the failure does not count. `base` may be a
// measurement of that check alone.
std::optional<BaseShows> base_shows(double depth, const std::string& check, const std::string& subject,
                                    const Measurement& base, const CompareRules& rules);

// "spec.unknown_action: …", one line.
std::string refusal_text(const Measurement& base);

}  // namespace contort
