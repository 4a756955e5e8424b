#include "cli/guest_model.h"

#include <algorithm>
#include <filesystem>

#include "cli/bone_joints.h"
#include "cli/robot_joints.h"
#include "formats/detect/file_format.h"
#include "formats/gltf/read.h"
#include "formats/mocap/bvh.h"
#include "formats/robot/read.h"
#include "import/import.h"
#include "model/core/files.h"
#include "model/core/json_value_fields.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostModelJoints = 1000;
constexpr char kHowToChooseSrdf[] = "copy the model into a folder with the one that counts, or with none";

// Splits a command into words like a shell, without quotes and backslashes. This is enough to find the files that it
// names.
std::vector<std::string> words_of_command(const std::string& command) {
  std::vector<std::string> words{""};
  char quote = '\0';
  for (const char c : command) {
    if (quote == '\0' && std::string_view(" \t\n;&|()<>=").find(c) != std::string_view::npos)
      words.emplace_back();
    else if (c == quote || (quote == '\0' && (c == '"' || c == '\'')))
      quote = quote == '\0' ? c : '\0';
    else if (c != '\\')
      words.back() += c;
  }
  std::erase(words, "");
  return words;
}

// The folders of the files that the command names, and the present folder.
std::vector<fs::path> folders_of(const std::string& command) {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
  };
  std::error_code error;
  for (const std::string& word : words_of_command(command))
    if (fs::is_regular_file(word, error)) add(fs::absolute(word, error).parent_path());
  add(fs::current_path(error));
  return folders;
}

Result<std::string> found_model(const std::string& path, const std::string& command) {
  std::error_code error;
  if (fs::path(path).is_absolute()) return path;
  std::string looked;
  for (const fs::path& folder : folders_of(command)) {
    if (fs::exists(folder / path, error)) return (folder / path).string();
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  return Issue{"generator.no_model", "", "there is no file " + json_fields::quoted(path) + " in " + looked};
}

// A skeleton without a surface has no colliders and no known limits.
Result<GuestCharacter> read_bvh_joints(const std::string& path) {
  const Result<Asset> asset = read_bvh(path);
  if (!asset) return asset.issue();
  GuestCharacter out;
  for (const int node : asset->order) {
    const AssetNode& from = asset->nodes[static_cast<std::size_t>(node)];
    if (!from.is_joint) continue;
    GuestJoint joint;
    joint.name = from.label, joint.position = from.rest.translation;
    if (from.parent >= 0) joint.parent = asset->nodes[static_cast<std::size_t>(from.parent)].label;
    out.joints.push_back(joint);
  }
  return out;
}

Result<GuestCharacter> read_skinned_joints(const std::string& path) {
  const Result<SkinnedAsset> asset = read_skinned_gltf(path);
  if (!asset) return asset.issue();
  const Result<Imported> imported = import_model(*asset, {.name = "model"});
  if (!imported) return imported.issue();
  return joints_of_bones(asset->asset, *imported);
}

Result<GuestCharacter> read_robot_joints(const std::string& path) {
  const Result<RobotModel> robot = read_robot_with_srdf_beside(path, kHowToChooseSrdf);
  if (!robot) return robot.issue();
  return joints_of_robot(*robot);
}

Result<GuestCharacter> read_model(const std::string& path) {
  const FileFormat format = format_of_file(path);
  if (format == FileFormat::bvh) return read_bvh_joints(path);
  return is_robot_file(path) ? read_robot_joints(path) : read_skinned_joints(path);
}

}  // namespace

ModelReader model_reader(const std::string& command) {
  return [command](const std::string& path) -> Result<GuestCharacter> {
    const Result<std::string> found = found_model(path, command);
    if (!found) return found.issue();
    Result<GuestCharacter> read = read_model(*found);
    if (!read) return about_file(*found, read.issue());
    if (read->joints.size() <= kMostModelJoints) return read;
    return Issue{"generator.too_many_joints", "",
                 *found + " has " + std::to_string(read->joints.size()) + " joints; a character has at most 1000"};
  };
}

}  // namespace contort::cli
