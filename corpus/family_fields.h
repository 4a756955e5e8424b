// Reads and writes families in files (json_fields.h) as print_family writes them, also as keys. Included from .cpp
// files only.
#pragma once

#include "checks/family.h"
#include "model/core/json_fields.h"

namespace contort::json_fields {

// Code bad_family. An empty text means no family, if the rule allows it.
template <>
struct Codec<Family> {
  static void read(const Json& in, const Rule& r, Family& out, ReadContext& c) {
    std::string text;
    if (!read_text(in, r, text, c)) return;
    if (std::optional<Family> family = parse_family(text))
      out = std::move(*family);
    else if (!text.empty())
      c.fail("bad_family", "found " + json_fields::quoted(text) + ", expected \"check|character|subject\"");
    else
      out = {};
  }
  static Json write(const Family& v, const Rule&) { return print_family(v); }
  static Json schema(const Rule& r) { return text_schema(r); }
};

}  // namespace contort::json_fields
