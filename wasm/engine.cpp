// The functions that a page calls (docs/internals/wasm.md). Their input is the report's descriptions, then specs; their
// output is the data of a case for the report's viewer.
#include <memory>
#include <string>
#include <vector>

#include "generator/built_in.h"
#include "model/character/description.h"
#include "renders/case_data.h"

namespace contort {

namespace {

struct Engine {
  Library library = stock_library();
  CheckSettings settings;
  std::string scripts;  // names of actions that are left out because there is no Lua
  std::unique_ptr<BuiltInGenerator> generator;
};

Engine& engine() {
  static Engine one;
  return one;
}

Result<Done> add_settings(const std::string& json) {
  Result<CheckSettings> settings = parse_settings(json);
  if (!settings) return settings.issue();
  engine().settings = std::move(settings).value();
  engine().settings.waivers.clear();
  return Done{};
}

Result<Done> add(const std::string& json) {
  Engine& to = engine();
  to.generator.reset();
  const std::size_t before = to.library.actions.size();
  const Result<Done> added = add_description(json, to.library);
  if (!added && added.issue().code == "library.wrong_format") return add_settings(json);
  if (to.library.actions.size() == before) return added;
  std::erase_if(to.library.actions, [&](const ActionDesc& action) {
    if (!action.script.empty()) to.scripts += (to.scripts.empty() ? "" : ", ") + action.name;
    return !action.script.empty();
  });
  return added;
}

std::string refused(const Issue& issue) {
  const std::string& scripts = engine().scripts;
  return case_problem("", to_line(issue) + (scripts.empty() ? "" : "; a page cannot run actions that are scripts: " +
                                                                       scripts));
}

// Plays the spec. The result shows the failure of this check and subject in it.
std::string play(const std::string& spec_json, const std::string& check, const std::string& subject) {
  const Result<Spec> spec = parse_spec(spec_json);
  if (!spec) return refused(spec.issue());
  Engine& with = engine();
  if (!with.generator) with.generator = std::make_unique<BuiltInGenerator>(with.library);
  Case changed;
  changed.spec = *spec;
  changed.expect.check = check, changed.expect.subject = subject;
  const ShownCase shown{"changed", changed};
  const Result<std::string> data = case_data("", {&shown, 1}, *with.generator, with.settings);
  return data ? *data : refused(data.issue());
}

}  // namespace

}  // namespace contort

// Both return a text that is valid until the next call.

// Adds a description or the settings of checks. Returns "", or the reason why it cannot.
extern "C" const char* contort_add(const char* json) {
  static std::string answer;
  const contort::Result<contort::Done> added = contort::add(json);
  answer = added ? "" : contort::to_line(added.issue());
  return answer.c_str();
}

// Returns JSON, contort.report_case/1.
extern "C" const char* contort_play(const char* spec_json, const char* check, const char* subject) {
  static std::string answer;
  answer = contort::play(spec_json, check, subject);
  return answer.c_str();
}
