#include "cli/animation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "formats/gltf/read.h"
#include "formats/mocap/asf.h"
#include "formats/mocap/bvh.h"
#include "model/core/inside_folder.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

std::size_t common_prefix(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

Result<Animation> read_take(const std::string& path, const AnimationOptions& options) {
  const Result<std::string> asf =
      options.skeleton.empty() ? find_skeleton(path) : Result<std::string>(options.skeleton);
  if (!asf) return asf.issue();
  if (options.skeleton.empty())  // nobody named it: it may be a link that came with the take
    if (const Result<Done> inside = check_inside(fs::path(*asf).parent_path().string(), *asf); !inside)
      return inside.issue();
  Result<AsfSkeleton> skeleton = read_asf(*asf);
  if (!skeleton) return Issue{skeleton.issue().code, skeleton.issue().pointer, *asf + ": " + skeleton.issue().text};
  Result<AmcMotion> motion = read_amc(path, *skeleton);
  if (!motion) return motion.issue();
  Animation out{to_asset(*skeleton, *motion, options.rate_hz, fs::path(path).stem().string()), {}};
  out.take = Take{std::move(skeleton).value(), std::move(motion).value()};
  return out;
}

Result<Animation> with_asset(Result<Asset> asset) {
  if (!asset) return asset.issue();
  return Animation{std::move(asset).value(), {}};
}

}  // namespace

bool is_animation(const std::string& path) {
  constexpr std::array<std::string_view, 4> kEndings = {".glb", ".gltf", ".bvh", ".amc"};
  return std::find(kEndings.begin(), kEndings.end(), ending_of(path)) != kEndings.end();
}

Result<Animation> read_animation(const std::string& path, const AnimationOptions& options) {
  const std::string ending = ending_of(path);
  if (ending == ".amc") return read_take(path, options);
  if (ending == ".bvh") return with_asset(read_bvh(path));
  if (ending == ".glb" || ending == ".gltf") return with_asset(read_gltf_around_faults(path));
  return Issue{"check.unknown_format", "", path + " ends in none of .glb, .gltf, .bvh, .amc"};
}

Result<std::string> find_skeleton(const std::string& amc_path) {
  const fs::path amc(amc_path);
  const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (ending_of(entry.path()) == ".asf") found.push_back(entry.path().string());
  if (found.size() == 1) return found.front();
  std::size_t best = 0;
  std::vector<std::string> nearest;  // of those that begin most alike
  for (const std::string& path : found) {
    const std::size_t length = common_prefix(fs::path(path).stem().string(), amc.stem().string());
    if (length > best) nearest.clear(), best = length;
    if (length == best && length > 0) nearest.push_back(path);
  }
  if (nearest.size() == 1) return nearest.front();
  return Issue{"check.no_skeleton", "",
               (found.empty() ? "there is no .asf beside " : "more than one .asf may belong to ") + amc_path +
                   "; name it with --skeleton"};
}

namespace {

// Lists the files in a folder and in those below it. Links to folders are not followed, as they may lead in a circle.
void look_into(const std::string& folder, std::vector<std::string>& files, std::vector<Unreadable>& unreadable) {
  std::error_code error;
  std::vector<std::string> folders;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    if (is_folder && !entry->is_symlink(ignored)) folders.push_back(entry->path().string());
    if (!is_folder && is_animation(entry->path().string())) files.push_back(entry->path().string());
  }
  if (error) unreadable.push_back({folder, {"file.unreadable", "", folder + ": " + error.message()}});
  for (const std::string& below : folders) look_into(below, files, unreadable);
}

}  // namespace

std::vector<std::string> expand_animations(const std::vector<std::string>& paths, std::vector<Unreadable>& unreadable) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    std::vector<std::string> inside;
    if (fs::is_directory(path, error))
      look_into(path, inside, unreadable);
    else
      inside.push_back(path);
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

}  // namespace contort::cli
