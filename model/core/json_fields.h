// All JSON goes through this header. A struct states its fields once, as member pointers with limits and help:
//
//   template <class V> void fields(V& v, const Clip*) {
//     v.field("speed", &Clip::speed, {.low = 0.1, .high = 10}, "Progress speed; 2 plays twice as fast.");
//   }
//
// and three visitors walk that list: a strict reader, a canonical writer, and a schema writer. So a file, its limits
// and its published schema cannot disagree. Included from .cpp files only.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "model/core/json_value_fields.h"
#include "model/core/math.h"

namespace contort::json_fields {

template <class T>
struct Codec;

// ---- leaves

template <>
struct Codec<double> {
  static void read(const Json& in, const Rule& r, double& out, ReadContext& c) { read_number(in, r, out, c); }
  static Json write(double v, const Rule&) { return std::isnan(v) ? Json("nan") : Json(v); }
  static Json schema(const Rule& r) { return number_schema(r, false); }
};
template <>
struct Codec<int> {
  static void read(const Json& in, const Rule& r, int& out, ReadContext& c) { read_integer(in, r, out, c); }
  static Json write(int v, const Rule&) { return v; }
  static Json schema(const Rule& r) { return number_schema(r, true); }
};
template <>
struct Codec<std::int64_t> {  // up to 2^53, as in a double
  static void read(const Json& in, const Rule& r, std::int64_t& out, ReadContext& c) { read_integer64(in, r, out, c); }
  static Json write(std::int64_t v, const Rule&) { return v; }
  static Json schema(const Rule& r) { return number_schema(r, true); }
};
template <>
struct Codec<bool> {
  static void read(const Json& in, const Rule&, bool& out, ReadContext& c) { read_bool(in, out, c); }
  static Json write(bool v, const Rule&) { return v; }
  static Json schema(const Rule&) { return {{"type", "boolean"}}; }
};
template <>
struct Codec<std::string> {
  static void read(const Json& in, const Rule& r, std::string& out, ReadContext& c) { read_text(in, r, out, c); }
  static Json write(const std::string& v, const Rule&) { return v; }
  static Json schema(const Rule& r) { return text_schema(r); }
};

template <class E>
requires std::is_enum_v<E>
struct Codec<E> {
  static void read(const Json& in, const Rule& r, E& out, ReadContext& c) {
    int index = 0;
    if (read_choice(in, r.names, index, c)) out = static_cast<E>(index);
  }
  static Json write(E v, const Rule& r) { return std::string(r.names[static_cast<std::size_t>(v)]); }
  static Json schema(const Rule& r) { return names_schema(r.names); }
};

// A field that may be left out and has no default.
template <class T>
struct Codec<std::optional<T>> {
  static void read(const Json& in, const Rule& r, std::optional<T>& out, ReadContext& c) {
    Codec<T>::read(in, r, out.emplace(), c);
  }
  static Json write(const std::optional<T>& v, const Rule& r) { return v ? Codec<T>::write(*v, r) : Json(); }
  static Json schema(const Rule& r) { return Codec<T>::schema(r); }
};

// ---- sequences

template <class T>
void read_element(const Json& in, std::size_t index, const Rule& rule, T& out, ReadContext& context) {
  context.push(std::to_string(index));
  Codec<T>::read(in[index], rule, out, context);
  context.pop();
}

template <>
struct Codec<Vec3> {
  static void read(const Json& in, const Rule& r, Vec3& out, ReadContext& c) {
    if (!expect_array(in, 3, 3, c)) return;
    for (int i = 0; i < 3; ++i) read_element(in, static_cast<std::size_t>(i), r, out[i], c);
  }
  static Json write(const Vec3& v, const Rule&) { return {v.x, v.y, v.z}; }
  static Json schema(const Rule& r) {
    return {{"type", "array"}, {"items", number_schema(r, false)}, {"minItems", 3}, {"maxItems", 3}};
  }
};

template <class T, std::size_t N>
struct Codec<std::array<T, N>> {
  static void read(const Json& in, const Rule& r, std::array<T, N>& out, ReadContext& c) {
    if (!expect_array(in, N, N, c)) return;
    for (std::size_t i = 0; i < N; ++i) read_element(in, i, r, out[i], c);
  }
  static Json write(const std::array<T, N>& v, const Rule&) { return v; }
  static Json schema(const Rule& r) {
    return {{"type", "array"}, {"items", Codec<T>::schema(r)}, {"minItems", N}, {"maxItems", N}};
  }
};

template <class T>
struct Codec<std::vector<T>> {
  static void read(const Json& in, const Rule& r, std::vector<T>& out, ReadContext& c) {
    if (!expect_array(in, 0, r.max_count, c)) return;
    out.assign(in.size(), T{});
    for (std::size_t i = 0; i < in.size() && c.ok(); ++i) read_element(in, i, r, out[i], c);
  }
  static Json write(const std::vector<T>& v, const Rule& r) {
    Json list = Json::array();
    for (const T& element : v) list.push_back(Codec<T>::write(element, r));
    return list;
  }
  static Json schema(const Rule& r) {
    return {{"type", "array"}, {"items", Codec<T>::schema(r)}, {"maxItems", r.max_count}};
  }
};

// A map; its keys are types that are written as text.
template <class K, class T>
struct Codec<std::map<K, T>> {
  static void read(const Json& in, const Rule& r, std::map<K, T>& out, ReadContext& c) {
    if (!expect_object(in, c)) return;
    if (in.size() > r.max_count)
      return c.fail("too_many",
                    "found " + std::to_string(in.size()) + " entries, allowed are " + std::to_string(r.max_count));
    for (const auto& [key, value] : in.items()) {
      if (!c.ok()) return;
      c.push(key);
      K checked;
      Codec<K>::read(Json(key), Rule{.text = r.key_text}, checked, c);
      if (c.ok()) Codec<T>::read(value, r, out[checked], c);
      c.pop();
    }
  }
  static Json write(const std::map<K, T>& v, const Rule& r) {
    Json object = Json::object();
    for (const auto& [key, value] : v) {
      const std::string text = Codec<K>::write(key, r);
      object[text] = Codec<T>::write(value, r);
    }
    return object;
  }
  static Json schema(const Rule& r) {
    return {{"type", "object"},
            {"additionalProperties", Codec<T>::schema(r)},
            {"maxProperties", r.max_count},
            {"propertyNames", text_schema(Rule{.text = r.key_text})}};
  }
};

// ---- structs: the three visitors of a field list

template <class S>
class FieldReader {
 public:
  FieldReader(const Json& in, S& out, ReadContext& context) : in_(in), out_(out), context_(context) {}

