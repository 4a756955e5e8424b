#include "cli/engine_files.h"

#include <algorithm>

#include "model/core/files.h"
#include "model/core/json_fields.h"
#include "renders/page_call.h"

namespace contort::cli {

namespace {

using json_fields::Json;

template <class Desc>
void add_new(const std::map<std::string, Desc>& all, const std::map<std::string, Desc>& stock,
             std::string (*print)(const Desc&), Json& into) {
  for (const auto& [name, desc] : all)
    if (!stock.contains(name)) into.push_back(print(desc));
}

}  // namespace

Result<std::string> library_script(const Library& library, const Context& context) {
  Json texts = Json::array();
  if (!context.settings_file.empty()) {
    const Result<std::string> settings = read_file(context.settings_file);
    if (!settings) return settings.issue();
    texts.push_back(*settings);
  }
  const Library& stock = stock_library();
  add_new(library.parts, stock.parts, print_part, texts);
  add_new(library.objects, stock.objects, print_object, texts);
  add_new(library.characters, stock.characters, print_character, texts);
  for (const ActionDesc& action : library.actions)
    if (std::ranges::find(stock.actions, action) == stock.actions.end()) texts.push_back(print_action(action));
  return "window.contortLibrary = " + without_markup(texts.dump(-1, ' ', true, Json::error_handler_t::replace)) + ";\n";
}

}  // namespace contort::cli
