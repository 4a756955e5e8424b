#include "formats/robot/srdf_beside.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "formats/robot/robot.h"
#include "formats/robot/urdf.h"
#include "model/core/files.h"

namespace contort {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSrdfs = 256;
constexpr const char* kFoldersOfPackage[] = {"srdf", "config"};

// The paths in the folder with this ending, in the order of their names; none if the folder cannot be read.
std::vector<fs::path> entries_ending(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->path().filename().string().ends_with(ending)) out.push_back(entry->path());
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<fs::path> places_of_package(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const char* name : kFoldersOfPackage) out.push_back(folder / name);
  return out;
}

// The folders of the URDF's own package. The file mostly lies in the package's folder, or in `urdf` or `robots` in it.
std::vector<fs::path> own_places(const fs::path& folder) {
  std::vector<fs::path> out = {folder};
  for (const fs::path& package : {folder, folder / ".."})
    for (const fs::path& place : places_of_package(package)) out.push_back(place);
  return out;
}

std::vector<fs::path> places_of_moveit(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const fs::path& packages : {folder / "..", folder / ".." / ".."})
    for (const fs::path& package : entries_ending(packages, "moveit_config"))
      for (const fs::path& place : places_of_package(package)) out.push_back(place);
  return out;
}

class SrdfSearch {
 public:
  explicit SrdfSearch(std::string robot_name) : robot_name_(std::move(robot_name)) {}

  void look_in(const std::vector<fs::path>& places, bool is_own) {
    for (const fs::path& place : places)
      for (const fs::path& file : entries_ending(place, ".srdf")) look_at(file, is_own);
  }

  SrdfsBeside found() && { return std::move(out_); }

 private:
  // Returns false for a known file: a folder may be reached in two ways, and installations link files to their sources.
  bool is_new(const fs::path& file) {
    std::error_code error;
    const fs::path itself = fs::canonical(file, error);
    return files_.size() < kMostSrdfs && files_.insert(error ? file : itself).second;
  }

  void look_at(const fs::path& file, bool is_own) {
    if (!is_new(file)) return;
    const std::string path = file.lexically_normal().string();
    const Result<std::string> text = read_file(path, kMaxRobotBytes);
    const Result<std::string> name = text ? robot_of_srdf(*text) : text;
    if (!name && is_own) out_.unreadable.push_back({path, name.issue()});
    if (!name) return;
    const bool fits = *name == robot_name_;
    if (fits && texts_.insert(*text).second) out_.fitting.push_back(path);
    if (!fits && is_own) out_.of_others.push_back(path);
  }

  std::string robot_name_;
  std::set<fs::path> files_;
  std::set<std::string> texts_;
  SrdfsBeside out_;
};

}  // namespace

SrdfsBeside srdfs_beside(const std::string& urdf_file, const std::string& robot_name) {
  const fs::path parent = fs::path(urdf_file).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  SrdfSearch search(robot_name);
  search.look_in(own_places(folder), true);
  search.look_in(places_of_moveit(folder), false);
  return std::move(search).found();
}

}  // namespace contort
