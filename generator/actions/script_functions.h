// The functions that scripts may call. They have the same bits on every machine, and none of them can reach a file, a
// clock or another script.
#pragma once

struct lua_State;

namespace contort {

struct ScriptInput;

// A function of Lua: pushes the metatable of a script's globals, through which it finds the functions, and which
// refuses to set a name that is not there.
int push_script_functions(lua_State* lua);

// Sets the surroundings that functions ask; `in` must stay until the script has run.
void set_script_input(lua_State* lua, const ScriptInput& in);

}  // namespace contort
