// Replaces generator/actions/script.cpp without Lua: actions with a script are refused.
#include "generator/actions/script.h"

namespace contort {

namespace {

Issue no_scripts() {
  return {"action.no_scripts", "/script",
          "this build of Contort has no Lua, so it cannot run actions that are scripts; the program contort can"};
}

}  // namespace

struct ScriptHost::State {};

ScriptHost::ScriptHost() = default;
ScriptHost::~ScriptHost() = default;
ScriptHost::ScriptHost(ScriptHost&&) noexcept = default;
ScriptHost& ScriptHost::operator=(ScriptHost&&) noexcept = default;

void ScriptHost::begin() {}

Result<Done> ScriptHost::run(const ScriptPlan&, std::span<const double>, const ScriptInput&, std::span<double>) {
  return no_scripts();
}

Result<Done> ScriptHost::check(const std::vector<std::string>&) { return no_scripts(); }

}  // namespace contort
