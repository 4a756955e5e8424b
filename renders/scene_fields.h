// Makes JSON pieces of a motion for pages; docs/reference/report.md describes their fields. Included from .cpp files
// only.
#pragma once

#include <span>
#include <vector>

#include "corpus/evaluator.h"
#include "model/core/json_fields.h"
#include "renders/highlight.h"

namespace contort::scene {

using json_fields::Json;

// Rounds to a millionth, far below what is visible; null for NaN and infinite values.
Json number(double value);
Json vector(const Vec3& v);

Json colliders_json(const Character& character);
Json highlight_json(const Character& character, const Highlight& highlight);

// Returns the ground around the path of the root, in world coordinates.
Json ground_json(const Environment& environment, std::span<const Rigid> path);
Json obstacles_json(const Environment& environment);

// Returns the events of a motion, over frames. Names of actions and interrupts are known only if the generator gives
// its intent.
Json spans_json(const Execution& execution);
Json marks_json(const Execution& execution);
Json balance_json(const Motion& motion);
Json curves_json(const std::vector<MarginCurve>& curves);

}  // namespace contort::scene
