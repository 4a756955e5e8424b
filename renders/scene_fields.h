// Pieces of what pages show of a motion, as JSON; docs/report.md has their fields. Included from .cpp files only.
#pragma once

#include <span>
#include <vector>

#include "corpus/evaluator.h"
#include "model/core/json_fields.h"
#include "renders/highlight.h"

namespace contort::scene {

using json_fields::Json;

// To a millionth, which is far below what can be seen; null for what no number in JSON can say.
Json number(double value);
Json vector(const Vec3& v);

Json colliders_json(const Character& character);
Json highlight_json(const Character& character, const Highlight& highlight);

// The ground around where the root goes, in the world.
Json ground_json(const Environment& environment, std::span<const Rigid> path);
Json obstacles_json(const Environment& environment);

// The events of a motion, over frames. Names of actions and interrupts are known where the generator says its intent.
Json spans_json(const Execution& execution);
Json marks_json(const Execution& execution);
Json balance_json(const Motion& motion);
Json curves_json(const std::vector<MarginCurve>& curves);

}  // namespace contort::scene
