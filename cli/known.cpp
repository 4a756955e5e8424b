#include "cli/known.h"

#include <algorithm>
#include <cstdio>

#include "cli/print.h"
#include "corpus/condition.h"
#include "corpus/request.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

using json_fields::Json;

bool any_holds(const known::KnownRule& rule, const Spec& spec, const Character& character, const Offers& offers) {
  const std::vector<std::string> needs(rule.needs.begin(), rule.needs.end());
  return std::ranges::any_of(requests_of(spec, needs, character, offers), [&](const SpecRequest& request) {
    const std::vector<known::Value> values = known_values(request);
    return known::holds(rule, {request.character, values});
  });
}

Json known_json(const std::vector<const known::KnownRule*>& known) {
  Json list = Json::array();
  for (const known::KnownRule* rule : known)
    list.push_back({{"cause", rule->cause},
                    {"text", rule->text},
                    {"precision", rule->precision},
                    {"recall", rule->recall}});
  return {{"known", list}};
}

void print_known(const std::vector<const known::KnownRule*>& known, std::size_t rules) {
  for (const known::KnownRule* rule : known)
    std::printf("KNOWN %s  %s\n", std::string(rule->cause).c_str(), printable(std::string(rule->text)).c_str());
  std::printf("%s\nRESULT known=%zu rules=%zu\n",
              known.empty() ? "OK: no rule says that this goes wrong." : "This is known to go wrong.", known.size(),
              rules);
}

}  // namespace

void check_known(const SpecInput& input, const std::string& corpus, bool as_json, Context& context) {
  Generator* generator = context.load_generator();
  if (generator == nullptr) return;
  const Result<Corpus> opened = Corpus::open(corpus);
  if (!opened) return context.fail(opened.issue());
  Result<std::vector<Condition>> conditions = conditions_of(*opened);
  if (!conditions) return context.fail(conditions.issue());
  if (conditions->empty())
    return context.fail({"corpus.no_rules", "", corpus + " has no rules yet; contort explain learns them"});
  if (const Result<Admission> admitted = generator->admit(input.spec); !admitted)
    return context.fail(admitted.issue());
  const Result<Character> character = build_character(input.spec.character, *generator->manifest().library);
  if (!character) return context.fail(character.issue());
  const RuleTable table(std::move(conditions).value());
  std::vector<const known::KnownRule*> known;
  for (const known::KnownRule& rule : table.rules())
    if (any_holds(rule, input.spec, *character, generator->offers(*character))) known.push_back(&rule);
  context.exit_code = known.empty() ? kClean : kFindings;
  if (!as_json) return print_known(known, table.rules().size());
  std::printf("%s\n", known_json(known).dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace contort::cli
