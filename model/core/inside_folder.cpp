#include "model/core/inside_folder.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "model/core/files.h"

namespace contort {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostNameBytes = 255;  // limit of file systems

// Makes a name safe for messages, because it may contain anything.
std::string printable_name(std::string_view name) {
  std::string text(name.substr(0, 200));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return "\"" + text + (name.size() > 200 ? "…\"" : "\"");
}

bool has_only_file_names(std::string_view name) {
  for (;;) {
    const std::size_t slash = name.find('/');
    if (!is_file_name(name.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    name.remove_prefix(slash + 1);
  }
}

// Returns true if the entry is a link that leads out of the folder. The entry's own folder must be inside.
bool is_link_out(const std::string& folder, const fs::path& entry) {
  std::error_code error;
  if (!fs::is_symlink(fs::symlink_status(entry, error))) return false;
  const fs::path base = fs::canonical(folder, error);
  const fs::path end = error ? fs::path() : fs::canonical(entry, error);
  return error || std::mismatch(base.begin(), base.end(), end.begin(), end.end()).first != base.end();
}

Issue link_out(const std::string& folder, const fs::path& entry) {
  return {"file.outside", "",
          printable_name(entry.string()) + " is a symbolic link that leads out of " + printable_name(folder) +
              " or nowhere, and is not followed; remove the link, or put what it leads to in its place"};
}

}  // namespace

bool is_file_name(std::string_view text) {
  const auto is_allowed = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f && c != '/' && c != '\\';
  };
  return !text.empty() && text.size() <= kMostNameBytes && text != "." && text != ".." &&
         std::ranges::all_of(text, is_allowed);
}

Result<Done> check_inside(const std::string& folder, const std::string& path) {
  CONTORT_ASSERT(path.starts_with(folder));
  fs::path at = folder;
  for (const fs::path& step : fs::path(path.substr(folder.size())).relative_path()) {
    at /= step;
    if (is_link_out(folder, at)) return link_out(folder, at);
  }
  return Done{};
}

Result<std::string> place_inside(const std::string& folder, const std::string& name) {
  if (!has_only_file_names(name))
    return Issue{"file.bad_name", "", printable_name(name) + " is no name of a file in " + printable_name(folder)};
  const std::string path = folder + "/" + name;
  if (const Result<Done> inside = check_inside(folder, fs::path(path).parent_path().string()); !inside)
    return inside.issue();
  return path;
}

Result<std::string> read_inside(const std::string& folder, const std::string& name, std::size_t max_bytes) {
  const Result<std::string> path = place_inside(folder, name);
  if (!path) return path;
  if (const Result<Done> inside = check_inside(folder, *path); !inside) return inside.issue();
  return read_file(*path, max_bytes);
}

Result<std::string> read_beside(const std::string& path, std::size_t max_bytes) {
  const fs::path file(path);
  const std::string folder = file.has_parent_path() ? file.parent_path().string() : ".";
  return read_inside(folder, file.filename().string(), max_bytes);
}

Result<Done> write_inside(const std::string& folder, const std::string& name, std::string_view bytes) {
  const Result<std::string> path = place_inside(folder, name);
  if (!path) return path.issue();
  // Removes the temporary file of write_file first: if it were a link, the data would be written through it.
  ::unlink((*path + "." + std::to_string(::getpid()) + ".part").c_str());
  return write_file(*path, bytes);
}

bool is_outside(const Issue& issue) { return issue.code == "file.outside" || issue.code == "file.bad_name"; }

}  // namespace contort
