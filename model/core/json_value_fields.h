// The limits of fields in JSON, the reader's position in a document, and the reading of single values. Included from
// .cpp files only, by way of json_fields.h.
#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/core/result.h"

namespace contort::json_fields {

using Json = nlohmann::json;

inline constexpr std::size_t kMaxDocumentBytes = 16 << 20;
inline constexpr int kMaxDepth = 64;
inline constexpr std::size_t kMaxValues = 2'000'000;  // the most values in a document, keys included

// name: [a-z0-9_]{1,64} · label: 1 to 200 bytes · prose: up to 4000 bytes · hex: up to 256 KiB of digits 0-9a-f ·
// file: a label that names an entry of a folder (inside_folder.h)
enum class Text { name, label, prose, hex, file };

struct Rule {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::size_t max_count = 0;                  // greatest length of a list or a map
  std::span<const std::string_view> names{};  // words of an enum, in the order of its values
  Text text = Text::name;
  Text key_text = Text::name;    // kind of a map's keys
  std::size_t digits = 0;        // the length of a hex text, if it is fixed
  std::string_view begins = "";  // the beginning of a file's name; without special characters of patterns
  std::string_view ends = "";    // the ending of a file's name; without special characters of patterns
  bool required = false;
  bool may_be_empty = false;  // for a text
  bool may_be_nan = false;    // for a number; NaN is written as the text "nan", because JSON has none
};

// The reader's present position in the document, and the first value that it could not accept.
class ReadContext {
 public:
  explicit ReadContext(std::string_view area) : area_(area) {}
  bool ok() const { return issue_.code.empty(); }
  void fail(std::string_view code, std::string text);  // at the present position; only the first failure is kept
  void push(std::string_view token);
  void pop() { path_.pop_back(); }
  Issue take_issue() { return std::move(issue_); }

 private:
  std::string area_;
  std::vector<std::string> path_;
  Issue issue_;
};

// Parses JSON text to a tree. Size, depth and number of values are limited, and duplicate keys are refused. Codes
// json.syntax, .too_large, .too_deep, .duplicate_key.
Result<Json> parse_document(std::string_view text);

// Functions that all visitors share. The .cpp has them once, instead of in every template.
std::string kind_of(const Json& value);       // "a text", "a number" … for messages
std::string quoted(const std::string& text);  // for messages: bounded, without control characters
std::string shortest(double value);           // in the form that JSON uses
// Returns the value on one line; bytes that are not UTF-8 become the replacement character.
std::string compact_text(const Json& value);
bool read_number(const Json& in, const Rule& rule, double& out, ReadContext& context);
bool read_integer(const Json& in, const Rule& rule, int& out, ReadContext& context);
bool read_integer64(const Json& in, const Rule& rule, std::int64_t& out, ReadContext& context);
bool read_bool(const Json& in, bool& out, ReadContext& context);
bool read_text(const Json& in, const Rule& rule, std::string& out, ReadContext& context);
bool read_choice(const Json& in, std::span<const std::string_view> names, int& out, ReadContext& context);
bool expect_array(const Json& in, std::size_t low, std::size_t high, ReadContext& context);
bool expect_object(const Json& in, ReadContext& context);
void refuse_unknown(const Json& in, std::span<const std::string_view> known, ReadContext& context);
Json number_schema(const Rule& rule, bool integer);
Json text_schema(const Rule& rule);
Json names_schema(std::span<const std::string_view> names);

}  // namespace contort::json_fields
