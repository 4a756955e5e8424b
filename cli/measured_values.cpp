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

namespace {

// A program under test says for each of its goals how near it must come.
bool has_own_limit(const Case& stored) {
  return !stored.provenance.generator.empty() && stored.expect.check == "reach_error";
}

}  // namespace

std::string MeasuredValues::text_of(const Case& stored) {
  const std::optional<Character>& character = character_of(stored);
  if (!character || has_own_limit(stored)) return "";
  const Expectation& expect = stored.expect;
  const auto measured = measured_of(*character, settings_, expect.check, expect.subject, expect.worst_margin);
  return measured ? measured_text(expect.check, expect.unit, *measured) : "";
}

std::string MeasuredValues::sentence_of(const Case& stored) {
  const Expectation& expect = stored.expect;
  if (is_abnormal_exit(expect)) return "";
  const std::optional<Character>& character = character_of(stored);
  return failed_text({expect.check, expect.subject, expect.unit, expect.worst_margin, has_own_limit(stored)},
                     character ? &*character : nullptr, settings_);
}

}  // namespace contort::cli
