#include "generator/actions/script.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <lua.hpp>

#include "generator/actions/script_functions.h"
#include "model/core/index.h"

namespace contort {

namespace {

// Lua's allocator, with a bound on all that is in use.
void* allocate(void* used_bytes, void* block, std::size_t old_size, std::size_t new_size) {
  auto& used = *static_cast<std::size_t*>(used_bytes);
  const std::size_t freed = block == nullptr ? 0 : old_size;  // without a block, Lua passes the kind of object
  if (new_size == 0) {
    std::free(block);
    used -= freed;
    return nullptr;
  }
  if (used - freed + new_size > kMaxScriptBytes) return nullptr;
  void* moved = std::realloc(block, new_size);
  if (moved != nullptr) used = used - freed + new_size;
  return moved;
}

void stop(lua_State* lua, lua_Debug* where) {
  lua_getinfo(lua, "Sl", where);
  lua_pushfstring(lua, "%s:%d: the script takes more than %d steps", where->short_src, where->currentline,
                  kMaxScriptSteps);
  lua_error(lua);
}

// One run, as the protected function sees it. It owns nothing: Lua leaves that function by a jump.
struct Call {
  const ScriptPlan& plan;
  std::span<const double> params;
  const ScriptInput& in;
  std::span<double> row;
};

// The three numbers of a vector on the other side of the character; any other value at [0].
void mirror(Mirrored how, double* at) {
  if (how == Mirrored::opposite || how == Mirrored::point) at[0] = -at[0];
  if (how == Mirrored::rotation) at[1] = -at[1], at[2] = -at[2];
}

// Pushes what a row holds: a number, {x, y, z}, or false where a spec leaves an optional value out. It is not nil:
// setting it later would look like setting an unknown name.
void push(lua_State* lua, const ScriptPlan::Value& value, std::span<const double> row) {
  double numbers[3] = {};
  std::copy_n(row.data() + value.first, value.size(), numbers);
  mirror(value.mirrored, numbers);
  if (std::isnan(numbers[0])) return lua_pushboolean(lua, 0);
  if (value.size() == 1) return lua_pushnumber(lua, numbers[0]);
  lua_createtable(lua, value.size(), 0);
  for (int i = 0; i < value.size(); ++i) lua_pushnumber(lua, numbers[i]), lua_rawseti(lua, -2, i + 1);
}

void add_values(lua_State* lua, const std::vector<ScriptPlan::Value>& values, std::span<const double> row) {
  for (const ScriptPlan::Value& value : values) push(lua, value, row), lua_setfield(lua, -2, value.name.c_str());
}

double number_at_top(lua_State* lua, const ScriptPlan::Value& value) {
  const char* shape = value.size() == 1 ? "a number" : "{x, y, z}";
  if (lua_type(lua, -1) != LUA_TNUMBER)
    luaL_error(lua, "%s has to be %s, and the script makes it a %s", value.name.c_str(), shape, luaL_typename(lua, -1));
  const double number = lua_tonumber(lua, -1);
  if (!(number >= value.low && number <= value.high))
    luaL_error(lua, "the script sets %s to %f, allowed are %f to %f", value.name.c_str(), number, value.low, value.high);
  return number;
}

// Reads from the table on top what the script set.
void read_value(lua_State* lua, const ScriptPlan::Value& value, std::span<double> row) {
  double* at = row.data() + value.first;
  lua_getfield(lua, -1, value.name.c_str());
  if (lua_isboolean(lua, -1) && std::isnan(at[0])) {  // left out, as it was
    lua_pop(lua, 1);
    return;
  }
  if (value.size() == 1) {
    at[0] = number_at_top(lua, value);
  } else if (!lua_istable(lua, -1)) {
    number_at_top(lua, value), luaL_error(lua, "%s has to be {x, y, z}", value.name.c_str());
  } else {
    for (int i = 0; i < 3; ++i) lua_rawgeti(lua, -1, i + 1), at[i] = number_at_top(lua, value), lua_pop(lua, 1);
  }
  mirror(value.mirrored, at);
  lua_pop(lua, 1);
}

// A stack of: compiled script, table of functions, Call.
int run_protected(lua_State* lua) {
  const Call& call = *static_cast<const Call*>(lua_touserdata(lua, 3));
  lua_settop(lua, 2);
  lua_newtable(lua);  // the script's globals
  add_values(lua, call.plan.reads, call.params);
  add_values(lua, call.plan.sets, call.row);
  lua_pushnumber(lua, call.in.time_s), lua_setfield(lua, 3, "time_s");
  lua_pushnumber(lua, call.in.period_s), lua_setfield(lua, 3, "period_s");
  lua_pushnumber(lua, call.in.progress), lua_setfield(lua, 3, "progress");
  lua_pushvalue(lua, 2), lua_setmetatable(lua, 3);
  lua_pushvalue(lua, 3), lua_setupvalue(lua, 1, 1);
  lua_pushvalue(lua, 1), lua_call(lua, 0, 0);
  for (const ScriptPlan::Value& value : call.plan.sets) read_value(lua, value, call.row);
  return 0;
}

// Lua says "script:3: attempt to ...".
Issue script_issue(const char* code, std::string text) {
  constexpr std::string_view kName = "script:";
  int line = 0;
  if (text.starts_with(kName)) {
    const std::size_t end = text.find(':', kName.size());
    line = std::atoi(text.c_str() + kName.size());
    if (end != std::string::npos) text.erase(0, std::min(text.size(), end + 2));
  }
  return {code, line > 0 ? "/script/" + std::to_string(line - 1) : "/script", text};
}

}  // namespace

struct ScriptHost::State {
  std::size_t used_bytes = 0;
  lua_State* lua = nullptr;
  std::vector<std::pair<const ScriptPlan*, int>> compiled;  // with their places in Lua's registry
  int functions = LUA_NOREF;

