// contort import: a rigged model becomes a character.
#include "import/import.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/library_folder.h"
#include "formats/gltf/read.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;
using json_fields::Json;

struct ImportCall {
  std::string model;
  std::string folder;
  ImportOptions import;
  bool no_model = false;
  bool force = false;
  bool json = false;
};

// --force is for files of an earlier import, and not for a folder that is no library.
Result<Done> refuse_existing(const ImportCall& options, const Imported& imported) {
  if (const Result<Done> own = check_library_folder(options.folder); !own) return own;
  std::error_code error;
  for (const ImportFile& file : imported.files)
    if (const std::string path = options.folder + "/" + file.name; !options.force && fs::exists(path, error))
      return Issue{"import.exists", "", path + " is there already; --force overwrites it"};
  return Done{};
}

Result<Done> write_files(const ImportCall& options, const Imported& imported) {
  for (const char* name : {"/maps", "/skins"}) {
    const std::string folder = options.folder + name;
    if (name == std::string("/skins") && !options.import.wears_model) continue;
    if (const Result<Done> inside = check_inside(options.folder, folder); !inside) return inside;
    if (const Result<Done> made = make_folder(folder); !made) return made;
  }
  for (const ImportFile& file : imported.files)
    if (const Result<Done> written = write_inside(options.folder, file.name, file.text); !written) return written;
  return Done{};
}

const char* build_of(const RiggedFigure& figure) {
  return figure.is_humanoid ? "humanoid" : figure.is_quadruped ? "quadruped" : "other";
}

void print_json(const ImportCall& options, const Imported& imported) {
  const std::string& name = imported.cut.character.name;
  const Json out = {{"file", options.model},
                    {"character", name},
                    {"folder", options.folder},
                    {"report", name + ".import.md"},
                    {"build", build_of(imported.figure)},
                    {"joints", imported.figure.bones.size()},
                    {"parts", imported.cut.parts.size()},
                    {"mass_kg", imported.mass_kg},
                    {"height_m", imported.figure.height_m},
                    {"limits",
                     {{"table", count_sources(imported, LimitSource::table)},
                      {"clips", count_sources(imported, LimitSource::clips)},
                      {"generic", count_sources(imported, LimitSource::generic)}}},
                    {"contacts", {{"rest_pose", imported.contacts.at_rest}, {"own_clips", imported.contacts.in_poses}}},
                    {"notes", imported.figure.notes}};
  std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_text(const ImportCall& options, const Imported& imported) {
  const std::string& name = imported.cut.character.name;
  std::printf("%s: %s, %.3g m, %.4g kg, %zu joints in %zu parts\n", name.c_str(), build_of(imported.figure),
              imported.figure.height_m, imported.mass_kg, imported.figure.bones.size(), imported.cut.parts.size());
  std::printf("limits: %d from the table of people, %d from its own clips, %d generic; contacts allowed: %zu\n",
              count_sources(imported, LimitSource::table), count_sources(imported, LimitSource::clips),
              count_sources(imported, LimitSource::generic), imported.contacts.pairs.size());
  std::printf("what was guessed: %s/%s.import.md\n", options.folder.c_str(), name.c_str());
  std::printf("next: contort --library %s fuzz --character %s\n", shell_quoted(options.folder).c_str(), name.c_str());
}

// A .gltf may be several files: its figure is drawn by its colliders.
bool is_one_file(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return ending == ".glb" || ending == ".vrm";
}

// Before the report, which is the last file.
Result<Done> add_model(const ImportCall& options, Imported& imported) {
  if (!options.import.wears_model) return Done{};
  Result<std::string> bytes = read_file(options.model);
  if (!bytes) return bytes.issue();
  const std::string name = "skins/" + imported.cut.character.name + ".glb";
  imported.files.insert(imported.files.end() - 1, {name, std::move(bytes).value()});
  return Done{};
}

void run(ImportCall options, Context& context) {
  if (options.import.name.empty()) options.import.name = name_of_file(options.model);
  options.import.wears_model = !options.no_model && is_one_file(options.model);
  const Result<SkinnedAsset> asset = read_skinned_gltf(options.model);
  if (!asset) return context.fail(about_file(options.model, asset.issue()));
  Result<Imported> made = import_model(*asset, options.import);
  if (!made) return context.fail(about_file(options.model, made.issue()));
  Imported imported = std::move(made).value();
  if (const Result<Done> added = add_model(options, imported); !added) return context.fail(added.issue());
  if (const Result<Done> free = refuse_existing(options, imported); !free) return context.fail(free.issue());
  if (const Result<Done> written = write_files(options, imported); !written)
    return context.fail(written.issue(), is_outside(written.issue()) ? kBadInput : kInternal);
  if (options.json) return print_json(options, imported);
  print_text(options, imported);
}

}  // namespace

void add_import(CLI::App& app, Context& context) {
  auto options = std::make_shared<ImportCall>();
  CLI::App* command = app.add_subcommand("import", "Make a character from a rigged model (.glb, .gltf)");
  command->add_option("MODEL", options->model, "Skinned model (.glb, .gltf; VRM's bones are understood)")->required();
  command->add_option("-o,--output", options->folder, "Library folder for the character's files")->required();
  command->add_option("--name", options->import.name, "Name of the character (default: the file's name)");
  CLI::Option* scale = command->add_option("--scale", options->import.metres_per_unit,
                                           "Metres in one unit of the file (default: guessed)");
  scale->check(CLI::Range(1e-6, 1e6))->check(refuse_nan);
  command->add_option("--height-m", options->import.height_m, "Height of the figure in metres (default: guessed)")
      ->check(CLI::Range(1e-3, 90.0))
      ->check(refuse_nan)
      ->excludes(scale);
  command->add_option("--skin", options->import.skin, "Index of the skin, if the file has several skeletons")
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--mesh", options->import.draw_mesh, "Draw the model's triangles instead of the colliders");
  command->add_flag("--no-model", options->no_model, "Do not copy the model; strips then show the colliders");
  command->add_flag("--force", options->force, "Overwrite existing files");
  command->add_flag("--json", options->json, "Print the result as JSON");
  command->footer(
      "Example: contort import robot.glb -o my_figures\n"
      "         contort --library my_figures fuzz --character robot");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
