#include "generator/recordings.h"

#include <algorithm>
#include <filesystem>

#include "formats/gltf/read.h"
#include "formats/mocap/bvh.h"
#include "formats/mocap/take.h"
#include "model/core/files.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

bool is_recording(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".glb" || ending == ".gltf" || ending == ".bvh" || ending == ".amc";
}

Result<Asset> read_amc_asset(const std::string& path) {
  const Result<Take> take = read_take(path);
  if (!take && take.issue().code == "check.no_skeleton")
    return Issue{take.issue().code, "", take.issue().text + "; a library needs exactly one for each .amc"};
  if (!take) return take.issue();
  return to_asset(*take, kTakeRate_hz, path);
}

Result<Asset> read_recording(const std::filesystem::path& path) {
  if (path.extension() == ".bvh") return read_bvh(path.string());
  return path.extension() == ".amc" ? read_amc_asset(path.string()) : read_gltf(path.string());
}

}  // namespace

Result<Done> load_recordings(const std::string& folder, Library& into) {
  std::error_code error;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (is_recording(entry.path())) paths.push_back(entry.path());
  if (error) return Issue{"library.unreadable", "", folder + ": " + error.message()};
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    if (const Result<Done> inside = check_inside(folder, path.string()); !inside) return inside.issue();
    Result<Asset> asset = read_recording(path);
    if (!asset) return about_file(path.string(), asset.issue());
    if (!into.recordings.try_emplace(path.stem().string(), std::make_shared<const Asset>(std::move(asset).value()))
             .second)
      return Issue{"recording.duplicate_name", "",
                   path.string() + ": \"" + path.stem().string() + "\" is there already"};
  }
  return Done{};
}

}  // namespace contort
