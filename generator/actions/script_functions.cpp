#include "generator/actions/script_functions.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <lua.hpp>

#include "generator/actions/script.h"
#include "model/core/detmath.h"
#include "model/core/math.h"

namespace contort {

namespace {

const ScriptInput& input_of(lua_State* lua) {
  const ScriptInput* in = nullptr;
  std::memcpy(&in, lua_getextraspace(lua), sizeof in);
  return *in;
}

double number(lua_State* lua, int place) { return luaL_checknumber(lua, place); }

int answer(lua_State* lua, double value) {
  lua_pushnumber(lua, value);
  return 1;
}

int lua_abs(lua_State* lua) { return answer(lua, std::abs(number(lua, 1))); }
int lua_floor(lua_State* lua) { return answer(lua, std::floor(number(lua, 1))); }
int lua_ceil(lua_State* lua) { return answer(lua, std::ceil(number(lua, 1))); }
int lua_sqrt(lua_State* lua) { return answer(lua, std::sqrt(number(lua, 1))); }
int lua_exp(lua_State* lua) { return answer(lua, det::exp(number(lua, 1))); }
int lua_sin(lua_State* lua) { return answer(lua, det::sin(number(lua, 1))); }
int lua_cos(lua_State* lua) { return answer(lua, det::cos(number(lua, 1))); }
int lua_asin(lua_State* lua) { return answer(lua, det::asin(number(lua, 1))); }
int lua_acos(lua_State* lua) { return answer(lua, det::acos(number(lua, 1))); }
int lua_atan2(lua_State* lua) { return answer(lua, det::atan2(number(lua, 1), number(lua, 2))); }
int lua_rad(lua_State* lua) { return answer(lua, number(lua, 1) * kRadPerDeg); }
int lua_deg(lua_State* lua) { return answer(lua, number(lua, 1) / kRadPerDeg); }
int lua_min(lua_State* lua) { return answer(lua, std::min(number(lua, 1), number(lua, 2))); }
int lua_max(lua_State* lua) { return answer(lua, std::max(number(lua, 1), number(lua, 2))); }

int lua_clamp(lua_State* lua) {
  return answer(lua, std::max(number(lua, 2), std::min(number(lua, 3), number(lua, 1))));
}

// From 0 to 1 without a jerk at either end, as blends go.
int lua_smooth(lua_State* lua) {
  const double u = std::max(0.0, std::min(1.0, number(lua, 1)));
  return answer(lua, u * u * u * (10.0 + u * (6.0 * u - 15.0)));
}

// The height of the ground over the plane on which the character stands at rest, at (x, z) in its frame.
int lua_ground_height(lua_State* lua) {
  const ScriptInput& in = input_of(lua);
  Vec3 point = in.world_from_character * Vec3(number(lua, 1), 0.0, number(lua, 2));
  point.y = in.environment->height_at(point.x, point.z);
  return answer(lua, (inverse(in.world_from_character) * point).y);
}

// From a point (x, y, z) in the character's frame to the nearest obstacle; infinite without obstacles.
int lua_obstacle_distance(lua_State* lua) {
  const ScriptInput& in = input_of(lua);
  const Vec3 point(number(lua, 1), number(lua, 2), number(lua, 3));
  return answer(lua, in.environment->nearest_obstacle(in.world_from_character * point).distance_m);
}

int refuse_name(lua_State* lua) {
  return luaL_error(lua, "the action does not set \"%s\"; a value of the script's own is declared with local",
                    lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "?");
}

constexpr luaL_Reg kFunctions[] = {
    {"abs", lua_abs},     {"floor", lua_floor}, {"ceil", lua_ceil},   {"sqrt", lua_sqrt},
    {"exp", lua_exp},     {"sin", lua_sin},     {"cos", lua_cos},     {"asin", lua_asin},
    {"acos", lua_acos},   {"atan2", lua_atan2}, {"rad", lua_rad},     {"deg", lua_deg},
    {"min", lua_min},     {"max", lua_max},     {"clamp", lua_clamp}, {"smooth", lua_smooth},
    {"ground_height_m", lua_ground_height},     {"obstacle_distance_m", lua_obstacle_distance},
    {nullptr, nullptr},
};

}  // namespace

int push_script_functions(lua_State* lua) {
  lua_newtable(lua);
  lua_newtable(lua);
  luaL_setfuncs(lua, kFunctions, 0);
  lua_pushnumber(lua, kPi), lua_setfield(lua, -2, "pi");
  lua_setfield(lua, -2, "__index");
  lua_pushcfunction(lua, refuse_name), lua_setfield(lua, -2, "__newindex");
  return 1;
}

void set_script_input(lua_State* lua, const ScriptInput& in) {
  const ScriptInput* address = &in;
  std::memcpy(lua_getextraspace(lua), &address, sizeof address);
}

}  // namespace contort
