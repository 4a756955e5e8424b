// contort tables: computes the aim tables of a library's characters in advance and stores them in a folder.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>

#include "cli/commands.h"
#include "cli/library_folder.h"
#include "cli/variants.h"
#include "generator/actions/action.h"
#include "generator/motion/aim_table_file.h"
#include "generator/motion/aim_tables.h"
#include "model/core/inside_folder.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

// The chains with which a part can aim, one for each of its points.
std::vector<AimChain> chains_of(const Character& character, const Part& part) {
  std::vector<AimChain> chains;
  const std::optional<Action> aim = find_action(character, part, "aim");
  if (!aim) return chains;
  const int index = static_cast<int>(&part - character.parts().data());
  for (const std::string& point : own_points(character, part))
    if (const auto bound = bind_params(*aim, character, part, {{"point", point}}); bound)
      chains.push_back(aim_chain_for(character, index, static_cast<int>(bound->front())));
  return chains;
}

// The geometries by file name, so that characters with equal arms share one.
std::map<std::string, AimGeometry> geometries_of(const Library& library) {
  std::map<std::string, AimGeometry> geometries;
  for_variants(library, [&](const Character& character) {
    for (const Part& part : character.parts())
      for (const AimChain& chain : chains_of(character, part)) {
        AimGeometry geometry = aim_geometry(character, chain);
        geometries.try_emplace(aim_table_name(geometry, {}), std::move(geometry));
      }
  });
  return geometries;
}

struct Counts {
  int built = 0;
  int kept = 0;
  int removed = 0;
};

Result<Counts> update(const std::string& folder, const std::map<std::string, AimGeometry>& geometries) {
  Counts counts;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Issue{"file.unwritable", "", folder + ": " + error.message()};
  for (const auto& [name, geometry] : geometries) {
    const std::string path = folder + "/" + name;
    if (load_aim_table(path, geometry)) {
      ++counts.kept;
      continue;
    }
    if (const Result<Done> saved = save_aim_table(AimTable::build(geometry), path); !saved) return saved.issue();
    ++counts.built;
  }
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".aim" && !geometries.contains(entry.path().filename().string()))
      counts.removed += fs::remove(entry.path(), error) ? 1 : 0;
  return counts;
}

}  // namespace

void add_tables(CLI::App& app, Context& context) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("tables", "Build the aim tables of all characters beforehand");
  command->add_option("DIR", *folder, "Library folder; the tables go to DIR/aim and are used with --library DIR")
      ->required();
  command->footer("Example: contort --library my_parts tables my_parts");
  command->callback([folder, &context] {
    const Library* library = context.load_library();
    if (library == nullptr) return;
    if (const Result<Done> own = check_library_folder(*folder); !own) return context.fail(own.issue());
    // Old files in this folder are removed.
    if (const Result<Done> inside = check_inside(*folder, *folder + "/aim"); !inside)
      return context.fail(inside.issue());
    const Result<Counts> counts = update(*folder + "/aim", geometries_of(*library));
    if (!counts) return context.fail(counts.issue(), kInternal);
    std::printf("%s/aim: %d built, %d kept, %d removed\n", folder->c_str(), counts->built, counts->kept,
                counts->removed);
  });
}

}  // namespace contort::cli
