#include "generator/recordings.h"

#include <algorithm>
#include <filesystem>

#include "generator/gltf/read.h"

namespace contort {

Result<Done> load_recordings(const std::string& folder, Library& into) {
  std::error_code error;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".glb" || entry.path().extension() == ".gltf") paths.push_back(entry.path());
  if (error) return Issue{"library.unreadable", "", folder + ": " + error.message()};
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    Result<Asset> asset = read_gltf(path.string());
    if (!asset) return asset.issue();
    if (!into.recordings.try_emplace(path.stem().string(), std::make_shared<const Asset>(std::move(asset).value()))
             .second)
      return Issue{"recording.duplicate_name", "",
                   path.string() + ": \"" + path.stem().string() + "\" is there already"};
  }
  return Done{};
}

}  // namespace contort
