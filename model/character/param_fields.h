// The JSON form of a parameter's value. Included from .cpp files only.
#pragma once

#include "model/character/action_desc.h"
#include "model/core/json_fields.h"

namespace contort::json_fields {

// A parameter is written as a number, three numbers, or a word; the action's declaration decides which one is valid.
template <>
struct Codec<ParamValue> {
  static void read(const Json& in, const Rule&, ParamValue& out, ReadContext& c) {
    if (in.is_number())
      Codec<double>::read(in, Rule{}, out.emplace<double>(), c);
    else if (in.is_array())
      Codec<Vec3>::read(in, Rule{}, out.emplace<Vec3>(), c);
    else if (in.is_string())
      Codec<std::string>::read(in, Rule{}, out.emplace<std::string>(), c);
    else
      c.fail("wrong_type", "found " + kind_of(in) + ", expected a number, three numbers, or a name");
  }
  static Json write(const ParamValue& v, const Rule& r) {
    return std::visit([&](const auto& x) { return Codec<std::decay_t<decltype(x)>>::write(x, r); }, v);
  }
  static Json schema(const Rule& r) {
    return {{"anyOf", Json::array({Codec<double>::schema(r), Codec<Vec3>::schema(r), Codec<std::string>::schema(r)})}};
  }
};

}  // namespace contort::json_fields
