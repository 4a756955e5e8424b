#include "cli/animation.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "formats/detect/file_format.h"
#include "formats/gltf/read.h"
#include "formats/mocap/bvh.h"
#include "formats/mocap/frame.h"
#include "model/core/file_kind.h"
#include "model/core/files.h"

namespace contort::cli {

namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<Animation> read_take(const std::string& path, const AnimationOptions& options) {
  if (const auto other = other_kind(path, beginning_of(path, kKindBytes), kAnimationFiles);
      other && format_of_bytes(beginning_of(path, kKindBytes)) == FileFormat::none)  // before searching for a skeleton
    return Issue{"amc.wrong_kind", "", other->text};
  Result<Take> take = contort::read_take(path, options.skeleton);
  if (!take && take.issue().code == "check.no_skeleton")
    return Issue{take.issue().code, "", take.issue().text + "; name it with --skeleton"};
  if (!take) return take.issue();
  Animation out{to_asset(*take, options.rate_hz, path), {}};
  out.take = std::move(take).value();
  return out;
}

Result<Asset> read_bvh_as_said(const std::string& path, const AnimationOptions& options) {
  Result<Asset> read = read_bvh(path, options.bvh_rate_hz);
  if (!read) return read;
  Asset asset = std::move(read).value();
  if (const double unit_m = metres_in(options.unit); unit_m > 0.0) scale_lengths(unit_m, asset);
  if (options.up == "z") turn_z_up(asset);
  return asset;
}

Result<Animation> read_table(const std::string& path, const AnimationOptions& options) {
  Result<JointTable> table = read_joint_table(path, options.table_rate_hz);
  if (!table) return table.issue();
  Animation out;
  const std::string name = fs::path(path).stem().string();
  out.asset.clips.push_back({name, name, {}, table->times_s.front(), table->times_s.back()});
  out.asset.remarks = table->remarks;
  out.table = std::move(table).value();
  return out;
}

Result<Animation> with_asset(Result<Asset> asset) {
  if (!asset) return asset.issue();
  return Animation{std::move(asset).value(), {}};
}

}  // namespace

double metres_in(const std::string& unit) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  for (const auto& [name, metres] : kUnits)
    if (unit == name) return metres;
  return 0.0;
}

bool is_animation(const std::string& path) {
  const FileFormat format = format_of_file(path);
  return format != FileFormat::none && format != FileFormat::asf && format != FileFormat::joint_table;
}

bool is_table(const std::string& path) { return format_of_file(path) == FileFormat::joint_table; }

std::optional<Issue> other_than_animation(const std::string& path, const std::string& expected) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  if (format_of_file(path) == FileFormat::asf)
    return Issue{"file.wrong_kind", "", path + " is a skeleton (ASF), expected " + expected + "; name its .amc"};
  return unknown_kind(path, beginning_of(path, kKindBytes), expected);
}

Result<Animation> read_animation(const std::string& path, const AnimationOptions& options) {
  switch (format_of_file(path)) {
    case FileFormat::amc: return read_take(path, options);
    case FileFormat::bvh: return with_asset(read_bvh_as_said(path, options));
    case FileFormat::joint_table: return read_table(path, options);
    case FileFormat::gltf: return with_asset(read_gltf_around_faults(path));
    default: break;
  }
  const std::optional<Issue> other = other_than_animation(path, kAnimationFiles);
  return other ? *other : Issue{"file.unreadable", "", path + " is no file that can be read"};
}

namespace {

// Returns true for files that people take for animations; leaving such a file out without a message would mislead them.
bool may_be_taken_for_motion(const fs::path& path) {
  const std::string ending = ending_of(path);
  return ending != ".html" && ending != ".htm" && has_advice(beginning_of(path.string(), kKindBytes));
}

// Lists the files in a folder and below it. Links to folders are not followed, because they may form a circle.
void look_into(const std::string& folder, bool has_character, Expanded& out) {
  std::error_code error;
  std::vector<std::string> folders;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const bool is_folder = entry->is_directory(ignored);
    if (is_folder && !entry->is_symlink(ignored)) folders.push_back(entry->path().string());
    if (is_folder) continue;
    const std::string path = entry->path().string();
    if (is_animation(path) || (has_character && is_joint_table(beginning_of(path, kKindBytes))))
      out.files.push_back(path);
    else if (may_be_taken_for_motion(path))
      out.skipped.push_back({path, *other_than_animation(path, kAnimationFiles)});
  }
  if (error) out.unreadable.push_back({folder, {"file.unreadable", "", folder + ": " + error.message()}});
  for (const std::string& below : folders) look_into(below, has_character, out);
}

}  // namespace

Expanded expand_animations(const std::vector<std::string>& paths, bool has_character) {
  Expanded out;
  for (const std::string& path : paths) {
    std::error_code error;
    const auto first = static_cast<std::ptrdiff_t>(out.files.size());
    if (fs::is_directory(path, error))
      look_into(path, has_character, out);
    else
      out.files.push_back(path);
    std::sort(out.files.begin() + first, out.files.end());
  }
  std::ranges::sort(out.skipped, {}, &Unreadable::file);
  return out;
}

}  // namespace contort::cli