  template <class T>
  void field(std::string_view name, T S::*member, const Rule& rule, std::string_view) {
    known_.push_back(name);
    if (!context_.ok()) return;
    const auto found = in_.find(name);
    if (found == in_.end()) {
      if (rule.required) context_.fail("missing_field", "\"" + std::string(name) + "\" is required");
      return;
    }
    context_.push(name);
    Codec<T>::read(*found, rule, out_.*member, context_);
    context_.pop();
  }
  void constant(std::string_view name, std::string_view value) {
    known_.push_back(name);
    if (!context_.ok()) return;
    const auto found = in_.find(name);
    if (found != in_.end() && *found == value) return;
    if (found != in_.end()) context_.push(name);
    const std::string got = found == in_.end()   ? "nothing"
                            : found->is_string() ? quoted(found->get<std::string>())
                                                 : kind_of(*found);
    context_.fail("wrong_" + std::string(name), "found " + got + ", expected \"" + std::string(value) + "\"" +
                                                    (found == in_.end() ? " in \"" + std::string(name) + "\"" : ""));
    if (found != in_.end()) context_.pop();
  }
  void finish() {
    if (context_.ok()) refuse_unknown(in_, known_, context_);
  }

 private:
  const Json& in_;
  S& out_;
  ReadContext& context_;
  std::vector<std::string_view> known_;
};

template <class S>
// Fields at their default are left out, so that files stay short and a new field changes no old text.
class FieldWriter {
 public:
  explicit FieldWriter(const S& value) : value_(value) {}
  template <class T>
  void field(std::string_view name, T S::*member, const Rule& rule, std::string_view) {
    static const S defaults{};
    if (rule.required || !(value_.*member == defaults.*member))
      out_[std::string(name)] = Codec<T>::write(value_.*member, rule);
  }
  void constant(std::string_view name, std::string_view value) { out_[std::string(name)] = std::string(value); }
  Json take() { return std::move(out_); }

