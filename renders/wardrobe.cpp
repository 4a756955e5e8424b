#include <filesystem>
#include <map>

#include "formats/gltf/read.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"
#include "model/core/hash.h"
#include "model/core/inside_folder.h"
#include "model/core/json_fields.h"
#include "renders/skin.h"

namespace contort {
namespace {

namespace fs = std::filesystem;

// Follows links; the target must be in the folder too.
Result<std::string> model_path(const std::string& skin_path, const SkinDesc& desc) {
  std::error_code error;
  const fs::path folder = fs::path(skin_path).parent_path();
  const fs::path model = folder / desc.model, real = fs::weakly_canonical(model, error);
  if (error || !fs::is_regular_file(real, error))
    return Issue{"skin.no_model", "/model", "there is no file " + model.string()};
  if (real.parent_path() != fs::weakly_canonical(folder, error))
    return Issue{"skin.outside", "/model", model.string() + " is a link to another folder"};
  return real.string();
}

}  // namespace

struct Wardrobe::Models {
  std::map<std::string, std::shared_ptr<const SkinnedAsset>> read;        // by path
  std::map<std::string, Result<std::shared_ptr<const Skin>>> of_figures;  // by name and hash of the character

  Result<std::shared_ptr<const SkinnedAsset>> model(const std::string& path) {
    if (const auto known = read.find(path); known != read.end()) return known->second;
    Result<SkinnedAsset> asset = read_skinned_gltf(path);
    if (!asset) return about_file(path, asset.issue());
    return read[path] = std::make_shared<const SkinnedAsset>(std::move(asset).value());
  }

  Result<std::shared_ptr<const Skin>> bind(const std::string& path, const Character& character) {
    const Result<std::string> text = read_json_file(path, "the skin of a character (JSON)");
    if (!text) return text.issue();
    const Result<SkinDesc> desc = parse_skin(*text);
    if (!desc) return about_file(path, desc.issue());
    const Result<std::string> file = model_path(path, *desc);
    if (!file) return about_file(path, file.issue());
    const Result<std::shared_ptr<const SkinnedAsset>> asset = model(*file);
    if (!asset) return asset.issue();
    Result<Skin> skin = bind_skin(*desc, **asset, character);
    if (!skin) return about_file(path, skin.issue());
    return std::make_shared<const Skin>(std::move(skin).value());
  }
};

Wardrobe::Wardrobe(std::vector<std::string> folders)
    : folders_(std::move(folders)), models_(std::make_unique<Models>()) {}
Wardrobe::Wardrobe(Wardrobe&&) noexcept = default;
Wardrobe::~Wardrobe() = default;

Result<std::shared_ptr<const Skin>> Wardrobe::skin_of(const Character& character) {
  const std::string key = character.name() + " " + to_hex(character.hash());
  if (const auto known = models_->of_figures.find(key); known != models_->of_figures.end()) return known->second;
  Result<std::shared_ptr<const Skin>> skin = std::shared_ptr<const Skin>();
  std::error_code error;
  for (const std::string& folder : folders_)
    if (const std::string path = folder + "/skins/" + character.name() + ".json"; fs::exists(path, error)) {
      const Result<Done> inside = check_inside(folder, path);
      skin = inside ? models_->bind(path, character) : inside.issue();
      break;
    }
  models_->of_figures.emplace(key, skin);
  return skin;
}

}  // namespace contort
