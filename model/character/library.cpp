#include "model/character/library.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "model/character/action_rules.h"
#include "model/character/description.h"
#include "model/character/part_rules.h"
#include "model/character/stock_files.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort {

namespace {

template <class T>
Result<Done> insert_new(std::map<std::string, T>& into, const Result<T>& value, std::string_view area) {
  if (!value) return value.issue();
  if (!into.try_emplace(value->name, *value).second)
    return Issue{std::string(area) + ".duplicate_name", "/name", "\"" + value->name + "\" is there already"};
  return Done{};
}

Result<PartDesc> checked(Result<PartDesc> part) {
  if (!part) return part;
  if (const Result<Done> rules = check_part(*part); !rules) return rules.issue();
  return part;
}

Result<ObjectDesc> checked(Result<ObjectDesc> object) {
  if (!object) return object;
  if (const Result<Done> rules = check_object(*object); !rules) return rules.issue();
  return object;
}

Result<Done> insert_action(std::vector<ActionDesc>& into, const Result<ActionDesc>& action) {
  if (!action) return action.issue();
  if (const Result<Done> rules = check_action(*action); !rules) return rules.issue();
  for (const ActionDesc& other : into)
    if (const std::string same = clash(*action, other); !same.empty())
      return Issue{"action.duplicate_name", "/name", "\"" + action->name + "\" is there already for " + same};
  into.push_back(*action);
  // Avoids std::ranges, because clang++ 14 cannot compile the subrange that it returns.
  std::stable_partition(into.begin(), into.end(), [](const ActionDesc& a) { return a.parts.empty(); });
  return Done{};
}

// The text "contort.part/1" from {"format": "contort.part/1", …}; "" if there is none.
std::string format_of(const json_fields::Json& tree) {
  if (!tree.is_object()) return "";
  const auto format = tree.find("format");
  return format != tree.end() && format->is_string() ? format->get<std::string>() : "";
}

}  // namespace

Result<Done> add_description(std::string_view text, Library& into) {
  const Result<json_fields::Json> tree = json_fields::parse_document(text);
  if (!tree) return tree.issue();
  const std::string format = format_of(*tree);
  if (format == "contort.part/1") return insert_new(into.parts, checked(parse_part(text)), "part");
  if (format == "contort.object/1") return insert_new(into.objects, checked(parse_object(text)), "object");
  if (format == "contort.character/1") return insert_new(into.characters, parse_character(text), "character");
  if (format == "contort.action/1") return insert_action(into.actions, parse_action(text));
  return Issue{"library.wrong_format", "/format",
               "found " + json_fields::quoted(format) +
                   ", allowed are contort.part/1, contort.object/1, contort.character/1 and contort.action/1"};
}

const Library& stock_library() {
  static const Library library = [] {
    Library built;
    for (const StockFile& file : stock_files()) {
      const Result<Done> added = add_description(file.text, built);
      if (!added) throw std::logic_error("stock file " + std::string(file.name) + ": " + to_line(added.issue()));
    }
    return built;
  }();
  return library;
}

Result<Done> load_folder(const std::string& folder, Library& into) {
  std::error_code error;
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") paths.push_back(entry.path().string());
  if (error) return Issue{"library.unreadable", "", folder + ": " + error.message()};
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    if (const Result<Done> inside = check_inside(std::filesystem::path(path).parent_path().string(), path); !inside)
      return inside.issue();
    const Result<std::string> text = read_json_file(path, "a part, an object, a character or an action (JSON)");
    if (!text) return text.issue();
    if (const Result<Done> added = add_description(*text, into); !added) {
      Issue issue = added.issue();
      issue.text = path + ": " + issue.text;
      return issue;
    }
  }
  return Done{};
}

}  // namespace contort
