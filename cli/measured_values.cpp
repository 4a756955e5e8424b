#include "cli/measured_values.h"

#include "checks/measured.h"
#include "model/core/hash.h"
#include "renders/measured_text.h"

namespace contort::cli {

const std::optional<Character>& MeasuredValues::character_of(const Case& stored) {
  const auto [at, is_first] = characters_.try_emplace(stored.expect.character_hash);
  if (!is_first || stored.expect.character_hash.empty()) return at->second;
  Result<Character> built = build_character(stored.spec.character, library_);
  if (built && to_hex(built->hash()) == stored.expect.character_hash) at->second = std::move(built).value();
  return at->second;
}

std::string MeasuredValues::text_of(const Case& stored) {
  const std::optional<Character>& character = character_of(stored);
  if (!character) return "";
  const Expectation& expect = stored.expect;
  // A program under test declares the tolerance of each of its goals, so the limit is unknown here.
  if (!stored.provenance.generator.empty() && expect.check == "reach_error") return "";
  const auto measured = measured_of(*character, settings_, expect.check, expect.subject, expect.worst_margin);
  return measured ? measured_text(expect.check, expect.unit, *measured) : "";
}

}  // namespace contort::cli
