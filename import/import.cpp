#include "import/import.h"

#include <filesystem>

#include "checks/joint_map.h"
#include "import/names.h"
#include "import/roles.h"
#include "import/skeleton.h"
#include "import/skinning.h"
#include "model/character/library.h"
#include "model/character/skin_desc.h"

namespace contort {

namespace {

constexpr std::size_t kMostNameBytes = 26;  // a part's name is this name and its slot's name

// Parses the files that were made. These count, not the data from which they were made.
Result<Library> read_back(const CutFigure& cut) {
  Library library;
  for (const PartDesc& part : cut.parts) {
    const Result<PartDesc> read = parse_part(print_part(part));
    if (!read) return read.issue();
    library.parts[part.name] = *read;
  }
  const Result<CharacterDesc> character = parse_character(print_character(cut.character));
  if (!character) return character.issue();
  library.characters[character->name] = *character;
  return library;
}

Result<Character> build(const CutFigure& cut) {
  const Result<Library> library = read_back(cut);
  if (!library) return library.issue();
  return build_character({cut.character.name, {}, {}}, *library);
}

SkinDesc skin_of(const Imported& imported) {
  return {imported.cut.character.name + ".glb", imported.figure.metres_per_unit,
          to_rotation_vector(imported.figure.world_from_model) * kDegPerRad, imported.cut.carrier_of_node};
}

// The map also has the root, without which the figure's path is unknown.
std::map<std::string, std::string> map_of(const Imported& imported) {
  std::map<std::string, std::string> joints = imported.cut.joint_of_node;
  const std::string& root = imported.figure.bones.front().label;
  if (!root.empty() && root.size() <= 200) joints[root] = "root";
  return joints;
}

void write_files(Imported& out, bool wears_model) {
  const std::string& name = out.cut.character.name;
  for (const PartDesc& part : out.cut.parts) out.files.push_back({part.name + ".json", print_part(part)});
  out.files.push_back({name + ".json", print_character(out.cut.character)});
  out.files.push_back({"maps/" + name + ".json", print_joint_map({map_of(out)})});
  if (wears_model) out.files.push_back({"skins/" + name + ".json", print_skin(skin_of(out))});
  out.files.push_back({name + ".import.md", write_report(out, name)});
}

}  // namespace

Result<Done> check_import_name(const std::string& name) {
  const bool is_legal = !name.empty() && name.size() <= kMostNameBytes && legal_name(name, "") == name;
  const Library& stock = stock_library();
  if (is_legal && !stock.characters.contains(name)) return Done{};
  return Issue{"import.bad_name", "",
               is_legal ? "\"" + name + "\" is a stock character"
                        : "allowed are names of 1 to 26 of a-z, 0-9 and single _ between them"};
}

std::string name_of_file(const std::string& path) {
  return legal_name(std::filesystem::path(path).stem().string().substr(0, kMostNameBytes), "model");
}

Result<Imported> import_model(const SkinnedAsset& asset, const ImportOptions& options) {
  if (const Result<Done> named = check_import_name(options.name); !named) return named.issue();
  Result<RiggedFigure> read = read_figure(asset, options);
  if (!read) return read.issue();
  Imported out;
  out.figure = std::move(read).value();
  find_roles(out.figure);
  const Result<std::vector<PartPlan>> plans = cut(out.figure);
  if (!plans) return plans.issue();
  std::vector<TriangleMesh> meshes;
  if (options.draw_mesh) meshes = bone_meshes(asset, out.figure);
  out.cut =
      describe(out.figure, followed(out.figure, sample_clips(asset.asset, out.figure)), *plans, options.name, meshes);
  const Result<Character> plain = build(out.cut);
  if (!plain) return plain.issue();
  out.contacts = find_contacts(*plain, asset.asset, map_of(out));
  out.cut.character.allowed_pairs = out.contacts.pairs;
  const Result<Character> character = build(out.cut);
  if (!character) return character.issue();
  for (const Joint& joint : character->joints()) out.mass_kg += joint.mass_kg;
  write_files(out, options.wears_model);
  return out;
}

int count_sources(const Imported& imported, LimitSource source) {
  int count = 0;
  for (std::size_t b = 1; b < imported.cut.bones.size(); ++b) count += imported.cut.bones[b].limits.source == source;
  return count;
}

int count_too_narrow(const Imported& imported) {
  int count = 0;
  for (std::size_t b = 1; b < imported.cut.bones.size(); ++b) count += imported.cut.bones[b].limits.leaves_table ? 1 : 0;
  return count;
}

}  // namespace contort