 private:
  const S& value_;
  Json out_ = Json::object();
};

template <class S>
class FieldSchema {
 public:
  template <class T>
  void field(std::string_view name, T S::*member, const Rule& rule, std::string_view help) {
    static const S defaults{};
    Json property = Codec<T>::schema(rule);
    property["description"] = std::string(help);
    if (rule.required) required_.push_back(std::string(name));
    Json preset = Codec<T>::write(defaults.*member, rule);
    if (!rule.required && !preset.is_null()) property["default"] = std::move(preset);
    properties_[std::string(name)] = std::move(property);
  }
  void constant(std::string_view name, std::string_view value) {
    properties_[std::string(name)] = {{"const", std::string(value)}};
    required_.push_back(std::string(name));
  }
  Json take() {
    return {{"type", "object"}, {"properties", properties_}, {"required", required_}, {"additionalProperties", false}};
  }

 private:
  Json properties_ = Json::object();
  Json required_ = Json::array();
};

// Not inline, so that `extern template` keeps a large struct from being compiled again in each struct that contains it.
template <class S>
struct Codec {
  static void read(const Json& in, const Rule&, S& out, ReadContext& context);
  static Json write(const S& value, const Rule&);
  static Json schema(const Rule&);
};

template <class S>
void Codec<S>::read(const Json& in, const Rule&, S& out, ReadContext& context) {
  if (!expect_object(in, context)) return;
  FieldReader<S> reader(in, out, context);
  fields(reader, static_cast<const S*>(nullptr));
  reader.finish();
}

template <class S>
Json Codec<S>::write(const S& value, const Rule&) {
  FieldWriter<S> writer(value);
  fields(writer, static_cast<const S*>(nullptr));
  return writer.take();
}

template <class S>
Json Codec<S>::schema(const Rule&) {
  FieldSchema<S> schema;
  fields(schema, static_cast<const S*>(nullptr));
  return schema.take();
}

// A variant of structs. Each writes its own `constant("type", …)`; type_name(const T*) returns its name.
template <class... Ts>
struct Codec<std::variant<Ts...>> {
  using V = std::variant<Ts...>;
  static void read(const Json& in, const Rule& r, V& out, ReadContext& c) {
    if (!expect_object(in, c)) return;
    const std::array<std::string_view, sizeof...(Ts)> names = {type_name(static_cast<const Ts*>(nullptr))...};
    const auto type = in.find("type");
    if (type == in.end()) return c.fail("missing_field", "\"type\" is required");
    c.push("type");
    int index = 0;
    const bool known = read_choice(*type, names, index, c);
    c.pop();
    if (known) read_alternative<Ts...>(in, r, out, index, c);
  }
  static Json write(const V& v, const Rule& r) {
    return std::visit([&](const auto& x) { return Codec<std::decay_t<decltype(x)>>::write(x, r); }, v);
  }
  static Json schema(const Rule& r) { return {{"oneOf", Json::array({Codec<Ts>::schema(r)...})}}; }

 private:
  template <class First, class... Rest>
  static void read_alternative(const Json& in, const Rule& r, V& out, int index, ReadContext& c) {
    if (index == 0) return Codec<First>::read(in, r, out.template emplace<First>(), c);
    if constexpr (sizeof...(Rest) > 0) read_alternative<Rest...>(in, r, out, index - 1, c);
  }
};

// ---- whole documents

// Reads a document. Fields that the text does not have keep their values in `value`.
template <class S>
Result<S> read_tree(const Json& tree, std::string_view area, S value = {}) {
  ReadContext context(area);
  Codec<S>::read(tree, Rule{}, value, context);
  if (!context.ok()) return context.take_issue();
  return value;
}

template <class S>
Result<S> read_document(std::string_view text, std::string_view area, S value = {}) {
  const Result<Json> tree = parse_document(text);
  if (!tree) return tree.issue();
  return read_tree<S>(*tree, area, std::move(value));
}

// Prints canonical text: keys sorted by byte, no spaces, shortest numbers that read back to the same bits.
template <class S>
std::string write_canonical(const S& value) {
  return Codec<S>::write(value, Rule{}).dump();
}

// Prints the value with indentation, for people.
template <class S>
std::string write_pretty(const S& value) {
  return Codec<S>::write(value, Rule{}).dump(2) + "\n";
}

template <class S>
std::string write_schema(std::string_view title) {
  Json schema = Codec<S>::schema(Rule{});
  schema["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  schema["title"] = std::string(title);
  return schema.dump(2) + "\n";
}

}  // namespace contort::json_fields
