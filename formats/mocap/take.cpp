#include "formats/mocap/take.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "formats/mocap/amc.h"
#include "formats/mocap/asf.h"
#include "model/core/inside_folder.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

bool is_skeleton(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending == ".asf";
}

std::size_t common_prefix(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

Result<std::string> skeleton_inside(const std::string& amc_path) {
  Result<std::string> asf = find_skeleton(amc_path);
  if (!asf) return asf;
  if (const Result<Done> inside = check_inside(fs::path(*asf).parent_path().string(), *asf); !inside)
    return inside.issue();
  return asf;
}

}  // namespace

Result<std::string> find_skeleton(const std::string& amc_path) {
  const fs::path amc(amc_path);
  const fs::path folder = amc.has_parent_path() ? amc.parent_path() : fs::path(".");
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (is_skeleton(entry.path())) found.push_back(entry.path().string());
  if (found.size() == 1) return found.front();
  std::size_t best = 0;
  std::vector<std::string> nearest;  // names with the longest common beginning
  for (const std::string& path : found) {
    const std::size_t length = common_prefix(fs::path(path).stem().string(), amc.stem().string());
    if (length > best) nearest.clear(), best = length;
    if (length == best && length > 0) nearest.push_back(path);
  }
  if (nearest.size() == 1) return nearest.front();
  return Issue{"check.no_skeleton", "",
               (found.empty() ? "there is no .asf beside " : "more than one .asf may belong to ") + amc_path};
}

Result<Take> read_take(const std::string& amc_path, const std::string& asf_path) {
  const Result<std::string> asf = asf_path.empty() ? skeleton_inside(amc_path) : Result<std::string>(asf_path);
  if (!asf) return asf.issue();
  Result<AsfSkeleton> skeleton = read_asf(*asf);
  if (!skeleton) return Issue{skeleton.issue().code, skeleton.issue().pointer, *asf + ": " + skeleton.issue().text};
  Result<AmcMotion> motion = read_amc(amc_path, *skeleton);
  if (!motion) return motion.issue();
  return Take{std::move(skeleton).value(), std::move(motion).value()};
}

Asset to_asset(const Take& take, double rate_hz, const std::string& amc_path) {
  return to_asset(take.skeleton, take.motion, rate_hz, fs::path(amc_path).stem().string());
}

}  // namespace contort
