#include "model/core/json_fields.h"

#include <algorithm>
#include <set>

#include "model/core/inside_folder.h"
#include "model/core/nearest.h"

namespace contort::json_fields {

namespace {

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "\"" : ", \"") + std::string(name) + "\"";
  return text;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

bool is_hex(std::string_view text) {
  return text.size() <= (1 << 18) && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_file(std::string_view text, const Rule& rule) {
  return is_file_name(text) && text.size() <= 200 && text.starts_with(rule.begins) && text.ends_with(rule.ends) &&
         text.size() > rule.begins.size() + rule.ends.size();
}

bool accepts(const std::string& text, const Rule& rule) {
  if (text.empty())
    return rule.may_be_empty || rule.text == Text::prose || (rule.text == Text::hex && rule.digits == 0);
  switch (rule.text) {
    case Text::name: return is_name(text);
    case Text::label: return text.size() <= 200;
    case Text::prose: return text.size() <= 4000;
    case Text::hex: return is_hex(text) && (rule.digits == 0 || text.size() == rule.digits);
    case Text::file: return is_file(text, rule);
  }
  return false;
}

std::string allowed_text(const Rule& rule) {
  switch (rule.text) {
    case Text::name: return "a name of 1 to 64 characters a-z, 0-9 and _";
    case Text::label: return "1 to 200 bytes";
    case Text::prose: return "up to 4000 bytes";
    case Text::hex:
      return (rule.digits == 0 ? std::string() : std::to_string(rule.digits) + " ") + "digits 0-9 and a-f";
    case Text::file:
      return "the name of a file in the same folder" +
             (rule.begins.empty() ? std::string() : ", " + std::string(rule.begins) + "…" + std::string(rule.ends));
  }
  return "";
}

// Makes the parser's message safe. It quotes the input: up to a megabyte for one number, or bytes that are not UTF-8.
std::string plain(const std::string& message) {
  std::string text = message.substr(0, 300);
  for (char& c : text)
    if (c < 0x20 || c > 0x7e) c = '?';
  return message.size() > 300 ? text + "…" : text;
}

std::string range_text(const Rule& rule) { return "[" + shortest(rule.low) + ", " + shortest(rule.high) + "]"; }

// Greatest number of keys of an object; objects with counts of a run have thousands.
constexpr std::size_t kMaxKeys = 100'000;

// Checks a document before the tree is built: depth, number of values, duplicate keys. A callback of the parser would
// be too slow: with one, each object of a list checks all objects before it.
class DocumentGuard final : public Json::json_sax_t {
 public:
  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool start_array(std::size_t) override { return count() && open(); }
  bool end_array() override { return --depth_, true; }
  bool start_object(std::size_t) override { return keys_.emplace_back(), count() && open(); }
  bool end_object() override { return keys_.pop_back(), --depth_, true; }
  bool key(string_t& name) override {
    if (keys_.back().size() == kMaxKeys)
      return refuse("too_large", "an object of more keys than the allowed " + std::to_string(kMaxKeys));
    if (keys_.back().insert(name).second) return count();
    return refuse("duplicate_key", "the key " + json_fields::quoted(name) + " stands twice in one object");
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    const std::string what = error.what();  // "[json.exception.…] parse error at line 1, …"
    const std::size_t start = what.find("] ");
    return refuse("syntax", plain(start == std::string::npos ? what : what.substr(start + 2)));
  }
  const Issue& issue() const { return issue_; }

 private:
  bool refuse(const char* code, std::string text) {
    issue_ = {std::string("json.") + code, "", std::move(text)};
    return false;
  }
  bool count() {
    return ++values_ <= kMaxValues || refuse("too_large", "more values than the allowed " + std::to_string(kMaxValues));
  }
  bool open() { return ++depth_ <= kMaxDepth || refuse("too_deep", "nested deeper than " + std::to_string(kMaxDepth)); }

  int depth_ = 0;
  std::size_t values_ = 0;
  std::vector<std::set<std::string>> keys_;  // keys of the open objects
  Issue issue_;
};

}  // namespace

void ReadContext::push(std::string_view token) {
  std::string escaped;  // RFC 6901
  for (const char c : token) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  path_.push_back(std::move(escaped));
}

void ReadContext::fail(std::string_view code, std::string text) {
  if (!ok()) return;
  std::string pointer;
  for (const std::string& token : path_) pointer += "/" + token;
  issue_ = {area_ + "." + std::string(code), std::move(pointer), std::move(text)};
}

Result<Json> parse_document(std::string_view text) {
  if (text.size() > kMaxDocumentBytes)
    return Issue{"json.too_large", "",
                 std::to_string(text.size()) + " bytes, allowed are " + std::to_string(kMaxDocumentBytes)};
  DocumentGuard guard;
  if (!Json::sax_parse(text, &guard)) return guard.issue();
  return Json::parse(text);
}

std::string kind_of(const Json& value) {
  switch (value.type()) {
    case Json::value_t::null: return "null";
    case Json::value_t::object: return "an object";
    case Json::value_t::array: return "a list";
    case Json::value_t::string: return "a text";
    case Json::value_t::boolean: return "true or false";
    default: return "a number";
  }
}

std::string quoted(const std::string& text) {
  const std::string shown = Json(text.substr(0, 60)).dump(-1, ' ', true, Json::error_handler_t::replace);
  return text.size() > 60 ? shown + "…" : shown;
}

std::string shortest(double value) {
  if (value == std::floor(value) && std::fabs(value) < 1e15) return std::to_string(static_cast<long long>(value));
  return Json(value).dump();
}

std::string compact_text(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool read_number(const Json& in, const Rule& rule, double& out, ReadContext& context) {
  if (rule.may_be_nan && in == "nan") return out = std::numeric_limits<double>::quiet_NaN(), true;
  if (!in.is_number()) return context.fail("wrong_type", "found " + kind_of(in) + ", expected a number"), false;
  const double value = in.get<double>();
  if (!(value >= rule.low && value <= rule.high) || !std::isfinite(value))
    return context.fail("out_of_range", "found " + shortest(value) + ", allowed is " + range_text(rule)), false;
  out = value == 0.0 ? 0.0 : value;  // -0 becomes 0
  return true;
}

bool read_integer64(const Json& in, const Rule& rule, std::int64_t& out, ReadContext& context) {
  double value = 0.0;
  if (!read_number(in, rule, value, context)) return false;
  if (value != std::floor(value) || std::fabs(value) > 0x1p53)
    return context.fail("wrong_type", "found " + shortest(value) + ", expected a whole number"), false;
  out = static_cast<std::int64_t>(value);
  return true;
}

bool read_integer(const Json& in, const Rule& rule, int& out, ReadContext& context) {
  Rule narrow = rule;
  narrow.low = std::max(rule.low, -2147483647.0);
  narrow.high = std::min(rule.high, 2147483647.0);
  std::int64_t value = 0;
  if (!read_integer64(in, narrow, value, context)) return false;
  out = static_cast<int>(value);
  return true;
}

bool read_bool(const Json& in, bool& out, ReadContext& context) {
  if (!in.is_boolean()) return context.fail("wrong_type", "found " + kind_of(in) + ", expected true or false"), false;
  out = in.get<bool>();
  return true;
}

bool read_text(const Json& in, const Rule& rule, std::string& out, ReadContext& context) {
  if (!in.is_string()) return context.fail("wrong_type", "found " + kind_of(in) + ", expected a text"), false;
  const std::string& text = in.get_ref<const std::string&>();
  if (!accepts(text, rule))
    return context.fail("bad_text", "found " + quoted(text) + ", allowed is " + allowed_text(rule)), false;
  out = text;
  return true;
}

bool read_choice(const Json& in, std::span<const std::string_view> names, int& out, ReadContext& context) {
  if (!in.is_string())
    return context.fail("wrong_type", "found " + kind_of(in) + ", expected one of " + joined(names)), false;
  const auto found = std::find(names.begin(), names.end(), in.get_ref<const std::string&>());
  if (found == names.end())
    return context.fail("unknown_name", "found " + quoted(in.get<std::string>()) + ", allowed are " + joined(names) +
                                            did_you_mean(in.get_ref<const std::string&>(), joined(names))),
           false;
  out = static_cast<int>(found - names.begin());
  return true;
}

bool expect_array(const Json& in, std::size_t low, std::size_t high, ReadContext& context) {
  if (!in.is_array()) return context.fail("wrong_type", "found " + kind_of(in) + ", expected a list"), false;
  if (in.size() >= low && in.size() <= high) return true;
  const std::string allowed = low == high ? std::to_string(low) : std::to_string(low) + " to " + std::to_string(high);
  context.fail(low == high ? "wrong_type" : "too_many",
               "found " + std::to_string(in.size()) + " entries, allowed are " + allowed);
  return false;
}

bool expect_object(const Json& in, ReadContext& context) {
  if (!in.is_object()) return context.fail("wrong_type", "found " + kind_of(in) + ", expected an object"), false;
  return true;
}

void refuse_unknown(const Json& in, std::span<const std::string_view> known, ReadContext& context) {
  for (const auto& [key, value] : in.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    context.push(key);
    context.fail("unknown_field",
                 "found " + quoted(key) + ", allowed are " + joined(known) + did_you_mean(key, joined(known)));
    context.pop();
    return;
  }
}

Json number_schema(const Rule& rule, bool integer) {
  Json schema = {{"type", integer ? "integer" : "number"}};
  if (std::isfinite(rule.low)) schema["minimum"] = rule.low;
  if (std::isfinite(rule.high)) schema["maximum"] = rule.high;
  return schema;
}

namespace {

std::string hex_pattern(const Rule& rule) {
  return rule.digits == 0 ? "^[0-9a-f]*$" : "^[0-9a-f]{" + std::to_string(rule.digits) + "}$";
}

// The pattern excludes "." and ".." unless a fixed beginning or ending does.
std::string file_pattern(const Rule& rule) {
  std::string end(rule.ends);
  if (end.starts_with('.')) end.insert(0, "\\");
  const std::string name = std::string(rule.begins) + "[^/\\\\\\u0000-\\u001f\\u007f]+" + end;
  const std::string no_dots = rule.begins.empty() && rule.ends.empty() ? "(?!\\.{1,2}$)" : "";
  return rule.may_be_empty ? "^(" + no_dots + name + ")?$" : "^" + no_dots + name + "$";
}

}  // namespace

Json text_schema(const Rule& rule) {
  const int least = rule.may_be_empty ? 0 : 1;
  switch (rule.text) {
    case Text::name: return {{"type", "string"}, {"pattern", least == 0 ? "^[a-z0-9_]{0,64}$" : "^[a-z0-9_]{1,64}$"}};
    case Text::label: return {{"type", "string"}, {"minLength", least}, {"maxLength", 200}};
    case Text::prose: return {{"type", "string"}, {"maxLength", 4000}};
    case Text::hex: return {{"type", "string"}, {"pattern", hex_pattern(rule)}};
    case Text::file: return {{"type", "string"}, {"maxLength", 200}, {"pattern", file_pattern(rule)}};
  }
  return {};
}

Json names_schema(std::span<const std::string_view> names) {
  Json list = Json::array();
  for (const std::string_view name : names) list.push_back(std::string(name));
  return {{"enum", list}};
}

}  // namespace contort::json_fields
