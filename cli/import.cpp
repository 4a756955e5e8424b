// contort import: makes a character from a rigged model or a robot.
#include "import/import.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/input.h"
#include "cli/library_folder.h"
#include "formats/detect/file_format.h"
#include "formats/gltf/read.h"
#include "formats/mocap/asf.h"
#include "formats/robot/read.h"
#include "import/asf_skeleton.h"
#include "import/other_clips.h"
#include "import/robot.h"
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
  std::string srdf;
  std::string clips;
  ImportOptions import;
  bool no_model = false;
  bool force = false;
  bool json = false;
};

// --force overwrites files of an earlier import, but does not allow a folder that is no library.
Result<Done> refuse_existing(const ImportCall& options, const std::vector<ImportFile>& files) {
  if (const Result<Done> own = check_library_folder(options.folder); !own) return own;
  std::error_code error;
  for (const ImportFile& file : files)
    if (const std::string path = options.folder + "/" + file.name; !options.force && fs::exists(path, error))
      return Issue{"import.exists", "", path + " is there already; --force overwrites it"};
  return Done{};
}

Result<Done> write_files(const ImportCall& options, const std::vector<ImportFile>& files) {
  for (const ImportFile& file : files) {
    const std::size_t slash = file.name.find('/');
    if (slash == std::string::npos) continue;
    const std::string folder = options.folder + "/" + file.name.substr(0, slash);
    if (const Result<Done> inside = check_inside(options.folder, folder); !inside) return inside;
    if (const Result<Done> made = make_folder(folder); !made) return made;
  }
  for (const ImportFile& file : files)
    if (const Result<Done> written = write_inside(options.folder, file.name, file.text); !written) return written;
  return Done{};
}

