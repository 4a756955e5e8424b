// The functions that scripts may call. They have the same bits on every machine, and cannot reach a file, a clock or
// another script.
#pragma once

struct lua_State;

namespace contort {

struct ScriptInput;

// A function of Lua: pushes the metatable of a script's globals. Through it scripts find the functions; it refuses to
// set unknown names.
int push_script_functions(lua_State* lua);

// Sets the surroundings for the functions; `in` must stay valid until the script has run.
void set_script_input(lua_State* lua, const ScriptInput& in);

}  // namespace contort
