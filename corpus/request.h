// Reads a spec as requests whose values a rule can compare (known.h, docs/reference/conditions.md).
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "corpus/cause.h"
#include "corpus/known.h"
#include "model/generator.h"

namespace contort {

struct RequestValue {
  std::string name;
  double number = 0.0;
  std::string word{};        // for a slot, a part or a choice
  bool is_mirrored = false;  // the value changes its sign for a part on the right side
  bool operator==(const RequestValue&) const = default;
};

struct SpecRequest {
  std::string character;
  std::vector<RequestValue> values;
  bool operator==(const SpecRequest&) const = default;
};

// The names of values that a request must have in order to show the cause: "reach.seconds", "impact.impulse_N_s".
std::vector<std::string> needs_of(const Cause& cause);

// The requests of a spec that have these values: one for each combination of uses of the actions that are needed, at
// most 256; if no action is needed, one request with the first use of each action. The character is the spec's, and the
// offers are its parts'.
std::vector<SpecRequest> requests_of(const Spec& spec, const std::vector<std::string>& needs,
                                     const Character& character, const Offers& offers);

// Returns the values of a request in the form of known.h; they refer to the request.
std::vector<known::Value> known_values(const SpecRequest& request);

}  // namespace contort