  State() : lua(lua_newstate(allocate, &used_bytes)) {}
  ~State() {
    if (lua != nullptr) lua_close(lua);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Issue take_issue(const char* code) {
    const char* text = lua_tostring(lua, -1);
    Issue issue = script_issue(code, text == nullptr ? "no reason is given" : text);
    lua_settop(lua, 0);
    return issue;
  }

  Result<Done> set_up() {
    if (lua == nullptr) return Issue{"action.script_failed", "/script", "out of memory"};
    if (functions != LUA_NOREF) return Done{};
    lua_pushcfunction(lua, push_script_functions);
    if (lua_pcall(lua, 0, 1, 0) != LUA_OK) return take_issue("action.script_failed");
    functions = luaL_ref(lua, LUA_REGISTRYINDEX);
    return Done{};
  }

  // Leaves the script on the stack.
  Result<Done> compile(const std::string& source) {
    if (luaL_loadbufferx(lua, source.data(), source.size(), "=script", "t") == LUA_OK) return Done{};
    return take_issue("action.bad_script");
  }

  // Pushes the compiled script.
  Result<Done> push(const ScriptPlan& plan) {
    for (const auto& [known, place] : compiled)
      if (known == &plan) return lua_rawgeti(lua, LUA_REGISTRYINDEX, place), Done{};
    if (Result<Done> done = compile(plan.source); !done) return done;
    lua_pushvalue(lua, -1);
    compiled.emplace_back(&plan, luaL_ref(lua, LUA_REGISTRYINDEX));
    return Done{};
  }
};

ScriptHost::ScriptHost() = default;
ScriptHost::~ScriptHost() = default;
ScriptHost::ScriptHost(ScriptHost&&) noexcept = default;
ScriptHost& ScriptHost::operator=(ScriptHost&&) noexcept = default;

void ScriptHost::begin() { state_.reset(); }

Result<Done> ScriptHost::run(const ScriptPlan& plan, std::span<const double> params, const ScriptInput& in,
                             std::span<double> row) {
  if (!state_) state_ = std::make_unique<State>();
  if (Result<Done> done = state_->set_up(); !done) return done;
  lua_State* lua = state_->lua;
  const Call call{plan, params, in, row};
  lua_pushcfunction(lua, run_protected);
  if (Result<Done> done = state_->push(plan); !done) return done;
  lua_rawgeti(lua, LUA_REGISTRYINDEX, state_->functions);
  lua_pushlightuserdata(lua, const_cast<Call*>(&call));
  set_script_input(lua, in);
  lua_sethook(lua, stop, LUA_MASKCOUNT, kMaxScriptSteps);
  if (lua_pcall(lua, 3, 0, 0) != LUA_OK) return state_->take_issue("action.script_failed");
  return Done{};
}

Result<Done> ScriptHost::check(const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (lines[i].find('^') != std::string::npos)
      return Issue{"action.bad_script", "/script/" + std::to_string(i),
                   "a script has no ^, whose last bits depend on the machine; write x * x, sqrt(x) or exp(x)"};
  State state;
  if (state.lua == nullptr) return Issue{"action.bad_script", "/script", "out of memory"};
  return state.compile(script_text(lines));
}

}  // namespace contort
