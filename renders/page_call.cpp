#include "renders/page_call.h"

#include <algorithm>

#include "model/core/json_fields.h"

namespace contort {
namespace {

using json_fields::Json;

constexpr std::string_view kStamp = "// made of ";
constexpr std::string_view kEnd = ");\n";

std::string beginning(std::string_view function, std::string_view name) {
  const Json text = std::string(name);
  return std::string(function) + "(" + without_markup(text.dump(-1, ' ', true, Json::error_handler_t::replace)) + ", ";
}

}  // namespace

std::string without_markup(std::string_view json) {
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json)
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

std::string page_call(std::string_view function, std::string_view name, const std::string& data,
                      std::string_view stamp) {
  std::string script;
  if (!stamp.empty()) script.append(kStamp).append(stamp).append("\n");
  return script.append(beginning(function, name)).append(data).append(kEnd);
}

std::string stamp_of_page_call(std::string_view script) {
  const std::size_t end = script.find('\n');
  if (!script.starts_with(kStamp) || end == script.npos) return "";
  return std::string(script.substr(kStamp.size(), end - kStamp.size()));
}

std::string data_of_page_call(std::string_view function, std::string_view name, std::string_view script) {
  if (script.starts_with(kStamp)) script.remove_prefix(std::min(script.find('\n'), script.size() - 1) + 1);
  const std::string begin = beginning(function, name);
  if (script.size() < begin.size() + kEnd.size() || !script.starts_with(begin) || !script.ends_with(kEnd)) return "";
  script.remove_prefix(begin.size());
  script.remove_suffix(kEnd.size());
  return std::string(script);
}

}  // namespace contort