// Returns false after a failure.
bool save(const ImportCall& options, const std::vector<ImportFile>& files, Context& context) {
  if (const Result<Done> free = refuse_existing(options, files); !free) return context.fail(free.issue()), false;
  const Result<Done> written = write_files(options, files);
  if (!written) context.fail(written.issue(), is_outside(written.issue()) ? kBadInput : kInternal);
  return written.ok();
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

// Makes untrusted names safe for the terminal.
std::string as_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

void print_notes(const std::vector<std::string>& notes) {
  constexpr std::size_t kShownNotes = 8;
  for (std::size_t i = 0; i < std::min(notes.size(), kShownNotes); ++i)
    std::printf("note: %s\n", as_one_line(notes[i]).c_str());
  if (notes.size() > kShownNotes) std::printf("note: and %zu more in the report\n", notes.size() - kShownNotes);
}

void print_next_steps(const ImportCall& options, const std::string& name) {
  std::printf("what was guessed: %s/%s.import.md\n", options.folder.c_str(), name.c_str());
  std::printf("next: contort --library %s fuzz --character %s\n", shell_quoted(options.folder).c_str(), name.c_str());
}

void print_text(const ImportCall& options, const Imported& imported) {
  const std::string& name = imported.cut.character.name;
  if (fs::path(options.model).stem().string() != name)
    std::printf("name: %s (--name gives another)\n", name.c_str());
  std::printf("%s: %s, %.3g m, %.4g kg, %zu joints in %zu parts\n", name.c_str(), build_of(imported.figure),
              imported.figure.height_m, imported.mass_kg, imported.figure.bones.size(), imported.cut.parts.size());
  std::printf("joint ranges: %d human defaults, %d measured in the model's clips, %d guessed; contacts allowed: %zu\n",
              count_sources(imported, LimitSource::table), count_sources(imported, LimitSource::clips),
              count_sources(imported, LimitSource::generic), imported.contacts.pairs.size());
  if (const int narrow = count_too_narrow(imported); narrow > 0)
    std::printf("%d of the human defaults %s too narrow for the model's own clips: %s.import.md names them. Widen low_deg, "
                "high_deg and swing_deg in %s_*.json, or the clips will be found to leave their ranges.\n",
                narrow, narrow == 1 ? "is" : "are", name.c_str(), name.c_str());
  print_notes(imported.figure.notes);
  print_next_steps(options, name);
}

// A .gltf may consist of several files. Its figure is then drawn by its colliders.
bool is_one_file(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return ending == ".glb" || ending == ".vrm";
}

// Adds the clips of glTF files in a folder, which show how far the model's joints turn. Returns the number of clips
// that fit.
Result<int> add_clips_of_folder(const std::string& folder, Asset& into) {
  std::error_code error;
  std::vector<std::string> paths;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    if (const std::string ending = entry->path().extension().string(); ending == ".glb" || ending == ".gltf")
      paths.push_back(entry->path().string());
  if (error) return Issue{"import.no_clips", "", folder + ": " + error.message()};
  std::sort(paths.begin(), paths.end());
  int added = 0;
  for (const std::string& path : paths) {
    const Result<Asset> other = read_gltf(path);
    if (!other) return about_file(path, other.issue());
    added += add_clips(*other, into);
  }
  if (added == 0) return Issue{"import.no_clips", "", folder + " has no clip that turns the model's joints"};
  return added;
}

// Adds the model before the report, which is the last file.
Result<Done> add_model(const ImportCall& options, Imported& imported) {
  if (!options.import.wears_model) return Done{};
  Result<std::string> bytes = read_file(options.model);
  if (!bytes) return bytes.issue();
  const std::string name = "skins/" + imported.cut.character.name + ".glb";
  imported.files.insert(imported.files.end() - 1, {name, std::move(bytes).value()});
  return Done{};
}

void print_robot_json(const ImportCall& options, const std::string& srdf, const ImportedRobot& robot) {
  const std::string& name = robot.character.name;
  const Json out = {{"file", options.model},
                    {"character", name},
                    {"folder", options.folder},
                    {"report", name + ".import.md"},
                    {"build", robot.is_skeleton ? "skeleton" : "robot"},
                    {"joints", robot.joints.size()},
                    {"parts", robot.parts.size()},
                    {"mass_kg", robot.mass_kg},
                    {"height_m", robot.height_m},
                    {"srdf", srdf.empty() ? Json() : Json(srdf)},
                    {"contacts", {{"file", robot.pairs_of_file}, {"unavoidable", robot.pairs_at_rest}}},
                    {"notes", robot.notes}};
  std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_robot_text(const ImportCall& options, const ImportedRobot& robot) {
  const std::string& name = robot.character.name;
  std::printf("%s: %s, %.3g m, %.4g kg, %zu joints in %zu parts; contacts allowed: %d by the file, %d unavoidable\n",
              name.c_str(), robot.is_skeleton ? "skeleton" : "robot", robot.height_m, robot.mass_kg,
              robot.joints.size(), robot.parts.size(), robot.pairs_of_file, robot.pairs_at_rest);
  print_notes(robot.notes);
  print_next_steps(options, name);
}

// Refuses options for skinned models, which would have no effect on a robot.
Result<Done> refuse_model_options(const ImportCall& options) {
  const ImportOptions& given = options.import;
  if (given.metres_per_unit == 0.0 && given.height_m == 0.0 && given.skin < 0 && !given.draw_mesh &&
      options.clips.empty())
    return Done{};
  return Issue{
      "import.not_for_robots", "",
      "--scale, --height-m, --skin, --mesh and --clips are for skinned models; " + options.model + " is a robot"};
}

void import_bodies(const ImportCall& options, const RobotModel& robot, Context& context) {
  const Result<ImportedRobot> made = import_robot(robot, options.import.name);
  if (!made) return context.fail(about_file(options.model, made.issue()));
  if (!save(options, made->files, context)) return;
  if (options.json) return print_robot_json(options, robot.srdf, *made);
  print_robot_text(options, *made);
}

constexpr char kHowToChoose[] = "--srdf FILE chooses one, and --srdf none uses none";

void run_robot(const ImportCall& options, Context& context) {
  if (const Result<Done> plain = refuse_model_options(options); !plain) return context.fail(plain.issue());
  const Result<RobotModel> robot = options.srdf.empty()
                                       ? read_robot_with_srdf_beside(options.model, kHowToChoose)
                                       : read_robot(options.model, options.srdf == "none" ? "" : options.srdf);
  if (!robot) return context.fail(robot.issue());
  import_bodies(options, *robot, context);
}

void run_skeleton(const ImportCall& options, Context& context) {
  if (options.import.skin >= 0 || options.import.draw_mesh || !options.clips.empty())
    return context.fail({"import.not_for_skeletons", "",
                         "--skin, --mesh and --clips are for skinned models; " + options.model +
                             " is a skeleton (ASF)"});
  const Result<AsfSkeleton> skeleton = read_asf(options.model);
  if (!skeleton) return context.fail(about_file(options.model, skeleton.issue()));
  if (skeleton->bones.size() > kMaxRobotBodies)
    return context.fail({"import.too_many_joints", "",
                         options.model + " has more than " + std::to_string(kMaxRobotBodies) + " bones"});
  import_bodies(options, robot_of_asf(*skeleton, options.import), context);
}

bool is_asf(const std::string& path) {
  return fs::path(path).extension() == ".asf" || format_of_file(path) == FileFormat::asf;
}

void run(ImportCall options, Context& context) {
  if (options.import.name.empty()) options.import.name = name_of_file(options.model);
  if (is_robot_file(options.model)) return run_robot(options, context);
  if (!options.srdf.empty())
    return context.fail(
        {"import.only_for_robots", "", "--srdf is for a robot in URDF, and " + options.model + " is none"});
  if (is_asf(options.model)) return run_skeleton(options, context);
  options.import.wears_model = !options.no_model && is_one_file(options.model);
  const Result<SkinnedAsset> asset = read_skinned_gltf(options.model);
  if (!asset) return context.fail(about_file(options.model, asset.issue()));
  SkinnedAsset model = *asset;
  if (!options.clips.empty())
    if (const Result<int> added = add_clips_of_folder(options.clips, model.asset); !added)
      return context.fail(added.issue());
  Result<Imported> made = import_model(model, options.import);
  if (!made) return context.fail(about_file(options.model, made.issue()));
  Imported imported = std::move(made).value();
  if (const Result<Done> added = add_model(options, imported); !added) return context.fail(added.issue());
  if (!save(options, imported.files, context)) return;
  if (options.json) return print_json(options, imported);
  print_text(options, imported);
}

}  // namespace

void add_import(CLI::App& app, Context& context) {
  auto options = std::make_shared<ImportCall>();
  CLI::App* command =
      app.add_subcommand("import", "Make a character from a rigged model (.glb, .gltf), a robot (.urdf, MJCF) or a skeleton (.asf)");
  command
      ->add_option("MODEL", options->model,
                   "Skinned model (.glb, .gltf; VRM's bones are understood), robot (.urdf, MuJoCo's .xml), or skeleton of motion capture (.asf)")
      ->required();
  command->add_option("-o,--output", options->folder, "Library folder for the character's files")->required();
  command->add_option("--srdf", options->srdf, 
                      "The robot's SRDF, which says what links may touch, or none (default: the one beside the URDF "
                      "whose robot has the same name)");
  command->add_option("--clips", options->clips,
                      "Folder of glTF files with clips for the model: ranges and contacts are learnt from them, too");
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
      "         contort --library my_figures fuzz --character robot\n"
      "         contort import panda.urdf -o my_robots\n"
      "         contort import 02.asf -o people");
  command->callback([options, &context] { run(*options, context); });
}

}  // namespace contort::cli
